#include "apps/ensemble/presentation/samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libindet/base/tolerances.h"

namespace indet {
namespace {

bool contains(const Protocols& protocols, sim::Protocol protocol) {
  return std::find(protocols.begin(), protocols.end(), protocol) != protocols.end();
}

/// Numbers groups anew, so that each has a value: what only some packings have must not seem to vary by
/// resamples of those that lack it.
void number_groups_with_values(GroupedValues& data) {
  std::map<int, int> numbers;
  for (std::size_t i = 0; i < data.values.size(); ++i) {
    if (!std::isnan(data.values[i])) numbers.emplace(data.group[i], 0);
  }
  int count = 0;
  for (auto& [group, number] : numbers) number = count++;
  for (int& group : data.group) group = numbers.contains(group) ? numbers.at(group) : 0;
  data.groups = count;
}

}  // namespace

std::string text_of(const Estimate& estimate, int digits) {
  if (std::isnan(estimate.value)) return "–";
  if (std::isnan(estimate.error)) return fmt::format("{:.{}f}", estimate.value, digits);
  return fmt::format("{:.{}f} ± {:.{}f}", estimate.value, digits, estimate.error, digits);
}

std::string text_of(const Estimate& estimate, int digits, const char* unit) {
  const std::string number = text_of(estimate, digits);
  return std::isnan(estimate.value) ? number : fmt::format("{} {}", number, unit);
}

double largest(const GroupedValues& data) {
  double high = 0;
  for (const double value : data.values) {
    if (std::isfinite(value)) high = std::max(high, value);
  }
  return high;
}

double round_width(double span, int bins) {
  const double raw = std::max(span / bins, tolerance::kNarrowestBin);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10 * power;
}

Estimate main_maximum(const GroupedValues& data) {
  const double high = quantile(data, 0.99);
  return high > 0 ? position_of_maximum(data, 0.05 * high, high, round_width(high, 40)) : Estimate{};
}

Samples::Samples(const EnsembleTables& tables) : tables_(tables), protocols_(protocols_of(tables.runs)) {
  std::map<std::int64_t, int> numbers;
  for (std::size_t row = 0; row < tables.runs.rows(); ++row) {
    const auto seed = static_cast<std::int64_t>(tables.runs.number("seed", row));
    // Packings without a seed are independent.
    const int number = seed < 0 ? groups_ : numbers.try_emplace(seed, groups_).first->second;
    group_.push_back(number);
    groups_ = std::max(groups_, number + 1);
  }
}

bool Samples::has(const Protocols& protocols) const {
  return std::any_of(protocols_.begin(), protocols_.end(),
                     [&](sim::Protocol protocol) { return contains(protocols, protocol); });
}

bool Samples::has_values(const std::string& column) const {
  const std::vector<double> values = tables_.contacts.numbers(column);
  return std::any_of(values.begin(), values.end(), [](double v) { return !std::isnan(v); });
}

GroupedValues Samples::of(const Protocols& protocols, const std::string& column) const {
  GroupedValues result;
  const std::vector<double> run = tables_.contacts.numbers("run");
  const std::vector<double> values = tables_.contacts.numbers(column);
  std::vector<bool> wanted;
  for (const sim::Protocol protocol : protocols_) wanted.push_back(contains(protocols, protocol));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto row = static_cast<std::size_t>(run[i]);
    if (wanted[row]) result.add(values[i], group_[row]);
  }
  number_groups_with_values(result);
  return result;
}

double Samples::mean_force(sim::Protocol protocol) const { return mean_of(of({protocol}, "R").values).value; }

GroupedValues Samples::split_by_force(sim::Protocol protocol, const std::string& column, bool strong) const {
  const GroupedValues force = of({protocol}, "R");
  const GroupedValues all = of({protocol}, column);
  const double mean = mean_of(force.values).value;
  GroupedValues result;
  for (std::size_t i = 0; i < all.values.size(); ++i) {
    if ((force.values[i] > mean) == strong) result.add(all.values[i], all.group[i]);
  }
  result.groups = all.groups;
  return result;
}

GroupedValues Samples::extremal(sim::Protocol protocol, int objective, bool solver) const {
  GroupedValues result;
  const FlatTable& table = tables_.extremal;
  const std::vector<double> run = table.numbers("run");
  const std::vector<double> choice = table.numbers("choice");
  const std::vector<double> kind = table.numbers("objective");
  const std::vector<double> bin = table.numbers("bin");
  const std::vector<double> count = table.numbers("count");
  for (std::size_t i = 0; i < run.size(); ++i) {
    const auto row = static_cast<std::size_t>(run[i]);
    if (choice[i] == (solver ? 1 : 0) && kind[i] == objective && protocols_[row] == protocol)
      result.add(bin[i] + 0.5, group_[row], count[i]);
  }
  result.groups = groups_;
  return result;
}

GroupedValues Samples::sampled(const Protocols& protocols, const std::string& quantity, int sampling) const {
  GroupedValues result;
  const FlatTable& table = tables_.sampled;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const auto row = static_cast<std::size_t>(table.number("run", i));
    if (table.number("sampling", i) != sampling || table.text("quantity", i) != quantity) continue;
    if (!contains(protocols, protocols_[row])) continue;
    result.add(table.number("low", i) + table.number("width", i) / 2, group_[row],
               table.number("contacts", i));
  }
  result.groups = groups_;
  return result;
}

std::vector<double> Samples::runs(sim::Protocol protocol, const std::string& column) const {
  std::vector<double> result;
  for (std::size_t row = 0; row < tables_.runs.rows(); ++row) {
    if (protocols_[row] == protocol) result.push_back(tables_.runs.number(column, row));
  }
  return result;
}

}  // namespace indet
