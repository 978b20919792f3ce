#include "libindet/drawing/packing_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "libindet/base/error.h"
#include "libindet/drawing/colour_map.h"
#include "tests/io/sample.h"
#include "tests/support/temporary_folder.h"

namespace indet {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

constexpr const char* kDisk = "fill:rgb(93%,93%,93%)";
constexpr const char* kBlackLine = "stroke:rgb(10%,10%,10%)";
constexpr const char* kUnknownLine = "stroke:rgb(50%,50%,50%)";
constexpr const char* kPositiveLine = "stroke:rgb(83.5%,36.9%,0%)";
constexpr const char* kNegativeLine = "stroke:rgb(0%,44.7%,69.8%)";
constexpr const char* kUnboundedLine = "stroke:rgb(80%,0%,20%)";

TEST(PackingPicture, ForcesHaveTheirElements) {
  const test::TemporaryFolder folder;
  const Packing packing = test::sample_packing();  // T of contact 4 is unknown
  Eigen::VectorXd forces = packing.simulated_forces().value();
  forces[1] = 3;
  draw_forces(folder / "p.svg", packing, forces, "caption");
  const std::string svg = folder.read("p.svg");
  EXPECT_THAT(svg, StartsWith("<?xml"));
  EXPECT_EQ(count(svg, kDisk), 3);
  // Normal forces of contacts 0 to 3, floor and side wall, the legend's R.
  EXPECT_EQ(count(svg, kBlackLine), 4 + 2 + 1);
  EXPECT_EQ(count(svg, kUnknownLine), 1 + 1);
  // One at a contact with a wall (0), and the legend.
  EXPECT_EQ(count(svg, kPositiveLine), 1 + 1);
  // One at contacts 1 and 2, two (one a disk) at contact 3, and the legend.
  EXPECT_EQ(count(svg, kNegativeLine), 2 + 2 + 1);
}

TEST(PackingPicture, ThicknessIsProportionalToTheNormalForce) {
  const test::TemporaryFolder folder;
  Packing packing = test::sample_packing();
  packing.contacts.resize(2);
  const Eigen::VectorXd forces = Eigen::Vector4d(30, 0, 10, 0);
  draw_forces(folder / "p.svg", packing, forces, "");
  const std::string svg = folder.read("p.svg");
  std::vector<double> widths;
  for (std::size_t at = svg.find("stroke-width:"); at != std::string::npos;
       at = svg.find("stroke-width:", at + 1)) {
    const std::size_t end = svg.find("/>", at);
    const std::string element = svg.substr(at, end - at);
    if (element.find(kBlackLine) != std::string::npos) widths.push_back(std::stod(element.substr(13)));
  }
  ASSERT_EQ(widths.size(), 5U);  // two walls, two contacts, the legend
  EXPECT_NEAR(widths[2] / widths[3], 3, 1e-4);
}

TEST(PackingPicture, DeltaRHasItsElements) {
  const test::TemporaryFolder folder;
  const Packing packing = test::sample_packing();
  Eigen::VectorXd delta(5);
  delta << 0, 2, 4, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN();
  draw_delta_R(folder / "p.svg", packing, delta, Eigen::VectorXd(), "caption");
  const std::string svg = folder.read("p.svg");
  EXPECT_EQ(count(svg, kDisk), 3);
  EXPECT_EQ(count(svg, kUnboundedLine), 1 + 1);
  EXPECT_EQ(count(svg, kUnknownLine), 1 + 1);
  // The ends of the colour map: contact 0 and contact 2.
  EXPECT_EQ(count(svg, "stroke:rgb(99.215686%,90.588235%,14.509804%)"), 1);
  EXPECT_EQ(count(svg, "stroke:rgb(26.666667%,0.392157%,32.941176%)"), 1);
  EXPECT_EQ(count(svg, "<linearGradient"), 1);
}

TEST(PackingPicture, TheExtensionChoosesTheFormat) {
  const test::TemporaryFolder folder;
  const Packing packing = test::sample_packing();
  draw_forces(folder / "p.pdf", packing, packing.simulated_forces().value(), "c");
  draw_forces(folder / "p.png", packing, packing.simulated_forces().value(), "c");
  EXPECT_THAT(folder.read("p.pdf"), StartsWith("%PDF-"));
  EXPECT_THAT(folder.read("p.png"), StartsWith("\x89PNG"));
  EXPECT_THAT([&] { draw_forces(folder / "p.gif", packing, packing.simulated_forces().value(), "c"); },
              ThrowsMessage<InputError>(HasSubstr("written as .svg, .pdf or .png")));
  EXPECT_FALSE(std::filesystem::exists(folder / "p.gif"));
  EXPECT_THAT([&] { draw_forces(folder / "no" / "p.svg", packing, packing.simulated_forces().value(), "c"); },
              ThrowsMessage<InputError>(HasSubstr("does not exist")));
}

TEST(PackingPicture, AnEmptySceneCanBeDrawn) {
  const test::TemporaryFolder folder;
  draw_forces(folder / "p.svg", Packing{}, Eigen::VectorXd(), "nothing");
  EXPECT_EQ(count(folder.read("p.svg"), kDisk), 0);
}

double lightness(const Colour& c) { return 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue; }

TEST(ColourMap, GetsDarkerAllTheWay) {
  for (int i = 0; i < 100; ++i) {
    EXPECT_GT(lightness(map_colour(i / 100.0)), lightness(map_colour((i + 1) / 100.0))) << i;
  }
  EXPECT_EQ(map_colour(-1).red, map_colour(0).red);
  EXPECT_EQ(map_colour(2).red, map_colour(1).red);
}

}  // namespace
}  // namespace indet
