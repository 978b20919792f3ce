#include "apps/ensemble/presentation/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/ensemble/presentation/curves.h"

namespace indet {
namespace {

using sim::Protocol;

std::string verdict(const Estimate& ours, double paper, double paper_error) {
  if (std::isnan(ours.value) || std::isnan(ours.error)) return "";
  const double tolerance = 2 * std::hypot(ours.error, paper_error);
  return std::abs(ours.value - paper) <= tolerance ? "agrees" : "differs";
}

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
                  outside == 0 ? "agrees" : "differs"});
  rows.push_back({"sliding contacts Ms ≤ 2M − 3N (Fig. 6b)", "all 240",
                  fmt::format("{} of {}", runs.rows() - static_cast<std::size_t>(above), runs.rows()),
                  above == 0 ? "agrees" : "differs"});
}

}  // namespace

std::vector<Comparison> compare_with_paper(const EnsembleTables& tables) {
  std::vector<Comparison> rows;
  const Samples samples(tables);
  if (!samples.has(kFourProtocols)) return rows;
  add_dimensions(tables, rows);
  const std::array<const char*, 4> sliding = {"near 0", "near 0", "between", "most"};
  for (std::size_t p = 0; p < kFamilies.size(); ++p) {
    if (!samples.has({kFamilies[p].protocol})) continue;
    rows.push_back({fmt::format("sliding contacts, {} (Fig. 6b)", kFamilies[p].name()), sliding[p],
                    text_of(mean_of(samples.runs(kFamilies[p].protocol, "sliding"))), ""});
  }
  for (const Family& family : kFamilies) {
    if (!samples.has({family.protocol})) continue;
    const Estimate mean = mean_of(samples.runs(family.protocol, "mean_R"));
    const bool is_known = family.protocol == Protocol::kCd1;
    rows.push_back({fmt::format("mean R, {}", family.name()), is_known ? "9.3 mg" : "",
                    text_of(mean, 1, "mg"), is_known ? verdict(mean, 9.3, 0) : ""});
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
    for (const char* column : {"d_R", "solver_d_R", "d_T", "solver_d_T"}) {
      const GroupedValues data = samples.of(protocols, column);
      if (!(largest(data) > 0)) continue;
      const Estimate ours = main_maximum(data);
      const bool near = std::abs(ours.value - paper) <= std::max(0.1 * paper, 2 * ours.error);
      const bool solver = std::string(column).starts_with("solver");
      rows.push_back({fmt::format("main maximum of d{}, {}, {} (Fig. 8)", column[solver ? 9 : 2],
                                  md ? "MD" : "CD", solver ? "solver's vertices" : "canonical states"),
                      fmt::format("≈ {:g} mg", paper),
                      std::isnan(ours.value) ? "none" : text_of(ours, 1, "mg"), near ? "agrees" : "differs"});
    }
  }
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
  return rows;
}

}  // namespace indet
