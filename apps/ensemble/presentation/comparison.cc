#include "apps/ensemble/presentation/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/ensemble/presentation/curves.h"
#include "apps/ensemble/presentation/figure_comparison.h"
#include "apps/ensemble/presentation/smallest_distance_summary.h"
#include "apps/ensemble/presentation/verdict.h"
#include "apps/ensemble/presentation/which_states.h"

namespace indet {
namespace {

using sim::Protocol;

/// "95", or "12 … 40".
std::string span_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (low == values.end()) return "–";
  return *low == *high ? fmt::format("{:g}", *low) : fmt::format("{:g} … {:g}", *low, *high);
}

void add_dimensions(const EnsembleTables& tables, std::vector<Comparison>& rows) {
  const FlatTable& runs = tables.runs;
  int outside = 0;
  int above = 0;
  for (std::size_t row = 0; row < runs.rows(); ++row) {
    const double bound = runs.number("lower_bound", row);
    const double excess = runs.number("dim", row) - bound;
    if (excess < 0 || excess > 3) ++outside;
    if (runs.number("sliding", row) > bound) ++above;
  }
  rows.push_back({"dim F between 2M − 3N and 2M − 3N + 3 (Fig. 6a)", "all 240",
                  fmt::format("{} of {}", runs.rows() - static_cast<std::size_t>(outside), runs.rows()),
                  verdict_of(outside == 0)});
  rows.push_back({"sliding contacts Ms ≤ 2M − 3N (Fig. 6b)", "all 240",
                  fmt::format("{} of {}", runs.rows() - static_cast<std::size_t>(above), runs.rows()),
                  verdict_of(above == 0)});
}

/// Where the paper's walk ends in a state that is not as expected, a mean over packings.
void add_walks(const EnsembleTables& tables, std::vector<Comparison>& rows) {
  std::vector<double> percent;
  for (std::size_t row = 0; row < tables.runs.rows(); ++row) {
    const double walks = tables.runs.number("paper_walks", row);
    if (walks > 0) percent.push_back(100 * tables.runs.number("paper_failures", row) / walks);
  }
  if (percent.empty()) return;
  const Estimate ours = mean_of(percent);
  rows.push_back({"extremal states with other than dim F sliding contacts, the paper's walk (Sec. II G)",
                  "about 1 %", text_of(ours) + " %", verdict_about(ours, 1)});
}

}  // namespace

std::vector<Comparison> compare_with_paper(const EnsembleTables& tables) {
  std::vector<Comparison> rows;
  const Samples samples(tables);
  if (!samples.has(kFourProtocols)) return rows;
  add_dimensions(tables, rows);
  add_sliding_contacts(samples, rows);
  for (const Family& family : kFamilies) {
    if (!samples.has({family.protocol})) continue;
    const Estimate mean = mean_of(samples.runs(family.protocol, "mean_R"));
    const bool is_known = family.protocol == Protocol::kCd1;
    rows.push_back({fmt::format("mean R, {}", family.name()), is_known ? "9.3 mg" : kNotGiven,
                    text_of(mean, 1, "mg"), is_known ? verdict(mean, 9.3, 0) : kNotDecided});
  }
  for (const Family& family : kFamilies) {
    const std::vector<double> values = samples.runs(family.protocol, "r");
    const Estimate r = mean_of(values);
    if (std::isnan(r.value)) continue;
    const double deviation = standard_deviation(values);
    rows.push_back(
        {fmt::format("r of perturb-and-resolve [38], {}", family.name()),
         fmt::format("{} mg, s.d. 12 mg", paper_radius(family)),
         text_of(r, 1, "mg") + (std::isnan(deviation) ? "" : fmt::format(", s.d. {:.1f} mg", deviation)),
         verdict(r, family.paper_r, family.paper_r_error)});
  }
  struct Distance {
    const char* name;
    Protocol protocol;
    const char* column;
    double value, error;
  };
  for (const Distance& d : {Distance{"distance CD-1 – CD-2", Protocol::kCd2, "distance_cd1", 50, 3},
                            Distance{"distance CD-1 – MD-2", Protocol::kMd2, "distance_cd1", 75, 4},
                            Distance{"distance MD-2 – CD-2", Protocol::kMd2, "distance_cd2", 45, 3}}) {
    const Estimate ours = mean_of(samples.runs(d.protocol, d.column));
    if (std::isnan(ours.value)) continue;
    rows.push_back({d.name, fmt::format("{:g} ± {:g} mg", d.value, d.error), text_of(ours, 1, "mg"),
                    verdict(ours, d.value, d.error)});
  }
  for (const bool md : {false, true}) {
    const Protocols& protocols = md ? kMd : kCd;
    if (!samples.has(protocols)) continue;
    const double paper = md ? 75 : 60;
    for (const char component : {'R', 'T'}) {
      for (const WhichStates& choice : kChoicesOfStates) {
        const GroupedValues data =
            samples.of(protocols, component == 'R' ? choice.normal : choice.tangential);
        if (!(largest(data) > 0)) continue;
        const Estimate ours = main_maximum(data);
        rows.push_back(
            {fmt::format("main maximum of d{}, {}, {} (Fig. 8)", component, md ? "MD" : "CD", choice.name),
             fmt::format("≈ {:g} mg", paper), std::isnan(ours.value) ? "none" : text_of(ours, 1, "mg"),
             std::isnan(ours.value) ? kDiffers : verdict_about(ours, paper)});
      }
    }
  }
  add_walks(tables, rows);
  add_densities(samples, rows);
  if (!reason_for_no_verdict(tables).empty()) {
    for (Comparison& row : rows) row.verdict.clear();
  }
  return rows;
}

