#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/ensemble/presentation/limit_figures.h"
#include "apps/ensemble/presentation/limit_quantities.h"

namespace indet {
namespace {

/// The mean of those that have a limit, and how many have none.
std::string text_of_values(std::vector<double> values, int digits) {
  const auto without = std::erase_if(values, [](double value) { return std::isinf(value); });
  const std::string mean = text_of(mean_of(values), digits);
  return without == 0 ? mean : fmt::format("{}, {} without limit", mean, without);
}

}  // namespace

std::vector<std::vector<std::string>> limit_summary(const EnsembleTables& tables) {
  const std::vector<Family> families = families_with_limits(tables);
  if (families.empty()) return {};
  std::vector<std::vector<std::string>> rows = {{""}, {"packings whose least tilt is known"}};
  for (const Family& family : families) {
    rows[0].emplace_back(family.name());
    const std::vector<double> values = values_of(tables, family.protocol, kTiltOfAny);
    const auto known =
        std::count_if(values.begin(), values.end(), [](double value) { return !std::isnan(value); });
    rows[1].push_back(fmt::format("{} of {}", known, values.size()));
  }
  rows[0].insert(rows[0].end(), {"CD − MD", "more stable"});
  rows[1].insert(rows[1].end(), {"", ""});
  for (const LimitQuantity& quantity : limit_quantities()) {
    std::vector<std::string> row = {quantity.name};
    for (const Family& family : families)
      row.push_back(text_of_values(values_of(tables, family.protocol, quantity), quantity.digits));
    const Estimate difference = difference_of_methods(tables, quantity);
    row.push_back(text_of(difference, quantity.digits));
    row.push_back(more_stable(difference, quantity));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace indet
