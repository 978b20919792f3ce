#include "libindet/drawing/steps_picture.h"

#include <gtest/gtest.h>

#include <limits>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace indet {
namespace {

constexpr const char* kRangeLine = "10%,10%,10%";
constexpr const char* kRadiusLine = "0%,44.7%,69.8%";
constexpr const char* kWidthLine = "0%,50%,35%";
constexpr const char* kBallLine = "83.5%,36.9%,0%";

/// A load whose limit is 2, with mean δR falling from 8 to 0, and a ball of no size.
Limit falling(std::vector<double> radii) {
  Limit limit;
  limit.kind = LimitKind::kLoad;
  limit.largest.value = 2;
  for (std::size_t k = 0; k < radii.size(); ++k) {
    LimitStep step;
    step.value = 2.0 * static_cast<double>(k) / static_cast<double>(radii.size() - 1);
    step.mean_delta_R = 8 - 4 * step.value;
    step.r = radii[k];
    step.mean_width = std::numeric_limits<double>::infinity();
    step.inscribed_radius = 0;
    limit.largest.steps.push_back(step);
  }
  return limit;
}

struct Line {
  double x1, y1, x2, y2;
};
/// Lines of a colour, but for that of the legend, the last one.
std::vector<Line> curve(const std::string& svg, const std::string& colour) {
  const std::regex line("fill:none[^>]*stroke:rgb\\(" + colour +
                        "\\)[^>]*d=\"M ([0-9.]+) ([0-9.]+) L ([0-9.]+) ([0-9.]+)");
  std::vector<Line> lines;
  for (std::sregex_iterator found(svg.begin(), svg.end(), line), end; found != end; ++found)
    lines.push_back(
        {std::stod((*found)[1]), std::stod((*found)[2]), std::stod((*found)[3]), std::stod((*found)[4])});
  if (!lines.empty()) lines.pop_back();
  return lines;
}

std::string drawn(const Limit& limit) {
  const test::TemporaryFolder folder;
  draw_steps(folder / "s.svg", limit, limit.largest, "caption");
  return folder.read("s.svg");
}

TEST(StepsPicture, ShowsWhatIsLeftOfEachSize) {
  const std::string svg = drawn(falling({3, 6, 3}));
  const std::vector<Line> range = curve(svg, kRangeLine);
  const std::vector<Line> radius = curve(svg, kRadiusLine);
  ASSERT_EQ(range.size(), 2U);
  ASSERT_EQ(radius.size(), 2U);
  // Both begin at 1; the radius rises to 2 where the range falls to 1/2.
  EXPECT_EQ(range[0].x1, radius[0].x1);
  EXPECT_EQ(range[0].y1, radius[0].y1);
  const double unit = radius[0].y1 - radius[0].y2;
  EXPECT_GT(unit, 0);
  EXPECT_NEAR(range[0].y2 - range[0].y1, unit / 2, 0.01);
  EXPECT_NEAR(range[1].y2 - range[0].y1, unit, 0.01);
  EXPECT_NEAR(radius[1].y2, radius[0].y1, 0.01);
  EXPECT_NEAR(range[0].x2 - range[0].x1, range[1].x2 - range[1].x1, 0.01);
  // What is infinite or 0 at the beginning has no curve.
  EXPECT_EQ(svg.find(kWidthLine), std::string::npos);
  EXPECT_EQ(svg.find(kBallLine), std::string::npos);
}

TEST(StepsPicture, LeavesOutWhatIsNotKnown) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const std::string svg = drawn(falling({3, 3, unknown, 3, 3}));
  EXPECT_EQ(curve(svg, kRangeLine).size(), 4U);
  EXPECT_EQ(curve(svg, kRadiusLine).size(), 2U);
}

}  // namespace
}  // namespace indet
