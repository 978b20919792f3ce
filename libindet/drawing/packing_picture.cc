#include "libindet/drawing/packing_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "libindet/base/tolerances.h"
#include "libindet/drawing/palette.h"
#include "libindet/drawing/sheet.h"

namespace indet {
namespace {

/// The largest of 1, 2, 5, 10, … (times powers of ten) that is at most `value`.
double round_below(double value) {
  if (!(value > 0)) return 0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= value * (1 + tolerance::kRoundNumber)) return factor * power;
  }
  return power;
}

/// The scales of a picture of forces.
struct ForceScale {
  double unit = 1;                      ///< The unit of force.
  double largest_R = 0, largest_T = 0;  ///< Magnitudes, in the unit of force.
  bool unknown = false;

  ForceScale(const Packing& packing, const Eigen::Ref<const Eigen::VectorXd>& forces)
      : unit(packing.force_unit()) {
    for (int i = 0; i < packing.contact_count(); ++i) {
      const double r = forces[2 * i] / unit;
      const double t = forces[2 * i + 1] / unit;
      unknown = unknown || !std::isfinite(r) || !std::isfinite(t);
      if (std::isfinite(r)) largest_R = std::max(largest_R, r);
      if (std::isfinite(t)) largest_T = std::max(largest_T, std::abs(t));
    }
  }

  double thickness(double r, const Sheet& sheet) const {
    return largest_R > 0 ? std::max(0.0, r) / largest_R * 0.6 * sheet.radius() : 0;
  }
  double length(double t, const Sheet& sheet) const {
    return largest_T > 0 ? std::abs(t) / largest_T * 1.3 * sheet.radius() : 0;
  }
};

double tangent_thickness(const Sheet& sheet) { return std::clamp(0.11 * sheet.radius(), 0.5, 2.0); }

std::vector<LegendItem> force_legend(const Sheet& sheet, const ForceScale& scale, const std::string& unit) {
  std::vector<LegendItem> items;
  if (const double r = round_below(scale.largest_R); r > 0) {
    const double thickness = std::min(scale.thickness(r, sheet), kLineHeight);
    items.push_back({22,
                     [=](Canvas& canvas, const Vector2& at) {
                       canvas.line(at, at + Vector2(22, 0), thickness, palette::kBlack, false, false);
                     },
                     fmt::format("R = {:g} {}", r, unit)});
  }
  if (const double t = round_below(scale.largest_T); t > 0) {
    const double length = scale.length(t, sheet);
    const double thickness = tangent_thickness(sheet);
    for (const auto& [colour, text] :
         {std::pair(palette::kPositive, fmt::format("T = {:g} {} (turns disks ↺)", t, unit)),
          std::pair(palette::kNegative, fmt::format("T = −{:g} {} (↻)", t, unit))}) {
      items.push_back({length,
                       [=, c = colour](Canvas& canvas, const Vector2& at) {
                         canvas.line(at, at + Vector2(length, 0), thickness, c, false, false);
                       },
                       text});
    }
  }
  if (scale.unknown) {
    items.push_back({22,
                     [](Canvas& canvas, const Vector2& at) {
                       canvas.line(at, at + Vector2(22, 0), 0.6, palette::kUnknown, true);
                     },
                     "contact of unknown force"});
  }
  return items;
}

void draw_tangential(Sheet& sheet, const Contact& contact, double t, const ForceScale& scale) {
  const double length = scale.length(t, sheet);
  const double thickness = tangent_thickness(sheet);
  if (length < 0.1) return;
  const Colour& colour = t > 0 ? palette::kPositive : palette::kNegative;
  const Vector2 along = Sheet::direction(contact.tangent()) * (t > 0 ? length : -length);
  const Vector2 inwards = Sheet::direction(contact.normal) * (0.5 * thickness);
  for (const Sheet::Line& line : sheet.lines(contact)) {
    const Vector2& point = line.point;
    sheet.canvas().line(point + inwards, point + inwards + along, thickness, colour, false, false);
    if (contact.b.is_wall()) continue;
    sheet.canvas().line(point - inwards, point - inwards - along, thickness, colour, false, false);
  }
}

constexpr double kBarHeight = 34;

/// The colour bar with ticks, its label above.
void draw_colour_bar(Sheet& sheet, double largest, const std::string& unit) {
  const double width = std::min(220.0, sheet.width() - 4 * Sheet::kMargin);
  const Vector2 corner{0.5 * (sheet.width() - width), sheet.legend_bottom(kBarHeight) + 10};
  Canvas& canvas = sheet.canvas();
  canvas.text({0.5 * sheet.width(), corner.y() - 3}, fmt::format("δR = R_max − R_min ({})", unit), kTextSize,
              0.5);
  canvas.colour_bar(corner, width, 7);
  const double step = round_below(largest / 4);
  for (int i = 0; step > 0 && i * step <= largest * (1 + tolerance::kLastTick); ++i) {
    const double x = corner.x() + width * i * step / largest;
    canvas.line({x, corner.y() + 7}, {x, corner.y() + 9}, 0.4, palette::kBlack, false, false);
    canvas.text({x, corner.y() + 9 + kTextSize}, fmt::format("{:g}", i * step), kTextSize, 0.5);
  }
}

}  // namespace

