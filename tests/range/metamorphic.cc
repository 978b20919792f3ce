#include "tests/range/metamorphic.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <type_traits>

#include "libindet/base/error.h"
#include "libindet/base/random.h"
#include "libindet/range/analyze.h"
#include "libindet/range/result_fields.h"
#include "tests/support/compare.h"
#include "tests/support/zoo.h"

namespace indet::test {
namespace {

ForceRanges as_it_is(const ForceRanges& ranges) { return ranges; }

/// Results in mg of another mg.
ForceRanges in_force_unit(ForceRanges ranges, double unit) {
  const double factor = ranges.force_unit / unit;
  visit_fields(ranges, [&]<class Value>(const Field& field, Value&& value) {
    if (std::string_view(field.unit) != "mg") return;
    if constexpr (requires { value.rows(); }) {
      if constexpr (std::is_same_v<typename std::decay_t<Value>::Scalar, double>) value *= factor;
    } else if constexpr (std::is_same_v<std::decay_t<Value>, double>) {
      value *= factor;
    }
  });
  ranges.force_unit = unit;
  return ranges;
}

/// Torques have a length, too.
ForceRanges rescaled_with_torques(const ForceRanges& ranges, double length, double force) {
  ForceRanges result = rescaled(ranges, force);
  Reactions& r = result.reactions;
  for (Eigen::Index k = 0; k < r.count(); ++k) {
    if (r.component[k] != 2) continue;
    for (auto* table : {&r.value, &r.lower, &r.upper}) table->row(k) *= length;
  }
  return result;
}

View in_other_order(const Packing& packing, Random& random) {
  const std::vector<int> disks = zoo::random_order(packing.disk_count(), random);
  const std::vector<int> contacts = zoo::random_order(packing.contact_count(), random);
  const auto mapped = [disks, contacts](const ForceRanges& ranges) {
    ForceRanges result = permuted(ranges, contacts);
    for (std::int32_t& body : result.reactions.body) {
      if (body >= 0)
        body = static_cast<std::int32_t>(std::find(disks.begin(), disks.end(), body) - disks.begin());
    }
    return result;
  };
  return {"in another order", zoo::permuted(packing, disks, contacts), mapped, {}};
}

/// By powers of two, so that no bit changes.
View in_powers_of_two(const Packing& packing, double length, double mass, double acceleration) {
  return {
      "in other units, powers of two",
      zoo::rescaled(packing, length, mass, acceleration),
      [=](const ForceRanges& ranges) { return rescaled_with_torques(ranges, length, mass * acceleration); },
      {}};
}

View in_other_units(const Packing& packing, double length, double mass, double acceleration) {
  View view = in_powers_of_two(packing, length, mass, acceleration);
  view.name = "in other units";
  view.nearness.rounds = true;
  // Masses and loads were rounded, too, and no bound of what that does is stored.
  view.nearness.except = {"/ranges/lower"};
  return view;
}

View in_another_force_unit(const Packing& packing, double factor) {
  View view{"with another named unit", packing, {}, {}};
  view.keeps_method = false;
  view.packing.named_force_unit = packing.force_unit() * factor;
  view.mapped = [unit = view.packing.named_force_unit](const ForceRanges& ranges) {
    return in_force_unit(ranges, unit);
  };
  view.nearness.rounds = true;
  // An interval that is narrow enough, relative to at least 1 mg, may be too wide relative to another.
  view.nearness.except = {"/ranges/outcome",         "/equilibrium@certified", "/equilibrium@imprecise",
                          "/equilibrium@enclosed",   "/ranges/d_min_outcome",  "/equilibrium@failed",
                          "/equilibrium@determined", "/reactions/outcome"};
  return view;
}

View turned_by(const Packing& packing, double angle) {
  View view{"turned", zoo::rotated(packing, angle), as_it_is, {}};
  view.nearness.rounds = true;
  view.nearness.turn = 2e-15;    // of normals, gravity and loads
  view.keeps_reactions = false;  // those of a fixed disk turn, and have no sensitivity
  return view;
}

double angle_between(const Vector2& a, const Vector2& b) {
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

/// Normals follow from positions, which lose digits.
View shifted(const Packing& packing, const Vector2& by) {
  View view{"shifted", packing, as_it_is, {}};
  for (Disk& disk : view.packing.disks) disk.position += by;
  for (Wall& wall : view.packing.walls) wall.point += by;
  for (Contact& contact : view.packing.contacts) {
    const Vector2 before = contact.normal;
    contact.normal = geometric_normal(view.packing, contact.a, contact.b, contact.image);
    view.nearness.turn = std::max(view.nearness.turn, angle_between(before, contact.normal));
  }
  view.nearness.turn += 1e-15;
  view.nearness.rounds = true;
  view.keeps_reactions = false;  // they have no sensitivity
  return view;
}

/// Every second contact of the floor is with another wall at its place.
View with_a_wall_twice(const Packing& packing) {
  View view{"with a wall twice", packing, as_it_is, {}};
  Wall copy = packing.walls.front();
  copy.id = 1000;
  copy.name = "copy";
  view.packing.walls.push_back(copy);
  bool is_second = false;
  for (Contact& contact : view.packing.contacts) {
    if (!contact.b.is_wall() || contact.b.wall_id().value() != 0) continue;
    if (is_second) contact.b = Body::wall(WallId(packing.wall_count()));
    is_second = !is_second;
  }
  view.keeps_reactions = false;                                      // each of both has its share
  view.nearness.except = {"/duals/bounding", "/duals/multipliers"};  // the scene has more rows
  return view;
}

/// One more disk that touches nothing, as heavy as the mean, whose load cancels its weight.
View with_a_loose_disk(const Packing& packing) {
  View view{"with a loose disk", packing, as_it_is, {}};
  Disk loose = packing.disks.front();
  loose.id = 1000;
  loose.fixed = false;
  loose.position += Vector2(0, 100);
  loose.mass = 0;
  int free = 0;
  for (const Disk& disk : packing.disks) {
    if (disk.fixed) continue;
    loose.mass += disk.mass;
    ++free;
  }
  loose.mass /= free;
  loose.load << -loose.mass * packing.gravity, 0;
  view.packing.disks.push_back(loose);
  view.nearness.rounds = true;  // of the mean weight
  // The scene has more rows.
  view.nearness.except = {"/equilibrium/motion", "/duals/bounding", "/duals/multipliers"};
  return view;
}

struct Request {
  const char* name;
  AnalyzeOptions options;
  double tolerance;
};

std::vector<Request> requests() {
  AnalyzeOptions programs;
  programs.method = Method::kLp;
  programs.smallest_distances = true;
  AnalyzeOptions barrier;
  barrier.method = Method::kBarrier;
  barrier.states.kind = StateChoice::Kind::kNone;
  barrier.duals.kind = DualChoice::Kind::kAll;
  AnalyzeOptions estimates = barrier;
  estimates.duals.kind = DualChoice::Kind::kNone;
  estimates.estimate = EstimateOptions{0, 1};
  // Values of the barrier method are within gap; its centre within 1e-6 of its ellipsoid.
  return {{"linear programs", programs, 1e-9}, {"barrier", barrier, 1e-5}, {"estimates", estimates, 1e-4}};
}

/// Nothing where no estimates can be had.
std::optional<ForceRanges> results(const Packing& packing, const AnalyzeOptions& options) {
  try {
    return analyze(packing, options);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

Packing random_scene(std::uint64_t seed) {
  Random random(1000 + seed);
  Packing packing = zoo::random_pile(seed, 6 + static_cast<int>(random.below(6)),
                                     seed % 3 == 0 ? -1 : 0.15 * static_cast<double>(1 + seed % 4));
  if (seed % 4 == 1) {
    for (Disk& disk : packing.disks)
      disk.load << random.uniform(-0.05, 0.05), random.uniform(-0.3, 0.1), random.uniform(-0.02, 0.02);
  }
  if (seed % 5 == 2) packing.disks[random.below(packing.disks.size())].fixed = true;
  if (seed % 3 == 1) packing.named_force_unit = 2.5;
  if (seed % 2 == 0) {
    const ForceRanges ranges = analyze(packing);
    for (int k = 0; k < packing.contact_count() && ranges.states.rows() > 0; ++k) {
      packing.contacts[static_cast<std::size_t>(k)].R = ranges.states(0, 2 * k);
      packing.contacts[static_cast<std::size_t>(k)].T = ranges.states(0, 2 * k + 1);
    }
  }
  return packing;
}

std::vector<View> views_of(const Packing& packing, std::uint64_t seed) {
  Random random(seed);
  return {in_other_order(packing, random),
          {"with bodies of contacts swapped", zoo::with_bodies_swapped(packing), as_it_is, {}},
          {"mirrored", zoo::mirrored(packing), mirrored, {}},
          in_powers_of_two(packing, 0x1p20, 1, 1),
          in_powers_of_two(packing, 1, 0x1p-40, 1),
          in_powers_of_two(packing, 0x1p-20, 0x1p30, 0x1p-20),
          in_other_units(packing, 1e-6, 1e6, 9.81e-3),
          in_another_force_unit(packing, 0.37),
          in_another_force_unit(packing, 64),
          turned_by(packing, random.uniform(0.1, 6)),
          shifted(packing, {1e6, -1e6}),
          with_a_wall_twice(packing),
          with_a_loose_disk(packing)};
}

Comparisons compare_views(std::uint64_t first_seed, std::uint64_t last_seed, std::set<std::string>& told) {
  Comparisons comparisons;
  for (std::uint64_t seed = first_seed; seed <= last_seed; ++seed) {
    const Packing packing = random_scene(seed);
    for (const Request& request : requests()) {
      const std::optional<ForceRanges> ranges = results(packing, request.options);
      if (ranges) told.merge(told_fields(*ranges));
      for (View& view : views_of(packing, seed)) {
        std::optional<ForceRanges> found = results(view.packing, request.options);
        const bool is_alike = found ? ranges && found->method == ranges->method : !ranges;
        if (!is_alike && !view.keeps_method) {
          ++comparisons.by_another_method;
          continue;
        }
        EXPECT_EQ(found.has_value(), ranges.has_value()) << seed << " " << view.name << ", " << request.name;
        if (!found || !ranges) continue;
        ForceRanges expected = view.mapped(*ranges);
        if (!view.keeps_reactions) expected.reactions = found->reactions = {};
        view.nearness.tolerance = request.tolerance;
        EXPECT_TRUE(keeps_rules(expected, *found, view.nearness))
            << "scene " << seed << " " << view.name << ", by " << request.name;
        ++comparisons.made;
      }
    }
  }
  return comparisons;
}

}  // namespace indet::test
