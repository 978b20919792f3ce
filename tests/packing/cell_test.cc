#include "libindet/packing/cell.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "libindet/base/error.h"
#include "libindet/packing/cancelling_loads.h"
#include "libindet/packing/validate.h"
#include "tests/support/scene_builder.h"

namespace indet {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Two disks of radius 1 in a cell of 4 × 3, the second one to the right of the first, across the boundary
/// too.
Packing two_in_a_row() {
  Packing packing;
  packing.named_force_unit = 1;
  packing.cell.a = Vector2(4, 0);
  packing.cell.b = Vector2(0, 3);
  zoo::add_disk(packing, {1, 1});
  zoo::add_disk(packing, {3, 1});
  return packing;
}

Contact contact_of(const Packing& packing, DiskId a, DiskId b, Image image) {
  Contact contact;
  contact.a = a;
  contact.b = Body::disk(b);
  contact.image = image;
  contact.normal = geometric_normal(packing, a, contact.b, image);
  contact.gap = geometric_gap(packing, a, contact.b, image);
  return contact;
}

std::string reason_of(const Packing& packing) {
  const auto defect = find_defect(packing);
  return defect ? defect->reason : "";
}

TEST(Cell, AreaOfAThinOneIsPrecise) {
  Cell cell;
  cell.a = Vector2(1e8 + 1, 1e8);
  cell.b = Vector2(1e8, 1e8 - 1);
  EXPECT_EQ(cell.area(), 1) << "1e16 − 1 − 1e16";
}

TEST(Cell, BranchesEndAtImages) {
  Packing packing = two_in_a_row();
  const Contact inside = contact_of(packing, DiskId(0), DiskId(1), {0, 0});
  const Contact across = contact_of(packing, DiskId(0), DiskId(1), {-1, 0});
  EXPECT_EQ(inside.normal, Vector2(-1, 0));
  EXPECT_EQ(across.normal, Vector2(1, 0));
  EXPECT_EQ(packing.branch(across), Vector2(2, 0));
  EXPECT_EQ(across.gap, 0);
  packing.contacts = {inside, across};
  EXPECT_EQ(reason_of(packing), "") << "one pair, two contacts";
  EXPECT_EQ(contact_name(packing, ContactId(0)), "1–2");
  EXPECT_EQ(contact_name(packing, ContactId(1)), "1–2 (-1, 0)");
  packing.contacts.push_back(contact_of(packing, DiskId(1), DiskId(0), {1, 0}));
  EXPECT_THAT(reason_of(packing), HasSubstr("given twice: it is also contact 1"))
      << "seen from the other disk";
}

TEST(Cell, ADiskMayTouchItsOwnImage) {
  Packing packing = two_in_a_row();
  packing.cell.b = Vector2(0, 2);
  packing.contacts = {contact_of(packing, DiskId(0), DiskId(0), {0, 1})};
  EXPECT_EQ(reason_of(packing), "");
  packing.contacts.push_back(contact_of(packing, DiskId(0), DiskId(0), {0, -1}));
  EXPECT_THAT(reason_of(packing), HasSubstr("given twice")) << "the same contact, seen from the other side";
  packing.contacts = {packing.contacts.front()};
  packing.contacts.front().image = {0, 0};
  EXPECT_THAT(reason_of(packing), HasSubstr("disk 0 cannot touch itself"));
}

TEST(Cell, NearestImages) {
  Packing packing = two_in_a_row();
  packing.disks[1].position = {3.5 + 8, 1 - 3};
  EXPECT_EQ(nearest_image(packing, DiskId(0), DiskId(1)), (Image{-3, 1}));
  EXPECT_EQ(nearest_image(packing, DiskId(1), DiskId(0)), (Image{3, -1}));
  // Strongly tilted: rounding coordinates along the vectors is not enough.
  packing.cell.b = Vector2(8.5, 1);
  packing.disks[1].position = packing.disks[0].position - 0.45 * Vector2(0.5, 1);
  EXPECT_EQ(nearest_image(packing, DiskId(0), DiskId(1)), (Image{0, 0})) << "not (-1, 0)";
  EXPECT_EQ(nearest_image(packing, DiskId(0), DiskId(0))[0],
            -2 * nearest_image(packing, DiskId(0), DiskId(0))[1])
      << "the shortest vector is b − 2a";
  EXPECT_NE(nearest_image(packing, DiskId(0), DiskId(0)), (Image{0, 0}));
  // Vectors that are far from short ones.
  packing.cell = {Vector2(1, 0), Vector2(10, 2)};
  packing.disks[0].position = {0, 0};
  packing.disks[1].position = {0, 0.9};
  EXPECT_EQ(nearest_image(packing, DiskId(0), DiskId(1)), (Image{0, 0}));
  packing.disks[1].position = {0, 2.9};
  EXPECT_EQ(nearest_image(packing, DiskId(0), DiskId(1)), (Image{10, -1}));
  packing.cell.b.reset();
  EXPECT_EQ(nearest_image(packing, DiskId(0), DiskId(1)), (Image{0, 0}));
}

TEST(Cell, TheStressAndItsMotionAreDual) {
  const Vector2 f(0.3, -1.2);
  const Vector2 l(0.7, 0.4);
  const std::array<double, 4> y = {2, -3, 5, 7};
  double power = 0;
  for (int k = 0; k < 4; ++k) power += y[static_cast<std::size_t>(k)] * stress_part(k, f, l);
  EXPECT_NEAR(f.dot(compression(y) * l), power, 1e-14);
}

TEST(Cell, Defects) {
  const auto reason = [](auto change) {
    Packing packing = two_in_a_row();
    packing.stress.xx = 1;
    packing.contacts = {contact_of(packing, DiskId(0), DiskId(1), {0, 0})};
    change(packing);
    return reason_of(packing);
  };
  EXPECT_EQ(reason([](Packing&) {}), "");
  EXPECT_THAT(reason([](Packing& p) { p.cell.a = Vector2(0, 5); }), HasSubstr("parallel"));
  EXPECT_THAT(reason([](Packing& p) { p.cell.a = Vector2(std::nan(""), 5); }),
              HasSubstr("two finite numbers"));
  EXPECT_THAT(reason([](Packing& p) { p.gravity = {0, -1}; }), HasSubstr("gravity must be (0, 0)"));
  EXPECT_THAT(reason([](Packing& p) { p.cell.b.reset(); }), HasSubstr("periodic in both directions"));
  EXPECT_THAT(reason([](Packing& p) { p.stress.pressure = 1; }), HasSubstr("beside xx or yy"));
  EXPECT_THAT(reason([](Packing& p) { p.disks[0].fixed = true; }), HasSubstr("fixed disks"));
  EXPECT_EQ(reason([](Packing& p) { p.named_force_unit = 0; }), "");  // stress times a diameter
  EXPECT_THAT(reason([](Packing& p) { zoo::add_wall(p, {0, 0}, {0, 1}); }), HasSubstr("has no walls"));
  EXPECT_THAT(reason([](Packing& p) {
                p.cell.b.reset();
                p.stress = {};
                zoo::add_wall(p, {0, 0}, {1, 0});
              }),
              HasSubstr("its walls must be parallel"));
  EXPECT_THAT(reason([](Packing& p) {
                p.cell.b.reset();
                p.stress = {};
                p.contacts[0].image = {0, 1};
              }),
              HasSubstr("not periodic along the second vector"));
  EXPECT_THAT(reason([](Packing& p) { p.contacts[0].b = Body::cell(); }), HasSubstr("is no body"));
  // With a fixed disk, and no stress, something takes the weight.
  EXPECT_EQ(reason([](Packing& p) {
              p.stress = {};
              p.gravity = {0, -1};
              p.disks[1].fixed = true;
            }),
            "");
}

TEST(CancellingLoads, MustCancelExactlyInACell) {
  Packing packing = two_in_a_row();
  packing.contacts = {contact_of(packing, DiskId(0), DiskId(1), {0, 0})};
  packing.disks[0].load = {0.1, -2, 0};
  packing.disks[1].load = {-0.1, 2, 0};
  EXPECT_TRUE(take_out_cancelling_loads(packing).empty());
  packing.disks[1].load.y() = std::nextafter(2, 3);
  EXPECT_THAT([&] { take_out_cancelling_loads(packing); },
              ThrowsMessage<InputError>(HasSubstr("must cancel exactly, but their sum is (0, 4.44e-16)")));
}

TEST(Cell, FixesTheExpectedDimension) {
  Packing packing = two_in_a_row();
  packing.contacts = {contact_of(packing, DiskId(0), DiskId(1), {0, 0})};
  EXPECT_EQ(packing.expected_dimension(), 2 - 6 + 2);
  packing.stress.pressure = 1;
  EXPECT_EQ(packing.expected_dimension(), 2 - 6 - 1 + 2);
  packing.stress = {};
  packing.disks[0].fixed = true;
  EXPECT_EQ(packing.expected_dimension(), 2 - 3);
}

}  // namespace
}  // namespace indet
