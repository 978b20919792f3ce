#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/ensemble/tables/figure.h"
#include "apps/ensemble/tables/table.h"
#include "libindet/statistics/distribution.h"

namespace indet {

/// What the captions of densities say.
constexpr const char* kDensity =
    "Probability densities, normalised over all values, those beyond the axis included. Bars: standard error "
    "by bootstrap over the seeds.";

/// The four protocols as they are named and drawn, and the radius r [38] that the paper found for them (mg).
struct Family {
  const char* protocol;
  const char* name;
  int colour;
  int symbol;
  double paper_r;
  double paper_r_error;
};
constexpr std::array<Family, 4> kFamilies = {{{"cd1", "CD-1", 0, 0, 33, 1.4},
                                              {"cd2", "CD-2", 1, 1, 34, 1.3},
                                              {"md1", "MD-1", 2, 2, 41, 1.7},
                                              {"md2", "MD-2", 3, 3, 40, 1.5}}};

/// "33 ± 1.4".
std::string paper_radius(const Family& family);

/// Two columns of the runs of a protocol, one point a packing.
Series scatter(const EnsembleTables& tables, const Family& family, const char* x, const char* y);

/// Values and how their density is drawn.
struct Curve {
  const char* name;
  GroupedValues data;
  Mark mark;
  int colour;
  bool thick;
};

/// The density in bins of `width` from `low` to `high`, which are the ends of the axis too. On a logarithmic
/// axis a density of 0 is a gap.
Panel panel_of(const std::vector<Curve>& curves, const char* label, bool logarithmic, double high,
               double width, double low = 0);

double largest_of(const std::vector<Curve>& curves);

/// Where a linear axis ends: beyond it are at most 0.5 % of the values of each curve.
double end_of_axis(const std::vector<Curve>& curves);

}  // namespace indet
