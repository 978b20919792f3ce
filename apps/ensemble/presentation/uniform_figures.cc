#include "apps/ensemble/presentation/uniform_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/ensemble/presentation/curves.h"
#include "apps/ensemble/presentation/samples.h"
#include "libindet/statistics/two_sample.h"

namespace indet {
namespace {

double largest_of(const std::vector<Series>& series) {
  double high = 0;
  for (const Series& s : series) {
    for (const double y : s.y) high = std::fmax(high, y);
  }
  return high;
}

Series line(const char* name, double x, double y) {
  return {.name = name, .x = {0, x}, .y = {0, y}, .mark = Mark::kDotted, .colour = 7, .thick = false};
}

/// Families with a value in a column of the runs.
std::vector<Family> families_with(const Samples& samples, const char* column) {
  std::vector<Family> result;
  for (const Family& family : kFamilies) {
    const std::vector<double> values = samples.runs(family.protocol, column);
    if (std::any_of(values.begin(), values.end(), [](double v) { return !std::isnan(v); }))
      result.push_back(family);
  }
  return result;
}

Figure radii(const EnsembleTables& tables, const Samples& samples) {
  std::vector<std::string> radii_of_paper;
  for (const Family& f : kFamilies)
    radii_of_paper.push_back(fmt::format("{} ({})", paper_radius(f), f.name()));
  Figure figure{
      .id = "uniform-r",
      .title = "Radius and centre of both samplings",
      .caption =
          "Left: the radius r [38] of perturb-and-resolve against that of the uniform distribution over the "
          "same polytope, one point per packing. Right: the distance of the two centres, the noise of "
          "both means taken away, against the uniform r. Dotted: equal.",
      .claim =
          fmt::format("r in mg: {}. Whether perturb-and-resolve weights all regions rightly is left open.",
                      fmt::join(radii_of_paper, ", ")),
      .finding = "",
      .panels = {}};
  for (const char* label : {"r [38] (mg)", "distance of centres (mg)"}) {
    figure.panels.push_back({.title = "",
                             .x = {.label = "r, uniform (mg)"},
                             .y = {.label = label},
                             .series = {},
                             .legend_left = true});
  }
  for (const Family& family : families_with(samples, "bias_ratio")) {
    figure.panels[0].series.push_back(scatter(tables, family, "uniform_r", "r"));
    figure.panels[1].series.push_back(scatter(tables, family, "uniform_r", "bias_shift"));
    const auto mean = [&](const char* column) { return mean_of(samples.runs(family.protocol, column)); };
    figure.finding += fmt::format(
        "{}: r is {} mg uniformly and {} mg by perturb-and-resolve, {} times as large; the centres are {} mg "
        "apart. ",
        family.name(), text_of(mean("uniform_r"), 1), text_of(mean("r"), 1), text_of(mean("bias_ratio"), 2),
        text_of(mean("bias_shift"), 1));
  }
  const double end = 1.1 * largest_of(figure.panels[0].series);
  for (Panel& panel : figure.panels) panel.series.push_back(line("equal", end, end));
  return figure;
}

/// The same quantity under both samplings, for CD and MD.
std::vector<Curve> both_samplings(const Samples& samples, const char* quantity) {
  std::vector<Curve> curves;
  for (const bool md : {false, true}) {
    for (const int sampling : {0, 1}) {
      GroupedValues data = samples.sampled(md ? kMd : kCd, quantity, sampling);
      if (data.values.empty()) continue;
      const char* name = md ? (sampling == 0 ? "MD, uniform" : "MD, perturb")
                            : (sampling == 0 ? "CD, uniform" : "CD, perturb");
      curves.push_back({name, std::move(data), sampling == 0 ? Mark::kLine : Mark::kDashed,
                        (md ? 2 : 0) + sampling, sampling == 0});
    }
  }
  return curves;
}

Figure forces(const Samples& samples) {
  const std::vector<Curve> pooled = both_samplings(samples, "R");
  const std::vector<Curve> standard = both_samplings(samples, "standard_R");
  std::string finding = "Decay lengths beyond 30 mg. ";
  for (const Curve& c : pooled) {
    const TailFit fit = fit_tail(c.data, 30);
    finding += fmt::format("{}: {}. ", c.name, text_of(fit.decay, 2, "mg"));
  }
  finding += "Standardised forces beyond ±2: ";
  for (const Curve& c : standard) {
    const Estimate inside = fraction_between(c.data, -2, 2);
    finding +=
        fmt::format("{}: {}. ", c.name, text_of({100 * (1 - inside.value), 100 * inside.error}, 2, "%"));
  }
  const double width = std::max(1.0, round_width(largest_of(pooled), 40));
  std::vector<Panel> panels = {panel_of(pooled, "R (mg)", true, std::ceil(largest_of(pooled)), width),
                               panel_of(standard, "(R − mean)/deviation", true, 6, 0.25, -6)};
  for (Panel& panel : panels) panel.legend_below = true;
  return {
      .id = "uniform-forces",
      .title = "Normal forces under both samplings",
      .caption = fmt::format(
          "Left: R of all contacts in all states. Right: R of each contact less its mean under the uniform "
          "distribution, divided by its standard deviation there. {}",
          kDensity),
      .claim = "",
      .finding = finding,
      .panels = panels};
}

Figure uniform_places(const Samples& samples) {
  Figure figure{
      .id = "uniform-places",
      .title = "Places in the ranges: simulated, uniform, perturb-and-resolve",
      .caption = fmt::format("R* [39] of all contacts of CD (left) and MD packings (right): in the simulated "
                             "states, and in all states of both samplings. {}",
                             kDensity),
      .claim = "R* of the simulated states depends on their history more than on the method (Fig. 11).",
      .finding = "Mean R*. ",
      .panels = {}};
  for (const bool md : {false, true}) {
    std::vector<Curve> curves;
    for (const Family& f : kFamilies) {
      if (f.is_md() == md)
        curves.push_back({f.name(), samples.of({f.protocol}, "R_star"), Mark::kLine, f.colour, true});
    }
    const Protocols& protocols = md ? kMd : kCd;
    curves.push_back({"uniform", samples.sampled(protocols, "R_star", 0), Mark::kLine, 7, false});
    curves.push_back({"perturb", samples.sampled(protocols, "R_star", 1), Mark::kDashed, 4, false});
    Panel panel = panel_of(curves, "R*", false, 1, 0.05);
    panel.title = md ? "MD" : "CD";
    panel.legend_below = true;
    figure.panels.push_back(panel);
    for (const Curve& c : curves) {
      if (c.data.values.empty()) continue;
      const bool sampled = c.name[0] == 'u' || c.name[0] == 'p';
      const Estimate low = fraction_between(c.data, 0, 0.05);
      figure.finding +=
          fmt::format("{}{}: {}, {} below 0.05. ", c.name, sampled ? (md ? " (MD)" : " (CD)") : "",
                      text_of(grouped_mean(c.data), 3), text_of({100 * low.value, 100 * low.error}, 1, "%"));
    }
  }
  return figure;
}

/// The fraction of values that are at most x, for x = 0 … 1.
Series cumulative(const char* name, const GroupedValues& data, Mark mark, int colour) {
  Series series{.name = name, .x = {}, .y = {}, .error = {}, .mark = mark, .colour = colour};
  for (int i = 0; i <= 50; ++i) {
    const double x = i / 50.0;
    const Estimate fraction = fraction_between(data, -1, std::nextafter(x, 2.0), {.resamples = 100});
    series.x.push_back(x);
    series.y.push_back(fraction.value);
    series.error.push_back(fraction.error);
  }
  return series;
}

Figure tests(const Samples& samples) {
  Figure figure{
      .id = "uniform-tests",
      .title = "Two-sample tests of every contact",
      .caption =
          "Fraction of contacts whose p-value is at most p: that the mean of R (left), or its distribution "
          "(right), is the same under perturb-and-resolve and under the uniform distribution; with effective "
          "sample sizes, for contacts that have at least 20 effective states. Control: one half of the "
          "uniform "
          "chains against the other. Dotted: what is expected if they are equal; the test of distributions "
          "is "
          "cautious and stays below. Bars: standard error by bootstrap over the seeds.",
      .claim = "",
      .finding = "Contacts with p ≤ 0.05, of which there would be 5 % if both samplings were the same. ",
      .panels = {}};
  const Protocols& all = kFourProtocols;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string column = i == 0 ? "p_mean" : "p_distribution";
    Panel panel{.title = i == 0 ? "means" : "distributions",
                .x = {.label = "p", .low = 0, .high = 1},
                .y = {.label = "fraction of contacts", .low = 0, .high = 1.05},
                .series = {},
                .legend_below = true};
    const auto add = [&](const char* name, const GroupedValues& data, Mark mark, int colour) {
      if (std::none_of(data.values.begin(), data.values.end(), [](double p) { return !std::isnan(p); }))
        return;
      panel.series.push_back(cumulative(name, data, mark, colour));
      const Estimate small = fraction_between(data, -1, std::nextafter(0.05, 1.0));
      figure.finding += fmt::format("{} {}: {}. ", i == 0 ? "Means," : "Distributions,", name,
                                    text_of({100 * small.value, 100 * small.error}, 1, "%"));
    };
    add("CD", samples.of(kCd, column), Mark::kLine, 0);
    add("MD", samples.of(kMd, column), Mark::kDashed, 3);
    add("control", samples.of(all, column + "_control"), Mark::kLine, 2);
    panel.series.push_back(line("equal", 1, 1));
    figure.panels.push_back(panel);
  }
  return figure;
}

/// The cumulative distribution over packings of a percentile.
Panel percentiles(const Samples& samples, const char* column, const char* label, std::string& finding) {
  Panel panel{.title = "",
              .x = {.label = label, .low = 0, .high = 100},
              .y = {.label = "fraction of packings", .low = 0, .high = 1.05},
              .series = {},
              .legend_below = true};
  finding += fmt::format("Mean {}", label);
  for (const Family& family : families_with(samples, column)) {
    const std::vector<double> values = samples.runs(family.protocol, column);
    panel.series.push_back(fraction_up_to(family, values, 0, 100));
    const Estimate mean = mean_of(values);
    std::vector<double> fractions;
    for (const double value : values) {
      if (!std::isnan(value)) fractions.push_back(value / 100);
    }
    const double p = uniformity_probability(fractions);
    finding += fmt::format("{} {} {}{}", panel.series.size() == 1 ? ":" : ",", family.name(),
                           text_of(mean, 1), std::isnan(p) ? std::string() : fmt::format(" (p = {:.1g})", p));
  }
  finding += ". ";
  panel.series.push_back(line("equal", 100, 1));
  return panel;
}

Figure states(const Samples& samples, const char* id, const char* title,
              const std::pair<const char*, const char*>& left,
              const std::pair<const char*, const char*>& right) {
  Figure figure{
      .id = id,
      .title = title,
      .caption =
          "Fraction of packings in which the percentile of the simulated state among the uniform "
          "samples of its polytope is at most that on the axis. Dotted: all states equally likely.",
      .claim = "",
      .finding =
          "50 if all states are equally likely; p, of four packings or more: probability of percentiles "
          "as far from uniform as these (Kolmogorov–Smirnov). ",
      .panels = {}};
  for (const auto& [column, label] : {left, right})
    figure.panels.push_back(percentiles(samples, column, label, figure.finding));
  return figure;
}

}  // namespace

std::vector<Figure> uniform_figures(const EnsembleTables& tables) {
  const Samples samples(tables);
  if (families_with(samples, "uniform_r").empty()) return {};
  std::vector<Figure> figures;
  if (!families_with(samples, "bias_ratio").empty()) {
    figures = {radii(tables, samples), forces(samples), uniform_places(samples), tests(samples)};
  }
  if (!families_with(samples, "uniform_norm_percentile").empty()) {
    figures.push_back(states(samples, "uniform-states", "Simulated states among uniform ones: norm and R*",
                             {"uniform_norm_percentile", "percentile of ‖F‖"},
                             {"uniform_R_star_percentile", "percentile of the mean R*"}));
    figures.push_back(states(samples, "uniform-friction",
                             "Simulated states among uniform ones: mobilised friction and distance",
                             {"uniform_mobilisation_percentile", "percentile of the mean |T|/(μR)"},
                             {"uniform_distance_percentile", "percentile of the distance from the centre"}));
  }
  return figures;
}

}  // namespace indet