void draw_forces(const std::filesystem::path& path, const Packing& packing,
                 const Eigen::Ref<const Eigen::VectorXd>& forces, const std::string& caption) {
  const ForceScale scale(packing, forces);
  Sheet sheet(
      path, packing, caption, [&](const Sheet& s) { return force_legend(s, scale, unit_name(packing)); }, 0);
  sheet.draw_bodies();
  // Weak forces above strong ones, tangential ones above all.
  std::vector<int> order;
  for (int i = 0; i < packing.contact_count(); ++i) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return forces[2 * a] > forces[2 * b]; });
  for (const int i : order) {
    const Contact& contact = packing[ContactId(i)];
    const double r = forces[2 * i] / scale.unit;
    for (const Sheet::Line& line : sheet.lines(contact)) {
      if (!std::isfinite(r) || !std::isfinite(forces[2 * i + 1])) {
        sheet.canvas().line(line.from, line.to, 0.6, palette::kUnknown, true);
      } else if (r > 0) {
        sheet.canvas().line(line.from, line.to, scale.thickness(r, sheet), palette::kBlack, false,
                            !contact.b.is_wall());
      }
    }
  }
  for (const int i : order) {
    const double t = forces[2 * i + 1] / scale.unit;
    if (std::isfinite(t)) draw_tangential(sheet, packing[ContactId(i)], t, scale);
  }
  sheet.finish();
}

void draw_delta_R(const std::filesystem::path& path, const Packing& packing,
                  const Eigen::Ref<const Eigen::VectorXd>& known,
                  const Eigen::Ref<const Eigen::VectorXd>& estimate, const std::string& caption) {
  const auto is_estimate = [&](Eigen::Index i) { return estimate.size() > 0 && !std::isnan(estimate[i]); };
  Eigen::VectorXd delta_R = known;
  bool estimated = false;
  for (Eigen::Index i = 0; i < delta_R.size(); ++i) {
    if (is_estimate(i)) delta_R[i] = estimate[i];
    estimated = estimated || is_estimate(i);
  }
  double largest = 0;
  bool unbounded = false;
  bool missing = false;
  for (const double delta : delta_R) {
    if (std::isfinite(delta)) largest = std::max(largest, delta);
    unbounded = unbounded || std::isinf(delta);
    missing = missing || std::isnan(delta);
  }
  const auto legend = [&](const Sheet&) {
    std::vector<LegendItem> items;
    const auto sample = [](const Colour& colour, double thickness, bool dashed) {
      return [=](Canvas& canvas, const Vector2& at) {
        canvas.line(at, at + Vector2(22, 0), thickness, colour, dashed, false);
      };
    };
    if (unbounded) items.push_back({22, sample(palette::kUnbounded, 2, true), "unbounded"});
    if (estimated) items.push_back({22, sample(palette::kBlack, 1, false), "thin: estimate"});
    if (missing) items.push_back({22, sample(palette::kUnknown, 0.6, false), "no value"});
    return items;
  };
  Sheet sheet(path, packing, caption, legend, kBarHeight);
  sheet.draw_bodies();
  const double thickness = std::clamp(0.3 * sheet.radius(), 0.8, 6.0);
  std::vector<int> order;  // large values above small ones
  for (int i = 0; i < packing.contact_count(); ++i) order.push_back(i);
  const auto rank = [&](int i) { return std::isnan(delta_R[i]) ? -1.0 : delta_R[i]; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return rank(a) < rank(b); });
  for (const int i : order) {
    const Contact& contact = packing[ContactId(i)];
    const bool round = !contact.b.is_wall();
    for (const Sheet::Line& line : sheet.lines(contact)) {
      if (std::isnan(delta_R[i])) {
        sheet.canvas().line(line.from, line.to, 0.6, palette::kUnknown);
      } else if (std::isinf(delta_R[i])) {
        sheet.canvas().line(line.from, line.to, thickness, palette::kUnbounded, true, false);
      } else {
        const double fraction = largest > 0 ? delta_R[i] / largest : 0;
        const double share = is_estimate(i) ? 0.5 : 1;
        sheet.canvas().line(line.from, line.to, share * thickness, map_colour(fraction), false, round);
      }
    }
  }
  if (largest > 0) draw_colour_bar(sheet, largest, unit_name(packing));
  sheet.finish();
}

}  // namespace indet
