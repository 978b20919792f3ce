#include "apps/ranges_report.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/contradiction.h"
#include "apps/distance_report.h"
#include "apps/estimate_report.h"
#include "apps/kept_states.h"
#include "apps/paper_work.h"
#include "apps/ranges_json.h"
#include "apps/sample_report.h"
#include "apps/say.h"
#include "apps/statistics.h"
#include "apps/wording.h"
#include "libindet/base/tolerances.h"

namespace indet::app {
namespace {

/// How firmly the values stand, in force units. Values that are infinite, or were not found, are left out.
struct Firmness {
  int values = 0;
  int half_open = 0;            ///< values with an enclosure that is infinite on one side or on both
  double widest_enclosure = 0;  ///< of the others
  double sensitivity = 0;       ///< largest first-order change of a value per radian by which normals turn
  int unlimited = 0;            ///< values for which no bound of it is known
};

Firmness firmness(const ForceRanges& ranges) {
  Firmness result;
  for (Eigen::Index i = 0; i < ranges.value.rows(); ++i) {
    for (int column = 0; column < 4; ++column) {
      if (!std::isfinite(ranges.value(i, column))) continue;
      const double width = (ranges.upper(i, column) - ranges.lower(i, column)) / ranges.force_unit;
      ++result.values;
      if (std::isfinite(width))
        result.widest_enclosure = std::max(result.widest_enclosure, width);
      else
        ++result.half_open;
      const double moved = ranges.sensitivity.value(i, column) / ranges.force_unit;
      if (std::isinf(moved))
        ++result.unlimited;
      else
        result.sensitivity = std::fmax(result.sensitivity, moved);
    }
  }
  return result;
}

struct MovingDisk {
  int index = 0;
  Vector3 motion;
};

/// The disks that move when the packing cannot stand, the fastest first.
std::vector<MovingDisk> moving_disks(const ForceRanges& ranges) {
  std::vector<MovingDisk> disks;
  for (Eigen::Index i = 0; i < ranges.motion.rows(); ++i) {
    const Vector3 motion = ranges.motion.row(i).transpose();
    if (motion.norm() > tolerance::kMotionEntry) disks.push_back({static_cast<int>(i), motion});
  }
  std::stable_sort(disks.begin(), disks.end(), [](const MovingDisk& a, const MovingDisk& b) {
    return a.motion.norm() > b.motion.norm();
  });
  return disks;
}

/// How the packing moves where no state is admissible.
void add_motion(const Packing& packing, const ForceRanges& ranges, nlohmann::json& json) {
  for (const MovingDisk& disk : moving_disks(ranges)) {
    json["moving_disks"].push_back({{"index", disk.index},
                                    {"id", packing[DiskId(disk.index)].id},
                                    {"motion", {disk.motion.x(), disk.motion.y(), disk.motion.z()}}});
  }
  for (Eigen::Index w = 0; w < ranges.wall_motion.rows(); ++w) {
    const auto motion = ranges.wall_motion.row(w);
    if (motion.norm() <= tolerance::kMotionEntry) continue;
    json["moving_walls"].push_back(
        {{"index", w}, {"id", packing[WallId(w)].id}, {"motion", {motion[0], motion[1]}}});
  }
  if (ranges.cell_motion.rows() > 0) {
    const auto& e = ranges.cell_motion;
    json["cell_motion"] = {{e(0, 0), e(0, 1)}, {e(1, 0), e(1, 1)}};
  }
}

}  // namespace

nlohmann::json report_to_json(const Packing& packing, const ForceRanges& ranges, const std::string& output) {
  const Statistics delta_R = statistics(ranges.delta_R);
  const Statistics delta_T = statistics(ranges.delta_T);
  const Statistics d_R = statistics(ranges.d_R);
  const Statistics d_T = statistics(ranges.d_T);
  nlohmann::json json = summary_to_json(ranges);
  json.update({{"output", output},
               {"disks", packing.disk_count()},
               {"fixed_disks", packing.fixed_disk_count()},
               {"contacts", packing.contact_count()},
               {"expected_dim", packing.expected_dimension()},
               {"unique", ranges.unique.cast<int>().sum()},
               {"states", ranges.states.rows()},
               {"extremal_states", to_string(ranges.state_kind)},
               {"states_of", to_string(ranges.states_of)},
               {"duals", ranges.duals.contacts.size()},
               {"widest_enclosure", json_number(firmness(ranges).widest_enclosure)},
               {"infinite_enclosures", firmness(ranges).half_open},
               {"sensitivity", json_number(firmness(ranges).sensitivity)},
               {"infinite_sensitivities", firmness(ranges).unlimited},
               {"mean_delta_R", json_number(delta_R.mean)},
               {"max_delta_R", json_number(delta_R.max)},
               {"mean_delta_T", json_number(delta_T.mean)},
               {"max_delta_T", json_number(delta_T.max)},
               {"mean_d_R", json_number(d_R.mean)},
               {"max_d_R", json_number(d_R.max)},
               {"mean_d_T", json_number(d_T.mean)},
               {"max_d_T", json_number(d_T.max)},
               {"seconds", ranges.seconds}});
  if (has_smallest_distances(ranges)) json["smallest_distances"] = smallest_distances_to_json(ranges);
  if (ranges.calibration >= 0) json["estimates"] = estimates_to_json(ranges);
  if (ranges.choice == ContactChoice::Kind::kSample) json["sample"] = sample_to_json(ranges);
  if (ranges.reactions.count() > 0) json["reactions"] = reactions_to_json(packing, ranges.reactions);
  if (ranges.method == Method::kPivotingPaper) json["paper"] = describe_paper_work(ranges);
  if (ranges.largest_norm >= 0)
    json["largest_norm"] = json_number(ranges.norm[ranges.largest_norm] / ranges.force_unit);
  const std::vector<std::string> contradiction = describe_contradiction(packing, ranges);
  if (contradiction.empty()) {
    add_motion(packing, ranges, json);
  } else {
    json["contradiction"] = contradiction;
  }
  if (ranges.status == PolytopeStatus::kUnbounded) {
    json["rays"] = ranges.rays.rows();
  }
  return json;
}

namespace {

void print_motion(const Packing& packing, const ForceRanges& ranges) {
  if (const auto contradiction = describe_contradiction(packing, ranges); !contradiction.empty()) {
    if (!ranges.doubtful)
      say("No contact forces balance the load, keep to friction and to the bounds of forces.\n");
    for (const std::string& line : contradiction) say("{}.\n", line);
    return;
  }
  say("The packing cannot stand: no contact forces within the friction cones balance the load.\n"
      "It can move as follows, with the load and against no contact (velocity x, y, and radius × "
      "rotation):\n");
  const std::vector<MovingDisk> disks = moving_disks(ranges);
  constexpr std::size_t kShown = 10;
  for (std::size_t i = 0; i < std::min(kShown, disks.size()); ++i) {
    say("  disk {:<6} {:+.3f}  {:+.3f}  {:+.3f}\n", packing[DiskId(disks[i].index)].id, disks[i].motion.x(),
        disks[i].motion.y(), disks[i].motion.z());
  }
  if (disks.size() > kShown) say("  … and {} more\n", disks.size() - kShown);
  for (Eigen::Index w = 0; w < ranges.wall_motion.rows(); ++w) {
    const auto motion = ranges.wall_motion.row(w);
    if (motion.norm() <= tolerance::kMotionEntry) continue;
    say("  wall {:<6} {:+.3f} along its normal, {:+.3f} along its tangent\n", wall_name(packing[WallId(w)]),
        motion[0], motion[1]);
  }
  if (ranges.cell_motion.rows() > 0) {
    const auto& e = ranges.cell_motion;
    say("  the cell shrinks {:+.3f} along x, {:+.3f} along y, shears {:+.3f} (x against y)\n", e(0, 0),
        e(1, 1), e(0, 1));
  }
}

void print_extremes(const Packing& packing, const ForceRanges& ranges) {
  constexpr std::size_t kShown = 5;
  std::vector<Eigen::Index> order;
  for (Eigen::Index i = 0; i < ranges.delta_R.size(); ++i) {
    if (!std::isnan(ranges.delta_R[i])) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return ranges.delta_R[a] > ranges.delta_R[b]; });
  say("\nlargest δR      contact     bodies        R_min     R_max     T_min     T_max   (mg)\n");
  for (std::size_t i = 0; i < std::min(kShown, order.size()); ++i) {
    const Eigen::Index k = order[i];
    Eigen::Array4d value = ranges.value.row(k).transpose() / ranges.force_unit;
    // 4e-15 is rounding around 0; the file has the digits.
    for (double& v : value) v = std::abs(v) < tolerance::kPrintedZero ? 0 : v;
    say("{:>10.4g} {:>12}     {:<12} {:>8.4g}  {:>8.4g}  {:>8.4g}  {:>8.4g}\n", ranges.delta_R[k], k,
        contact_name(packing, ContactId(k)), value[kMinR], value[kMaxR], value[kMinT], value[kMaxT]);
  }
}

/// How many extrema were found, and how firmly they stand.
void print_quality(const ForceRanges& ranges) {
  const bool has_estimates = ranges.calibration >= 0;
  if (has_estimates && ranges.objectives == 0) return;
  say("{}: {} certified{}, {} imprecise, {} failed\n", counted(ranges.objectives, "extremum", "extrema"),
      ranges.certified, ranges.unbounded > 0 ? fmt::format(" ({} of them unbounded)", ranges.unbounded) : "",
      ranges.imprecise, ranges.failed);
  if (ranges.enclosed < ranges.certified)
    say("largest residuals: {:.1e} of balance and friction, {:.1e} of optimality\n",
        ranges.worst_primal_residual, ranges.worst_dual_residual);
  if (ranges.reactions.uncertain() > 0) {
    say("of {} of walls and fixed disks, {} imprecise or failed\n",
        counted(2 * ranges.reactions.count(), "extremum", "extrema"), ranges.reactions.uncertain());
  }
  const Firmness firm = firmness(ranges);
  const std::string open = firm.half_open > 0 ? fmt::format("; {} of {} values lack a finite bound on a side",
                                                            firm.half_open, firm.values)
                                              : "";
  if (firm.half_open < firm.values)
    say("proven bounds of a value: at most {:.1e} mg apart{}\n", firm.widest_enclosure, open);
  else if (firm.values > 0)
    say("proven bounds of a value: none that are finite on both sides\n");
  constexpr double kTurn = 1e-8;
  const std::string unlimited =
      firm.unlimited > 0 ? fmt::format("; {} of {} may change by any amount", firm.unlimited, firm.values)
                         : "";
  if (firm.unlimited < firm.values)
    say("if contact directions are known to 1e-8 rad, {} value is good to {:.1e} mg{}\n",
        firm.unlimited > 0 ? "a" : "every", kTurn * firm.sensitivity, unlimited);
  else if (firm.values > 0)
    say("if contact directions are known to 1e-8 rad, every value may change by any amount\n");
  const int unique = ranges.unique.cast<int>().sum();
  const bool had_choice = !ranges.reason.empty() && (ranges.method == Method::kBarrier ||
                                                     ranges.state_kind == StateChoice::Kind::kNone);
  if (had_choice) say("method {}: {}\n", to_string(ranges.method), ranges.reason);
  if (has_estimates) return say("found by {}\n", describe_method(ranges));
  // Of an interval it is not known how many states attain the value.
  const bool has_states = ranges.method != Method::kBarrier || ranges.states.rows() > 0;
  if (has_states) {
    say("found by {}; {} of {} {} attained by a single state\n", describe_method(ranges), unique,
        counted(ranges.objectives, "extremum", "extrema"), unique == 1 ? "is" : "are");
  } else {
    say("found by {}\n", describe_method(ranges));
  }
  say("{}\n", describe_kept_states(ranges));
  if (has_smallest_distances(ranges)) say("{}\n", describe_smallest_distances(ranges));
  if (ranges.duals.are_kept()) say("{}\n", describe_duals(ranges.duals));
}

/// What lies within rounding, and who decided it.
void print_doubts(const ForceRanges& ranges) {
  const bool is_hairline = !std::isnan(ranges.hairline);
  if (ranges.rank_ambiguous) {
    say("The rank is ambiguous: rounding does not tell whether a singular value is zero (smallest that was "
        "counted: {:.1e}, largest that was not: {:.1e}).",
        ranges.smallest_accepted, ranges.largest_rejected);
  } else if (ranges.doubtful || is_hairline) {
    say("Whether forces balance, or stay bounded, depends here on the last digits of the packing's "
        "numbers{}.",
        is_hairline ? fmt::format(": a relative change of about {:.0e} may alter it", ranges.hairline) : "");
  }
  if (ranges.doubtful) {
    say(" Every result is marked imprecise; --accuracy exact decides in small packings, for the numbers as "
        "they are.\n");
  } else if (ranges.exact && (ranges.rank_ambiguous || is_hairline)) {
    say(" Exact arithmetic decided, for the numbers as they are.\n");
  } else if (ranges.exact) {
    say("All results are those of exact arithmetic.\n");
  } else if (ranges.rank_ambiguous || is_hairline) {
    say("\n");
  }
}

}  // namespace

