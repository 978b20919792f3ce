#include "apps/ensemble/presentation/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"

namespace indet {
namespace {

Series curve(const std::string& name, const GroupedValues& data, double low, double width, double high,
             Mark mark, int colour, bool thick, bool logarithmic) {
  const int bins = std::max(1, static_cast<int>(std::ceil((high - low) / width - tolerance::kLastPartOfBin)));
  const Histogram h = histogram(data, low, width, bins, {.resamples = 100});
  Series series{.name = name, .x = {}, .y = {}, .error = {}, .mark = mark, .colour = colour, .thick = thick};
  for (std::size_t bin = 0; bin < h.density.size(); ++bin) {
    series.x.push_back(h.center(bin));
    series.y.push_back(logarithmic && h.density[bin] <= 0 ? kNaN : h.density[bin]);
    series.error.push_back(h.error[bin]);
  }
  return series;
}

}  // namespace

std::string paper_radius(const Family& family) {
  return fmt::format("{:g} ± {:g}", family.paper_r, family.paper_r_error);
}

Series fraction_up_to(const Family& family, std::vector<double> values, double low, double high) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  std::sort(values.begin(), values.end());
  Series series{.name = family.name(), .x = {low}, .y = {0}, .mark = family.mark(), .colour = family.colour};
  const auto n = static_cast<double>(values.size());
  for (std::size_t i = 0; i < values.size() && values[i] <= high; ++i) {
    series.x.insert(series.x.end(), 2, values[i]);
    series.y.push_back(static_cast<double>(i) / n);
    series.y.push_back(static_cast<double>(i + 1) / n);
  }
  series.x.push_back(high);
  series.y.push_back(series.y.back());
  return series;
}

Series scatter(const EnsembleTables& tables, const Family& family, const char* x, const char* y) {
  Series series{.name = family.name(),
                .x = {},
                .y = {},
                .mark = Mark::kPoints,
                .colour = family.colour,
                .symbol = family.symbol};
  const Protocols protocols = protocols_of(tables.runs);
  for (std::size_t row = 0; row < protocols.size(); ++row) {
    if (protocols[row] != family.protocol) continue;
    series.x.push_back(tables.runs.number(x, row));
    series.y.push_back(tables.runs.number(y, row));
  }
  return series;
}

Panel panel_of(const std::vector<Curve>& curves, const char* label, bool logarithmic, double high,
               double width, double low) {
  Panel panel{.title = "",
              .x = {.label = label, .low = low, .high = high},
              .y = {.label = "probability density", .logarithmic = logarithmic},
              .series = {}};
  for (const Curve& c : curves) {
    if (c.data.values.empty()) continue;
    panel.series.push_back(curve(c.name, c.data, low, width, high, c.mark, c.colour, c.thick, logarithmic));
  }
  if (!logarithmic) {
    for (const Series& series : panel.series) {
      for (const double y : series.y) panel.y.high = std::max(panel.y.high, 1.15 * y);
    }
  }
  return panel;
}

double largest_of(const std::vector<Curve>& curves) {
  double high = 0;
  for (const Curve& c : curves) high = std::max(high, largest(c.data));
  return high;
}

double end_of_axis(const std::vector<Curve>& curves) {
  double high = 0;
  for (const Curve& c : curves) {
    if (!c.data.values.empty()) high = std::fmax(high, quantile(c.data, 0.995));
  }
  return high;
}

}  // namespace indet
