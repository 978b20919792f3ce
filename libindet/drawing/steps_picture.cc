#include "libindet/drawing/steps_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "libindet/drawing/axis.h"
#include "libindet/drawing/canvas.h"
#include "libindet/drawing/legend.h"
#include "libindet/drawing/palette.h"

namespace indet {
namespace {

constexpr double kPlotWidth = 300, kPlotHeight = 190;
constexpr double kPlotBorder = 34;
constexpr double kCurveThickness = 1.2;

struct Curve {
  const char* name;
  double LimitStep::*member;
  Colour colour;
};
const Curve kCurves[] = {{"mean δR", &LimitStep::mean_delta_R, palette::kBlack},
                         {"radius r", &LimitStep::r, palette::kNegative},
                         {"mean width", &LimitStep::mean_width, palette::kLoad},
                         {"largest ball", &LimitStep::inscribed_radius, palette::kPositive}};

bool is_shown(const Curve& curve, const LimitEnd& end) {
  const double first = end.steps.front().*curve.member;
  return std::isfinite(first) && first > 0;
}

/// Relative to the first step.
double share(const Curve& curve, const LimitEnd& end, const LimitStep& step) {
  return step.*curve.member / end.steps.front().*curve.member;
}

/// Degrees of a tilt.
double shown_value(const Limit& limit, double value) {
  return limit.kind == LimitKind::kTilt ? value * 180 / std::numbers::pi : value;
}

const char* axis_name(LimitKind kind) {
  switch (kind) {
    case LimitKind::kTilt:
      return "angle (degrees)";
    case LimitKind::kLoad:
      return "multiple of the load";
    case LimitKind::kFriction:
      return "factor of friction";
  }
  return "?";
}

double largest_share(const LimitEnd& end) {
  double largest = 1;
  for (const Curve& curve : kCurves) {
    if (!is_shown(curve, end)) continue;
    for (const LimitStep& step : end.steps) {
      const double height = share(curve, end, step);
      if (std::isfinite(height)) largest = std::max(largest, height);
    }
  }
  return largest;
}

/// The plane of value and share on the page: from the present value at the left to the limit at the right.
struct Plane {
  double first, last, top;

  Vector2 place(double value, double height) const {
    return {kPlotBorder + kPlotWidth * (value - first) / (last - first),
            kPlotBorder / 2 + kPlotHeight * (1 - height / top)};
  }
};

void draw_axes(Canvas& canvas, const Limit& limit, const Plane& plane) {
  const auto line = [&](const Vector2& from, const Vector2& to) {
    canvas.line(from, to, 0.5, palette::kUnknown, false, false);
  };
  const Vector2 origin = plane.place(plane.first, 0);
  line(origin, plane.place(plane.last, 0));
  line(origin, plane.place(plane.first, plane.top));
  canvas.line(plane.place(plane.last, 0), plane.place(plane.last, plane.top), 0.5, palette::kUnknown, true,
              false);
  const auto [low, high] = std::minmax(plane.first, plane.last);
  for_each_tick(low, high, tick_step((high - low) / 2), [&](double value) {
    const Vector2 at = plane.place(value, 0);
    line(at, at + Vector2(0, 3));
    canvas.text(at + Vector2(0, 3 + kTextSize), fmt::format("{:g}", value), kTextSize, 0.5);
  });
  for_each_tick(0, plane.top, tick_step(plane.top / 2), [&](double height) {
    const Vector2 at = plane.place(plane.first, height);
    line(at, at - Vector2(3, 0));
    canvas.text(at + Vector2(-5, kTextSize / 3), fmt::format("{:g}", height), kTextSize, 1);
  });
  canvas.text(origin + Vector2(kPlotWidth / 2, 5 + 2 * kTextSize), axis_name(limit.kind), kTextSize, 0.5);
  canvas.text(plane.place(plane.last, plane.top) + Vector2(-3, kTextSize), "limit", kTextSize, 1);
}

void draw_curve(Canvas& canvas, const Limit& limit, const LimitEnd& end, const Plane& plane,
                const Curve& curve) {
  std::vector<Vector2> points;
  const auto draw_part = [&] {
    for (std::size_t k = 1; k < points.size(); ++k)
      canvas.line(points[k - 1], points[k], kCurveThickness, curve.colour);
    points.clear();
  };
  for (const LimitStep& step : end.steps) {
    const double height = share(curve, end, step);
    if (!std::isfinite(height)) {
      draw_part();
      continue;
    }
    points.push_back(plane.place(shown_value(limit, step.value), height));
    canvas.disk(points.back(), 1.6, curve.colour, curve.colour, 0.2);
  }
  draw_part();
}

std::vector<LegendItem> legend_of(const LimitEnd& end) {
  std::vector<LegendItem> items;
  for (const Curve& curve : kCurves) {
    if (!is_shown(curve, end)) continue;
    const auto draw = [colour = curve.colour](Canvas& canvas, const Vector2& at) {
      canvas.line(at, at + Vector2(22, 0), kCurveThickness, colour);
    };
    items.push_back({22, draw, curve.name});
  }
  return items;
}

}  // namespace

void draw_steps(const std::filesystem::path& path, const Limit& limit, const LimitEnd& end,
                const std::string& text) {
  const Plane plane{shown_value(limit, limit.present()), shown_value(limit, end.value),
                    1.05 * largest_share(end)};
  const Legend legend(legend_of(end), kPlotWidth);
  const Caption caption(text, kPlotWidth);
  const double legend_top = kPlotHeight + kPlotBorder + 2 * kTextSize;
  Canvas canvas(path, kPlotWidth + 1.5 * kPlotBorder,
                legend_top + legend.height() + caption.height() + kTextSize);
  draw_axes(canvas, limit, plane);
  for (const Curve& curve : kCurves) {
    if (is_shown(curve, end)) draw_curve(canvas, limit, end, plane, curve);
  }
  legend.draw(canvas, {kPlotBorder, legend_top});
  caption.draw(canvas, {kPlotBorder, legend_top + legend.height()});
  canvas.finish();
}

}  // namespace indet
