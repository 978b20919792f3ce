#include "apps/ensemble/presentation/limit_quantities.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "apps/ensemble/presentation/verdict.h"

namespace indet {
namespace {

double degrees(double angle) { return angle * 180 / std::numbers::pi; }

/// NaN where either is unknown.
double smaller_angle(const FlatTable& runs, std::size_t run, const char* smallest, const char* largest) {
  const double clockwise = std::abs(runs.number(smallest, run));
  const double counter_clockwise = std::abs(runs.number(largest, run));
  return clockwise <= counter_clockwise ? degrees(clockwise) : degrees(counter_clockwise);
}

double larger_angle(const FlatTable& runs, std::size_t run) {
  const double smallest = std::abs(runs.number("tilt_of_several_smallest", run));
  const double largest = std::abs(runs.number("tilt_of_several_largest", run));
  return smallest > largest ? degrees(smallest) : degrees(largest);
}

/// A count of the state at the smaller tilt of several disks; NaN where it is not known.
double count_there(const FlatTable& runs, std::size_t run, const std::string& count) {
  const double smallest = std::abs(runs.number("tilt_of_several_smallest", run));
  const double largest = std::abs(runs.number("tilt_of_several_largest", run));
  if (std::isnan(smallest) || std::isnan(largest)) return std::nan("");
  const char* end = smallest <= largest ? "smallest" : "largest";
  const double value = runs.number("tilt_of_several_" + std::string(end) + "_" + count, run);
  return value < 0 ? std::nan("") : value;
}

double column(const FlatTable& runs, std::size_t run, const char* name) { return runs.number(name, run); }

}  // namespace

const LimitQuantity kTiltOfAny = {"tilt at which some disk moves, the smaller of both ways (°)", 2,
                                  LargeMeans::kStable, [](const FlatTable& runs, std::size_t run) {
                                    return smaller_angle(runs, run, "tilt_smallest", "tilt_largest");
                                  }};
const LimitQuantity kTiltOfSeveral = {"tilt at which several disks move, the smaller of both ways (°)", 2,
                                      LargeMeans::kStable, [](const FlatTable& runs, std::size_t run) {
                                        return smaller_angle(runs, run, "tilt_of_several_smallest",
                                                             "tilt_of_several_largest");
                                      }};
const LimitQuantity kLoadOnTop = {
    "largest load on the highest disk (mg)", 1, LargeMeans::kStable,
    [](const FlatTable& runs, std::size_t run) { return column(runs, run, "load_on_top"); }};
const LimitQuantity kLeastFriction = {
    "least friction (of the coefficient)", 3, LargeMeans::kUnstable,
    [](const FlatTable& runs, std::size_t run) { return column(runs, run, "least_friction"); }};
const LimitQuantity kSlidingThere = {
    "Ms of the state at the tilt of several disks", 1, LargeMeans::kNeither,
    [](const FlatTable& runs, std::size_t run) { return count_there(runs, run, "sliding"); }};
const LimitQuantity kDimensionThere = {
    "dim F left there", 1, LargeMeans::kNeither,
    [](const FlatTable& runs, std::size_t run) { return count_there(runs, run, "dim"); }};
const LimitQuantity kDimensionsLeft = {
    "dim F left there / (2M − 3N)", 3, LargeMeans::kNeither, [](const FlatTable& runs, std::size_t run) {
      return count_there(runs, run, "dim") / runs.number("tilt_of_several_lower_bound", run);
    }};

std::vector<LimitQuantity> limit_quantities() {
  const LimitQuantity left_out = {"disks that move alone before, taken out", 2, LargeMeans::kNeither,
                                  [](const FlatTable& runs, std::size_t run) {
                                    const double disks = column(runs, run, "tilt_left_out");
                                    return disks < 0 ? std::nan("") : disks;
                                  }};
  const LimitQuantity larger = {"… the larger of both ways (°)", 2, LargeMeans::kStable, larger_angle};
  const LimitQuantity excess = {
      "… less 2M − 3N", 2, LargeMeans::kNeither, [](const FlatTable& runs, std::size_t run) {
        return count_there(runs, run, "sliding") - runs.number("tilt_of_several_lower_bound", run);
      }};
  return {kTiltOfAny,     left_out,      kTiltOfSeveral, larger,          kLoadOnTop,
          kLeastFriction, kSlidingThere, excess,         kDimensionThere, kDimensionsLeft};
}

std::vector<double> values_of(const EnsembleTables& tables, sim::Protocol protocol,
                              const LimitQuantity& quantity) {
  std::vector<double> values;
  const Protocols protocols = protocols_of(tables.runs);
  for (std::size_t run = 0; run < protocols.size(); ++run) {
    if (protocols[run] == protocol) values.push_back(quantity.of(tables.runs, run));
  }
  return values;
}

Estimate difference_of_methods(const EnsembleTables& tables, const LimitQuantity& quantity) {
  struct OfSeed {
    std::vector<double> cd, md;
  };
  std::map<std::int64_t, OfSeed> seeds;
  const Protocols protocols = protocols_of(tables.runs);
  for (std::size_t run = 0; run < protocols.size(); ++run) {
    const double value = quantity.of(tables.runs, run);
    if (!std::isfinite(value)) continue;
    OfSeed& seed = seeds[static_cast<std::int64_t>(tables.runs.number("seed", run))];
    if (is_simulated_by(protocols[run], sim::Simulator::kContactDynamics)) seed.cd.push_back(value);
    if (is_simulated_by(protocols[run], sim::Simulator::kMolecularDynamics)) seed.md.push_back(value);
  }
  std::vector<double> differences;
  for (const auto& [number, seed] : seeds) {
    if (!seed.cd.empty() && !seed.md.empty())
      differences.push_back(mean_of(seed.cd).value - mean_of(seed.md).value);
  }
  return mean_of(differences);
}

std::string more_stable(const Estimate& difference, const LimitQuantity& quantity) {
  if (quantity.large == LargeMeans::kNeither || std::isnan(difference.error)) return "";
  if (std::abs(difference.value) <= 2 * difference.error) return kNotDecided;
  return (difference.value > 0) == (quantity.large == LargeMeans::kStable) ? "CD" : "MD";
}

std::vector<Family> families_with_limits(const EnsembleTables& tables) {
  std::vector<Family> families;
  for (const Family& family : kFamilies) {
    for (const LimitQuantity& quantity : {kTiltOfAny, kLoadOnTop, kLeastFriction}) {
      const std::vector<double> values = values_of(tables, family.protocol, quantity);
      if (std::all_of(values.begin(), values.end(), [](double value) { return std::isnan(value); })) continue;
      families.push_back(family);
      break;
    }
  }
  return families;
}

}  // namespace indet