void print_report(const Packing& packing, const ForceRanges& ranges, const std::string& output) {
  say("{}, {}: {} unknown forces, {} equations, rank {}, nullity {}\n", describe_disks(packing),
      counted(packing.contact_count(), "contact"), ranges.unknowns, ranges.equations, ranges.rank,
      ranges.nullity);
  print_doubts(ranges);
  if (ranges.status == PolytopeStatus::kEmpty) {
    print_motion(packing, ranges);
    say("\nwritten to {}\n", output);
    return;
  }
  const std::string blocks = ranges.blocks >= 0 ? ", " + counted(ranges.blocks, "independent block") : "";
  say("polytope of contact states: {}, dimension {} ({}){}\n", to_string(ranges.status), ranges.dim,
      describe_expected_dimension(packing), blocks);
  if (!ranges.blocks_reason.empty())
    say("number of independent blocks: not known, {}\n", ranges.blocks_reason);
  if (ranges.sliding >= 0)
    say("simulated state: {}\n", describe_sliding(ranges.sliding, ranges.non_transmitting));
  if (ranges.choice == ContactChoice::Kind::kSample || ranges.choice == ContactChoice::Kind::kList)
    say("asked for: {} of {}\n", ranges.requested, counted(packing.contact_count(), "contact"));
  print_quality(ranges);
  if (ranges.method == Method::kPivotingPaper) print_paper_work(ranges.paper);
  const bool has_smallest = has_smallest_distances(ranges);
  const auto line = [&](const char* name, const Eigen::VectorXd& values) {
    const Statistics s = statistics(values);
    say("  {:<{}}   mean {:>9.4g}   max {:>9.4g}\n", name, has_smallest ? 6 : 2, s.mean, s.max);
  };
  if (ranges.calibration >= 0) {
    print_estimates(packing, ranges);
  } else if (packing.contact_count() > 0) {
    say("\nindeterminacy{} (mg)\n", ranges.draws > 0 ? " of the contacts that were drawn" : "");
    line("δR", ranges.delta_R);
    line("δT", ranges.delta_T);
    if (ranges.states.rows() > 0) {
      line("dR", ranges.d_R);
      line("dT", ranges.d_T);
    }
    if (has_smallest) {
      line("dR_min", ranges.smallest.d_R);
      line("dT_min", ranges.smallest.d_T);
    }
    if (ranges.choice == ContactChoice::Kind::kSample) print_sample(packing, ranges);
    print_extremes(packing, ranges);
  }
  double total = 0;
  for (const auto& [stage, seconds] : ranges.seconds) total += seconds;
  say("\nwritten to {} ({:.2f} s)\n", output, total);
}

}  // namespace indet::app
