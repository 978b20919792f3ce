#include "apps/ensemble/presentation/limit_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/ensemble/presentation/limit_quantities.h"

namespace indet {
namespace {

Panel cumulative_panel(const EnsembleTables& tables, const LimitQuantity& quantity, const char* label,
                       double low, double high, std::string& finding) {
  Panel panel{.title = "",
              .x = {.label = label, .low = low, .high = high},
              .y = {.label = "fraction of packings", .low = 0, .high = 1.05},
              .series = {},
              .legend_below = true};
  for (const Family& family : families_with_limits(tables))
    panel.series.push_back(fraction_up_to(family, values_of(tables, family.protocol, quantity), low, high));
  const Estimate difference = difference_of_methods(tables, quantity);
  finding += fmt::format("{}: CD − MD = {}", quantity.name, text_of(difference, quantity.digits));
  const std::string stable = more_stable(difference, quantity);
  finding += stable == "CD" || stable == "MD" ? fmt::format(", {} is more stable. ", stable)
                                              : ", which is not decided. ";
  return panel;
}

/// At least what 95 of 100 packings have.
double upper_end(const EnsembleTables& tables, const LimitQuantity& quantity, double step) {
  std::vector<double> values;
  for (const Family& family : families_with_limits(tables)) {
    for (const double value : values_of(tables, family.protocol, quantity)) {
      if (std::isfinite(value)) values.push_back(value);
    }
  }
  if (values.empty()) return step;
  std::sort(values.begin(), values.end());
  const double value = values[(values.size() - 1) * 95 / 100];
  return step * std::max(1.0, std::ceil(value / step));
}

constexpr const char* kCaption =
    "Fraction of packings whose limit is at most that on the axis; beyond it, no contact forces balance the "
    "load (docs/limits.md). ";

Figure tilts(const EnsembleTables& tables) {
  Figure figure{.id = "limits-tilt",
                .title = "How far can the packings be tilted?",
                .caption = std::string(kCaption) +
                           "The smaller of both ways. Left: at which some disk moves, most often one that "
                           "lies loosely and rolls away. Right: at which several disks move, those that move "
                           "alone being taken out before.",
                .claim =
                    "packings of contact dynamics are much more stable than those of molecular "
                    "dynamics, as they have fewer sliding contacts.",
                .finding = "",
                .panels = {}};
  figure.panels.push_back(cumulative_panel(tables, kTiltOfAny, "tilt at which some disk moves (°)", 0,
                                           upper_end(tables, kTiltOfAny, 1), figure.finding));
  figure.panels.push_back(cumulative_panel(tables, kTiltOfSeveral, "tilt at which several disks move (°)", 0,
                                           upper_end(tables, kTiltOfSeveral, 1), figure.finding));
  return figure;
}

Figure loads(const EnsembleTables& tables) {
  Figure figure{.id = "limits-load",
                .title = "What can the highest disk carry, and how little friction is enough?",
                .caption = std::string(kCaption) +
                           "Left: load along gravity on the highest disk. Right: the least factor of all "
                           "coefficients of friction; the smaller, the more stable.",
                .claim = "",
                .finding = "",
                .panels = {}};
  figure.panels.push_back(cumulative_panel(tables, kLoadOnTop, "largest load on the highest disk (mg)", 0,
                                           upper_end(tables, kLoadOnTop, 5), figure.finding));
  figure.panels.push_back(
      cumulative_panel(tables, kLeastFriction, "least friction / μ", 0, 1, figure.finding));
  return figure;
}

Figure dimensions_left(const EnsembleTables& tables) {
  Figure figure{.id = "limits-dimension",
                .title = "What is left of F at the limit",
                .caption =
                    "Left: sliding contacts Ms of the state at the smaller tilt of several disks, "
                    "against 2M − 3N. Right: the dimension of F that is left there. Dotted: equal.",
                .claim =
                    "a packing that is slowly loaded should yield when its sliding contacts reach 2M − "
                    "3N, where one state is left.",
                .finding = "",
                .panels = {}};
  const LimitQuantity bound = {"", 0, LargeMeans::kNeither, [](const FlatTable& runs, std::size_t run) {
                                 const double value = runs.number("tilt_of_several_lower_bound", run);
                                 return value < 0 ? std::nan("") : value;
                               }};
  struct Of {
    const LimitQuantity& quantity;
    const char* label;
  };
  for (const Of& of : {Of{kSlidingThere, "Ms at the limit"}, Of{kDimensionThere, "dim F at the limit"}}) {
    Panel panel{
        .title = "", .x = {.label = "2M − 3N"}, .y = {.label = of.label}, .series = {}, .legend_left = true};
    double end = 0;
    for (const Family& family : families_with_limits(tables)) {
      Series series{.name = family.name(),
                    .x = values_of(tables, family.protocol, bound),
                    .y = values_of(tables, family.protocol, of.quantity),
                    .mark = Mark::kPoints,
                    .colour = family.colour,
                    .symbol = family.symbol};
      for (const double x : series.x) end = std::fmax(end, 1.1 * x);
      panel.series.push_back(std::move(series));
    }
    panel.series.push_back(
        {.name = "equal", .x = {0, end}, .y = {0, end}, .mark = Mark::kDotted, .colour = 7, .thick = false});
    figure.panels.push_back(std::move(panel));
  }
  for (const Family& family : families_with_limits(tables)) {
    figure.finding += fmt::format(
        "{}: {} of 2M − 3N dimensions are left. ", family.name(),
        text_of(mean_of(values_of(tables, family.protocol, kDimensionsLeft)), kDimensionsLeft.digits));
  }
  return figure;
}

}  // namespace

std::vector<Figure> limit_figures(const EnsembleTables& tables) {
  if (families_with_limits(tables).empty()) return {};
  return {tilts(tables), loads(tables), dimensions_left(tables)};
}

}  // namespace indet
