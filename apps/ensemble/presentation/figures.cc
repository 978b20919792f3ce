#include "apps/ensemble/presentation/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "apps/ensemble/presentation/curves.h"
#include "apps/ensemble/presentation/limit_figures.h"
#include "apps/ensemble/presentation/samples.h"
#include "apps/ensemble/presentation/smallest_distance_summary.h"
#include "apps/ensemble/presentation/uniform_figures.h"
#include "apps/ensemble/presentation/which_states.h"
#include "libindet/base/constants.h"
#include "libindet/base/counted.h"
#include "libindet/range/analyze.h"
#include "libindet/statistics/distribution.h"

namespace indet {
namespace {

using sim::Protocol;

/// A disk of unit weight in a groove of two walls whose normals make `angle` with the vertical (Fig. 2 of the
/// paper).
Packing groove(double angle, double mu) {
  Packing packing;
  packing.gravity = {0, -1};
  packing.disks = {Disk{.id = 0, .radius = 1, .mass = 1, .inertia = 0.5}};
  for (const double sign : {1.0, -1.0}) {
    const Vector2 normal{sign * std::sin(angle), std::cos(angle)};
    packing.walls.push_back({.id = packing.wall_count(), .point = -normal, .normal = normal, .name = ""});
    packing.contacts.push_back(
        {.a = DiskId(0), .b = Body::wall(WallId(packing.wall_count() - 1)), .normal = normal, .mu = mu});
  }
  return packing;
}

Figure two_contacts() {
  constexpr double kMu = 0.3;
  const double limit = std::atan(1 / kMu);
  Series curve_R{.name = "δR [35]", .x = {}, .y = {}, .mark = Mark::kLine, .colour = 0};
  Series curve_T{.name = "δT [37]", .x = {}, .y = {}, .mark = Mark::kDashed, .colour = 1};
  Series ours_R{.name = "δR, linear programs", .x = {}, .y = {}, .mark = Mark::kPoints, .colour = 0};
  Series ours_T{
      .name = "δT, linear programs", .x = {}, .y = {}, .mark = Mark::kPoints, .colour = 1, .symbol = 1};
  const auto width = [](double phi) { return std::pow(std::cos(phi), 2) - std::pow(kMu * std::sin(phi), 2); };
  for (int i = 0; i <= 200; ++i) {
    const double phi = i * 0.002 * std::numbers::pi;
    if (phi >= limit) break;
    curve_R.x.push_back(phi / std::numbers::pi);
    curve_R.y.push_back(kMu * std::sin(phi) / width(phi));
    curve_T.x.push_back(phi / std::numbers::pi);
    curve_T.y.push_back(kMu * std::cos(phi) / width(phi));
  }
  double worst = 0;
  for (int i = 1; i <= 20; ++i) {
    const double phi = i * 0.02 * std::numbers::pi;
    if (phi >= limit) break;
    const ForceRanges ranges = analyze(groove(phi, kMu));
    ours_R.x.push_back(phi / std::numbers::pi);
    ours_R.y.push_back(ranges.delta_R[0]);
    ours_T.x.push_back(phi / std::numbers::pi);
    ours_T.y.push_back(ranges.delta_T[0]);
    worst = std::max({worst, std::abs(ranges.delta_R[0] * width(phi) / (kMu * std::sin(phi)) - 1),
                      std::abs(ranges.delta_T[0] * width(phi) / (kMu * std::cos(phi)) - 1)});
  }
  return {
      .id = "fig03",
      .title = "Fig. 3: one disk on two walls",
      .caption =
          "Local indeterminacy δ = (max − min)/mg of the normal and the tangential force of a disk in a "
          "symmetric groove whose normals make the angle φ with the vertical; μ = 0.3.",
      .claim =
          "δR = μ sin φ/(cos²φ − μ² sin²φ), δT = μ cos φ/(cos²φ − μ² sin²φ) [35, 37]; both diverge at tan φ "
          "= 1/μ.",
      .finding = fmt::format("Largest relative difference from the formulas: {:.1e}.", worst),
      .panels = {{.title = "",
                  .x = {.label = "φ/π", .low = 0, .high = 0.5},
                  .y = {.label = "δR, δT", .low = 0, .high = 2},
                  .series = {curve_R, curve_T, ours_R, ours_T},
                  .legend_left = true}}};
}

std::pair<double, double> limits(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low, *high};
}

/// Fig. 6a and b; for packings of one number of disks.
std::vector<Figure> dimensions(const EnsembleTables& tables) {
  const std::vector<double> disks = tables.runs.numbers("disks");
  const double n = disks.front();
  std::vector<Series> a, b;
  for (const Family& family : kFamilies) {
    Series points = scatter(tables, family, "contacts", "dim");
    if (points.x.empty()) continue;
    a.push_back(points);
    b.push_back(scatter(tables, family, "dim", "sliding"));
  }
  if (a.empty() || limits(disks).first != limits(disks).second) return {};
  const auto [m0, m1] = limits(tables.runs.numbers("contacts"));
  const auto [d0, d1] = limits(tables.runs.numbers("dim"));
  a.push_back({.name = "2M − 3N",
               .x = {m0 - 1, m1 + 1},
               .y = {2 * m0 - 2 - 3 * n, 2 * m1 + 2 - 3 * n},
               .mark = Mark::kLine,
               .colour = 7,
               .thick = false});
  b.push_back({.name = "Ms = dim F",
               .x = {0, d1 + 2},
               .y = {0, d1 + 2},
               .mark = Mark::kLine,
               .colour = 7,
               .thick = false});
  int outside = 0;
  int above = 0;
  double largest = 0;
  for (std::size_t row = 0; row < tables.runs.rows(); ++row) {
    const double excess = tables.runs.number("dim", row) - tables.runs.number("lower_bound", row);
    if (excess < 0 || excess > 3) ++outside;
    largest = std::max(largest, excess);
    if (tables.runs.number("sliding", row) > tables.runs.number("lower_bound", row)) ++above;
  }
  Figure first{
      .id = "fig06a",
      .title = "Fig. 6a: dimension of the set of contact states",
      .caption = "dim F against the number of contacts M, one point per packing. The line is 2M − 3N.",
      .claim = "All points lie on the line or at most 3 above it.",
      .finding =
          fmt::format("{} of {} packings are outside of 2M − 3N … 2M − 3N + 3; the largest excess is {:g}.",
                      outside, tables.runs.rows(), largest),
      .panels = {
          {.title = "", .x = {.label = "M"}, .y = {.label = "dim F"}, .series = a, .legend_left = true}}};
  Figure second{
      .id = "fig06b",
      .title = "Fig. 6b: sliding contacts",
      .caption =
          "Number Ms of sliding contacts of the simulated state against dim F. A contact slides if "
          "μR − |T| < 1e-9 mg, or 1e-9 of about the largest load on a disk where the scene names a unit of "
          "force far from it; one that transmits nothing counts twice.",
      .claim = "Ms ≤ 2M − 3N in all packings; CD near 0, MD-2 most, MD-1 between.",
      .finding = fmt::format("{} of {} packings have more than 2M − 3N sliding contacts.", above,
                             tables.runs.rows()),
      .panels = {{.title = "",
                  .x = {.label = "dim F", .low = std::max(0.0, d0 - 3), .high = d1 + 3},
                  .y = {.label = "Ms"},
                  .series = b,
                  .legend_left = true}}};
  return {first, second};
}

std::string tail_text(const char* name, const GroupedValues& data, double from) {
  const TailFit fit = fit_tail(data, from);
  if (std::isnan(fit.decay.value)) return fmt::format("{}: none. ", name);
  return fmt::format("{}: {} ({} in {:.3g} … {:.3g} mg). ", name, text_of(fit.decay, 2, "mg"),
                     counted(std::llround(fit.values), "value"), fit.from, fit.to);
}

std::string maximum_text(const char* name, const GroupedValues& data) {
  const Estimate maximum = main_maximum(data);
  if (std::isnan(maximum.value)) return fmt::format("{}: none. ", name);
  return fmt::format("{}: {}. ", name, text_of(maximum, 1, "mg"));
}

std::vector<Curve> pair_of_methods(const Samples& samples, const char* normal, const char* tangential) {
  return {{"CD, normal", samples.of(kCd, normal), Mark::kLine, 0, true},
          {"CD, tangential", samples.of(kCd, tangential), Mark::kLine, 1, false},
          {"MD, normal", samples.of(kMd, normal), Mark::kDashed, 2, true},
          {"MD, tangential", samples.of(kMd, tangential), Mark::kDashed, 3, false}};
}

Figure local(const Samples& samples) {
  const std::vector<Curve> curves = pair_of_methods(samples, "delta_R", "delta_T");
  const double high = largest_of(curves);
  std::string finding = "Decay lengths of the tails, the largest tenth of the values. ";
  for (const Curve& c : curves) finding += tail_text(c.name, c.data, quantile(c.data, 0.9));
  return {
      .id = "fig07",
      .title = "Fig. 7: local indeterminacy",
      .caption = fmt::format(
          "Densities of δR and δT [23], the length of the range of a contact's force in mg. {}", kDensity),
      .claim = "Exponential tails, a sharp peak at 0; MD slightly larger than CD.",
      .finding = finding,
      .panels = {panel_of(curves, "δR, δT (mg)", true, high, round_width(high, 40))}};
}

std::string capitalised(std::string text) {
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

/// One panel for each choice.
Figure global(const Samples& samples, const char* id, const char* title,
              const std::vector<WhichStates>& choices) {
  Figure figure{.id = id,
                .title = title,
                .caption =
                    "Densities of dR and dT [24], the distance between the states of smallest and largest "
                    "force of a contact. As many states attain an optimum, they measure which of these a "
                    "method takes as much as they measure F. ",
                .claim = "Two maxima: near 0, and at about 60 mg (CD) and 75 mg (MD).",
                .finding = "Main maximum, sought from a twentieth of the 99 % quantile to that quantile. ",
                .panels = {}};
  for (const WhichStates& choice : choices) {
    const std::vector<Curve> curves = pair_of_methods(samples, choice.normal, choice.tangential);
    const double high = end_of_axis(curves);
    figure.panels.push_back(panel_of(curves, "dR, dT (mg)", false, high, round_width(high, 40)));
    figure.panels.back().title = choices.size() > 1 ? choice.name : "";
    figure.caption += fmt::format("{}: {}. ", capitalised(choice.name), choice.which);
    if (choices.size() > 1) figure.finding += fmt::format("{}: ", capitalised(choice.name));
    for (const Curve& c : curves) figure.finding += maximum_text(c.name, c.data);
  }
  figure.caption += kDensity;
  return figure;
}

/// What a panel shows: two columns of the contacts. The title is "" where there is one panel alone.
struct PanelColumns {
  const char* title;
  const char* normal;
  const char* tangential;
};

Figure weak_and_strong(const Samples& samples, const char* id, const char* title,
                       const std::vector<PanelColumns>& panels, const char* label, const char* claim,
                       bool logarithmic) {
  Figure figure{.id = id,
                .title = title,
                .caption = fmt::format("CD-1 contacts with less and with more than the mean normal force. {}",
                                       kDensity),
                .claim = claim,
                .finding = fmt::format("Mean R = {:.2f} mg. ", samples.mean_force(Protocol::kCd1)),
                .panels = {}};
  for (const PanelColumns& columns : panels) {
    const auto part = [&](const char* column, bool strong) {
      return samples.split_by_force(Protocol::kCd1, column, strong);
    };
    const std::vector<Curve> curves = {
        {"R < mean, normal", part(columns.normal, false), Mark::kLine, 0, false},
        {"R < mean, tangential", part(columns.tangential, false), Mark::kDashed, 1, false},
        {"R > mean, normal", part(columns.normal, true), Mark::kLine, 2, true},
        {"R > mean, tangential", part(columns.tangential, true), Mark::kDashed, 3, true}};
    const double high = logarithmic ? largest_of(curves) : end_of_axis(curves);
    const double width = round_width(high, 40);
    figure.panels.push_back(panel_of(curves, label, logarithmic, high, width));
    figure.panels.back().title = columns.title;
    const std::string panel = *columns.title == '\0' ? "" : fmt::format(", {}", columns.title);
    figure.finding += fmt::format("In the first bin{}, 0 … {:g} mg: ", panel, width);
    for (const Curve& c : curves) {
      const Estimate f = fraction_between(c.data, 0, width);
      figure.finding += fmt::format("{}: {} of its contacts. ", c.name, text_of(f, 3));
    }
  }
  return figure;
}

Figure places(const Samples& samples) {
  Figure figure{.id = "fig11",
                .title = "Fig. 11: place of the simulated force in its range",
                .caption = fmt::format("R* = (R − Rmin)/(Rmax − Rmin) and T* likewise [39]. {}", kDensity),
                .claim = "Depends on the history (1 against 2) more than on the method.",
                .finding = "Largest difference of the cumulative distributions (Kolmogorov–Smirnov). ",
                .panels = {}};
  const std::array<std::pair<const char*, const char*>, 2> columns = {{{"R_star", "R*"}, {"T_star", "T*"}}};
  for (const auto& [column, label] : columns) {
    std::vector<Curve> curves;
    for (const Family& f : kFamilies) {
      curves.push_back(
          {f.name(), samples.of({f.protocol}, column), f.mark(), f.colour, !starts_from_cd1(f.protocol)});
    }
    Panel panel = panel_of(curves, label, false, 1, 0.05);
    panel.title = label;
    figure.panels.push_back(panel);
    const auto difference = [&](std::size_t a, std::size_t b) {
      const bool known = !curves[a].data.values.empty() && !curves[b].data.values.empty();
      return text_of({known ? kolmogorov_distance(curves[a].data, curves[b].data) : kNaN, kNaN}, 3);
    };
    figure.finding += fmt::format("{}: history: CD {}, MD {}; method: falling {}, at rest {}. ", label,
                                  difference(0, 1), difference(2, 3), difference(0, 2), difference(1, 3));
  }
  return figure;
}

Figure extremal_forces(const Samples& samples, const char* id, const char* title, bool solver,
                       const char* which) {
  std::vector<Curve> curves = {{"simulated", samples.of({Protocol::kCd1}, "R"), Mark::kLine, 7, true}};
  const std::array<const char*, 4> names = {"R minimal", "R maximal", "T minimal", "T maximal"};
  for (std::size_t k = 0; k < 4; ++k) {
    curves.push_back({names[k], samples.extremal(Protocol::kCd1, static_cast<int>(k), solver),
                      k < 2 ? Mark::kLine : Mark::kDashed, static_cast<int>(k), false});
  }
  const double high = std::ceil(largest_of(curves));
  const double width = std::max(1.0, round_width(high, 40));
  std::string finding = "Decay lengths of the tails beyond 30 mg. ";
  for (const Curve& c : curves) finding += tail_text(c.name, c.data, 30);
  finding += "Fraction of contacts beyond 60 mg. ";
  for (const Curve& c : curves) {
    const Estimate f = fraction_between(c.data, 60, 1e9);
    finding += fmt::format("{}: {}. ", c.name, text_of(f, 4));
  }
  return {.id = id,
          .title = title,
          .caption = fmt::format(
              "Densities of R in the CD-1 states, and in the extremal states in which some contact's "
              "force is smallest or largest; {}. {}",
              which, kDensity),
          .claim =
              "They coincide below 30 mg; beyond, extremal states have more large forces. Approximately "
              "exponential.",
          .finding = finding,
          .panels = {panel_of(curves, "R (mg)", true, high, width)}};
}

Figure families(const Samples& samples) {
  std::vector<Curve> curves;
  for (const Family& f : kFamilies) {
    curves.push_back(
        {f.name(), samples.of({f.protocol}, "R"), f.mark(), f.colour, !starts_from_cd1(f.protocol)});
  }
  const double high = largest_of(curves);
  std::string finding = "Decay lengths of the tails beyond 20 mg. ";
  for (const Curve& c : curves) finding += tail_text(c.name, c.data, 20);
  return {.id = "fig13",
          .title = "Fig. 13: normal forces in the four families",
          .caption = fmt::format("Densities of the simulated R. {}", kDensity),
          .claim = "CD-1 and MD-1 are exponential throughout; CD-2 and MD-2 have fewer large forces.",
          .finding = finding,
          .panels = {panel_of(curves, "R (mg)", true, high, round_width(high, 40))}};
}

}  // namespace

std::vector<Figure> make_figures(const EnsembleTables& tables) {
  std::vector<Figure> figures = {two_contacts()};
  const Samples samples(tables);
  if (!samples.has(kFourProtocols) || tables.contacts.rows() == 0) return figures;
  for (Figure& figure : dimensions(tables)) figures.push_back(std::move(figure));
  figures.push_back(local(samples));
  std::vector<WhichStates> choices = {kCanonicalChoice};
  if (samples.has_paper_walk()) choices.insert(choices.begin(), kWalkChoice);
  if (samples.has_smallest_distances()) choices.push_back(kNearestChoice);
  figures.push_back(global(samples, "fig08", "Fig. 8: global indeterminacy", choices));
  if (samples.has_smallest_distances())
    figures.back().finding += fmt::format("Smallest distances: {}.", known_smallest_distances(tables));
  if (samples.has_solver_states())
    figures.push_back(global(samples, "fig08-solver", "Fig. 8 with the solver's vertices", {kSolverChoice}));
  const bool has_cd1 = samples.has({Protocol::kCd1});  // figures 9, 10 and 12 are of CD-1 alone
  if (has_cd1) {
    figures.push_back(weak_and_strong(
        samples, "fig09", "Fig. 9: local indeterminacy of weak and strong contacts",
        {{"", "delta_R", "delta_T"}}, "δR, δT (mg)",
        "The peak at 0 is due to weak contacts alone; large indeterminacy to strong ones.", true));
    std::vector<PanelColumns> panels = {{"", "d_R", "d_T"}};
    if (samples.has_smallest_distances()) {
      panels.clear();
      for (const WhichStates& choice : {kCanonicalChoice, kNearestChoice})
        panels.push_back({choice.name, choice.normal, choice.tangential});
    }
    figures.push_back(weak_and_strong(
        samples, "fig10", "Fig. 10: global indeterminacy of weak and strong contacts", panels, "dR, dT (mg)",
        "The maximum near 0 is due to weak contacts; without them the main one shifts to "
        "larger values.",
        false));
  }
  figures.push_back(places(samples));
  if (has_cd1) {
    figures.push_back(extremal_forces(samples, "fig12",
                                      "Fig. 12: normal forces in simulated and extremal states", false,
                                      kCanonicalChoice.which));
    if (samples.has_solver_states()) {
      figures.push_back(extremal_forces(samples, "fig12-solver", "Fig. 12 with the solver's vertices", true,
                                        kSolverChoice.which));
    }
  }
  figures.push_back(families(samples));
  for (Figure& figure : limit_figures(tables)) figures.push_back(std::move(figure));
  for (Figure& figure : uniform_figures(tables)) figures.push_back(std::move(figure));
  return figures;
}

}  // namespace indet