std::string reason_for_no_verdict(const EnsembleTables& tables) {
  constexpr int kDisks = 95;
  constexpr double kFriction = 0.3;
  const std::vector<double> disks = tables.runs.numbers("disks");
  const std::vector<double> friction = tables.contacts.numbers("mu");
  const auto as_in_paper = [](const std::vector<double>& values, double paper) {
    return std::all_of(values.begin(), values.end(), [&](double value) { return value == paper; });
  };
  if (as_in_paper(disks, kDisks) && as_in_paper(friction, kFriction)) return "";
  return fmt::format("The paper's numbers are for N = {} and μ = {:g}; here N = {} and μ = {}.", kDisks,
                     kFriction, span_of(disks), span_of(friction));
}

std::vector<Comparison> beyond_the_paper(const EnsembleTables& tables) {
  const FlatTable& runs = tables.runs;
  std::vector<Comparison> rows;
  if (runs.rows() == 0) return rows;
  int equal = 0;
  double primal = 0;
  double dual = 0;
  for (std::size_t row = 0; row < runs.rows(); ++row) {
    if (runs.number("dim", row) == runs.number("nullity", row)) ++equal;
    primal = std::fmax(primal, runs.number("worst_primal_residual", row));
    dual = std::fmax(dual, runs.number("worst_dual_residual", row));
  }
  const double objectives = runs.sum("objectives");
  rows.push_back({"dim F equals the nullity", "", fmt::format("{} of {} packings", equal, runs.rows()), ""});
  rows.push_back(
      {"minima and maxima certified", "", fmt::format("{} of {}", runs.sum("certified"), objectives), ""});
  rows.push_back(
      {"imprecise, failed", "", fmt::format("{}, {}", runs.sum("imprecise"), runs.sum("failed")), ""});
  rows.push_back(
      {"unbounded", "",
       fmt::format("{} ({:.2g} %)", runs.sum("unbounded"), 100 * runs.sum("unbounded") / objectives), ""});
  rows.push_back({"attained by one state only", "",
                  fmt::format("{} ({:.2g} %)", runs.sum("unique"), 100 * runs.sum("unique") / objectives),
                  ""});
  if (runs.sum("samples") > 0) {
    rows.push_back({"perturbed solutions accepted", "",
                    fmt::format("{} of {}", runs.sum("accepted"), runs.sum("samples")), ""});
  }
  rows.push_back({"largest residuals", "",
                  fmt::format("{:.1e} of balance and friction, {:.1e} of optimality", primal, dual), ""});
  add_smallest_distances(tables, rows);
  return rows;
}

}  // namespace indet
