#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/ensemble/presentation/samples.h"
#include "apps/ensemble/tables/ensemble_tables.h"
#include "apps/ensemble/tables/figure.h"
#include "libindet/statistics/distribution.h"

namespace indet {

/// What the captions of densities say.
constexpr const char* kDensity =
    "Probability densities, normalised over all values, those beyond the axis included. Bars: standard error "
    "by bootstrap over the seeds.";

/// The paper's four protocols as they are drawn, and the radius r [38] that it found for them (mg).
struct Family {
  sim::Protocol protocol;
  int colour;
  int symbol;
  double paper_r;
  double paper_r_error;

  const char* name() const { return properties_of(protocol).paper_name; }
  bool is_md() const { return is_simulated_by(protocol, sim::Simulator::kMolecularDynamics); }
  /// What MD is drawn with, unlike CD.
  Mark mark() const { return is_md() ? Mark::kDashed : Mark::kLine; }
};
constexpr std::array<Family, 4> kFamilies = {{{sim::Protocol::kCd1, 0, 0, 33, 1.4},
                                              {sim::Protocol::kCd2, 1, 1, 34, 1.3},
                                              {sim::Protocol::kMd1, 2, 2, 41, 1.7},
                                              {sim::Protocol::kMd2, 3, 3, 40, 1.5}}};

/// Their protocols: all, and by simulator.
inline const Protocols kFourProtocols = {sim::kSimulated.begin(), sim::kSimulated.end()};
inline const Protocols kCd = {sim::Protocol::kCd1, sim::Protocol::kCd2};
inline const Protocols kMd = {sim::Protocol::kMd1, sim::Protocol::kMd2};

/// "33 ± 1.4".
std::string paper_radius(const Family& family);

/// The fraction of packings whose value is at most x, a step at each of them. Those without a value do not
/// count.
Series fraction_up_to(const Family& family, std::vector<double> values, double low, double high);

/// Two columns of the runs of a protocol, one point per packing.
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
