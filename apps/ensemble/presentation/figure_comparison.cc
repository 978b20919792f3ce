#include "apps/ensemble/presentation/figure_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "apps/ensemble/presentation/curves.h"
#include "apps/ensemble/presentation/verdict.h"
#include "apps/ensemble/presentation/which_states.h"

namespace indet {
namespace {

using sim::Protocol;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Estimate percent(const Estimate& fraction) { return {100 * fraction.value, 100 * fraction.error}; }

/// Sliding contacts of the raw state, or of the polished one where the raw state is not known.
Estimate sliding_of(const Samples& samples, Protocol protocol) {
  const Estimate raw = mean_of(samples.runs(protocol, "raw_sliding"));
  return std::isnan(raw.value) ? mean_of(samples.runs(protocol, "sliding")) : raw;
}

/// The protocols that start from a grid, and from cd1 at rest, of one simulator.
struct Histories {
  const char* simulator;
  Protocol fallen, placed;
  std::string names() const {
    return fmt::format("{}, {}", properties_of(fallen).paper_name, properties_of(placed).paper_name);
  }
};
constexpr std::array<Histories, 2> kHistories = {
    {{"CD", Protocol::kCd1, Protocol::kCd2}, {"MD", Protocol::kMd1, Protocol::kMd2}}};

void add_local_indeterminacy(const Samples& samples, std::vector<Comparison>& rows) {
  for (const auto& [column, name] : {std::pair("delta_R", "δR"), std::pair("delta_T", "δT")}) {
    const GroupedValues cd = samples.of(kCd, column);
    const GroupedValues md = samples.of(kMd, column);
    for (const auto& [data, simulator] : {std::pair(&cd, "CD"), std::pair(&md, "MD")}) {
      if (!(largest(*data) > 0)) continue;
      // The mean excess of an exponential does not depend on where it is reckoned from.
      const Estimate tenth = fit_tail(*data, quantile(*data, 0.9)).decay;
      const Estimate end = fit_tail(*data, quantile(*data, 0.97)).decay;
      rows.push_back({fmt::format("{}, {}: tail (Fig. 7)", name, simulator), "exponential",
                      fmt::format("decay length of the largest 10 %: {}, 3 %: {}", text_of(tenth, 1, "mg"),
                                  text_of(end, 1, "mg")),
                      verdict(tenth, end.value, end.error)});
    }
    const Estimate mean_cd = grouped_mean(cd);
    const Estimate mean_md = grouped_mean(md);
    if (std::isnan(mean_cd.value) || std::isnan(mean_md.value)) continue;
    rows.push_back({fmt::format("mean {}, CD and MD (Fig. 7)", name), "MD slightly larger",
                    fmt::format("{}, {}", text_of(mean_cd, 1, "mg"), text_of(mean_md, 1, "mg")),
                    verdict_of_order(mean_md, mean_cd)});
  }
}

/// The share of CD-1 contacts near 0: of the weak, and of the strong ones.
void add_peak(const Samples& samples, const char* column, const std::string& name, double width,
              std::vector<Comparison>& rows) {
  const Estimate weak = fraction_between(samples.split_by_force(Protocol::kCd1, column, false), 0, width);
  const Estimate strong = fraction_between(samples.split_by_force(Protocol::kCd1, column, true), 0, width);
  if (std::isnan(weak.value) || std::isnan(strong.value)) return;
  rows.push_back({fmt::format("{} below {:g} mg, weak and strong contacts of CD-1", name, width),
                  "only weak ones",
                  fmt::format("{} %, {} %", text_of(percent(weak)), text_of(percent(strong))),
                  verdict_of(strong.value < 0.1 * weak.value)});
}

void add_places(const Samples& samples, std::vector<Comparison>& rows) {
  for (const auto& [column, name] : {std::pair("R_star", "R*"), std::pair("T_star", "T*")}) {
    const auto distance = [&, column = column](Protocol p, Protocol q) {
      return kolmogorov_distance(samples.of({p}, column), samples.of({q}, column));
    };
    const std::array<double, 2> history = {distance(Protocol::kCd1, Protocol::kCd2),
                                           distance(Protocol::kMd1, Protocol::kMd2)};
    const std::array<double, 2> method = {distance(Protocol::kCd1, Protocol::kMd1),
                                          distance(Protocol::kCd2, Protocol::kMd2)};
    const auto [low_history, high_history] = std::minmax(history[0], history[1]);
    const auto [low_method, high_method] = std::minmax(method[0], method[1]);
    const bool decided = low_history > high_method || high_history < low_method;
    rows.push_back({fmt::format("{}: largest difference of the distributions (Fig. 11)", name),
                    "history above method",
                    fmt::format("history {:.2f} (CD), {:.2f} (MD); method {:.2f} (1), {:.2f} (2)", history[0],
                                history[1], method[0], method[1]),
                    decided ? verdict_of(low_history > high_method) : kNotDecided});
  }
  const auto add = [&](const Histories& h, const char* what, const char* paper, const Estimate& fallen,
                       const Estimate& placed, int digits, const char* unit, bool fallen_larger) {
    if (std::isnan(fallen.value) || std::isnan(placed.value)) return;
    rows.push_back({fmt::format("{}: {} (Fig. 11)", what, h.names()), paper,
                    fmt::format("{}{}, {}{}", text_of(fallen, digits), unit, text_of(placed, digits), unit),
                    fallen_larger ? verdict_of_order(fallen, placed) : verdict_of_order(placed, fallen)});
  };
  for (const Histories& h : kHistories) {
    const GroupedValues fallen = samples.of({h.fallen}, "T_star");
    const GroupedValues placed = samples.of({h.placed}, "T_star");
    add(h, "mean R*", "larger after falling", grouped_mean(samples.of({h.fallen}, "R_star")),
        grouped_mean(samples.of({h.placed}, "R_star")), 3, "", true);
    add(h, "T* in 0.25 … 0.75", "more after falling", percent(fraction_between(fallen, 0.25, 0.75)),
        percent(fraction_between(placed, 0.25, 0.75)), 1, " %", true);
    const auto ends = [](const GroupedValues& data) {
      const Estimate inner = percent(fraction_between(data, 0.05, 0.95));
      return Estimate{100 - inner.value, inner.error};
    };
    add(h, "T* within 0.05 of an end", "fewer after falling", ends(fallen), ends(placed), 1, " %", false);
  }
}

void add_forces(const Samples& samples, std::vector<Comparison>& rows) {
  const GroupedValues simulated = samples.of({Protocol::kCd1}, "R");
  const Estimate beyond = percent(fraction_between(simulated, 60, kInfinity));
  for (const auto& [objective, name] : {std::pair(0, "smallest"), std::pair(1, "largest")}) {
    const GroupedValues extremal = samples.extremal(Protocol::kCd1, objective, samples.has_solver_states());
    if (extremal.values.empty()) continue;
    const Estimate ours = percent(fraction_between(extremal, 60, kInfinity));
    rows.push_back({fmt::format("R above 60 mg: CD-1, and its states of {} R (Fig. 12)", name),
                    "more in extremal states",
                    fmt::format("{} %, {} %", text_of(beyond, 2), text_of(ours, 2)),
                    verdict_of_order(ours, beyond)});
  }
  for (const Histories& h : kHistories) {
    const auto above = [&](Protocol protocol) {
      return percent(fraction_between(samples.of({protocol}, "R"), 40, kInfinity));
    };
    const Estimate fallen = above(h.fallen);
    const Estimate placed = above(h.placed);
    if (std::isnan(fallen.value) || std::isnan(placed.value)) continue;
    rows.push_back({fmt::format("R above 40 mg: {} (Fig. 13)", h.names()), "more after falling",
                    fmt::format("{} %, {} %", text_of(fallen, 2), text_of(placed, 2)),
                    verdict_of_order(fallen, placed)});
  }
}

}  // namespace

void add_sliding_contacts(const Samples& samples, std::vector<Comparison>& rows) {
  std::array<Estimate, 4> counts;
  for (std::size_t i = 0; i < kFamilies.size(); ++i) counts[i] = sliding_of(samples, kFamilies[i].protocol);
  const auto order = [](const Estimate& large, const Estimate& small) {
    return std::isnan(large.value) || std::isnan(small.value) ? kNotDecided : verdict_of_order(large, small);
  };
  /// Both must agree; one that differs decides.
  const auto both = [](const std::string& p, const std::string& q) {
    if (p == kDiffers || q == kDiffers) return kDiffers;
    return p == kAgrees && q == kAgrees ? kAgrees : kNotDecided;
  };
  const Estimate& cd = counts[0].value > counts[1].value ? counts[0] : counts[1];
  const std::array<const char*, 4> paper = {"near 0", "near 0", "between", "most"};
  const std::array<std::string, 4> verdicts = {verdict_of(counts[0].value < 1),
                                               verdict_of(counts[1].value < 1),
                                               both(order(counts[2], cd), order(counts[3], counts[2])),
                                               both(order(counts[3], counts[2]), order(counts[3], cd))};
  for (std::size_t i = 0; i < kFamilies.size(); ++i) {
    const Family& family = kFamilies[i];
    if (!samples.has({family.protocol})) continue;
    const Estimate raw = mean_of(samples.runs(family.protocol, "raw_sliding"));
    const Estimate polished = mean_of(samples.runs(family.protocol, "sliding"));
    const std::string ours = std::isnan(raw.value)
                                 ? text_of(polished)
                                 : fmt::format("{} raw, {} polished", text_of(raw), text_of(polished));
    rows.push_back(
        {fmt::format("sliding contacts, {} (Fig. 6b)", family.name()), paper[i], ours, verdicts[i]});
  }
}

void add_densities(const Samples& samples, std::vector<Comparison>& rows) {
  add_local_indeterminacy(samples, rows);
  add_peak(samples, "delta_R", "δR (Fig. 9)", 5, rows);
  for (const WhichStates& choice : {kCanonicalChoice, kWalkChoice, kNearestChoice})
    add_peak(samples, choice.normal, fmt::format("dR, {} (Fig. 10)", choice.name), 10, rows);
  if (samples.has(kCd) && samples.has(kMd)) add_places(samples, rows);
  add_forces(samples, rows);
}

}  // namespace indet
