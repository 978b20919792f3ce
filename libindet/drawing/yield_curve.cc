#include "libindet/drawing/yield_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libindet/drawing/axis.h"
#include "libindet/drawing/canvas.h"
#include "libindet/drawing/legend.h"
#include "libindet/drawing/palette.h"

namespace indet {
namespace {

constexpr double kSide = 300;
constexpr double kBorder = 34;

/// One direction of the map.
struct Direction {
  double angle = 0;
  bool is_reached = false;
  bool is_never = false;  ///< there is no limit in this direction
  double multiple = 0;

  Vector2 at(double length) const { return length * Vector2(std::cos(angle), std::sin(angle)); }
};

std::vector<Direction> directions_of(const std::vector<Limit>& limits) {
  std::vector<Direction> directions;
  const auto add = [&](const LimitEnd& end, double angle, int sign) {
    directions.push_back({angle, end.outcome == LimitOutcome::kReached, end.outcome == LimitOutcome::kNever,
                          sign * end.value});
  };
  for (const Limit& limit : limits) {
    add(limit.largest, limit.map_angle, 1);
    add(limit.smallest, limit.map_angle + std::numbers::pi, -1);
  }
  std::sort(directions.begin(), directions.end(),
            [](const Direction& a, const Direction& b) { return a.angle < b.angle; });
  return directions;
}

}  // namespace

void draw_yield_curve(const std::filesystem::path& path, const std::vector<Limit>& limits,
                      const std::string& text) {
  const std::vector<Direction> directions = directions_of(limits);
  // A square about all points and the origin.
  Vector2 low(0, 0);
  Vector2 high(0, 0);
  for (const Direction& direction : directions) {
    if (!direction.is_reached) continue;
    low = low.cwiseMin(direction.at(direction.multiple));
    high = high.cwiseMax(direction.at(direction.multiple));
  }
  double size = 1.15 * (high - low).maxCoeff();
  if (!(size > 0)) size = 1;
  const Vector2 middle = (low + high) / 2;
  const Caption caption(text, kSide);
  const double height = kSide + 2 * kBorder;
  Canvas canvas(path, kSide + 2 * kBorder, height + caption.height());
  const auto place = [&](const Vector2& point) {
    const Vector2 share = (point - middle) / size;
    return Vector2(kBorder + kSide * (0.5 + share.x()), kBorder + kSide * (0.5 - share.y()));
  };
  const Vector2 lower = middle.array() - size / 2;
  const Vector2 upper = middle.array() + size / 2;
  canvas.line(place({lower.x(), 0}), place({upper.x(), 0}), 0.5, palette::kUnknown, false, false);
  canvas.line(place({0, lower.y()}), place({0, upper.y()}), 0.5, palette::kUnknown, false, false);
  const double step = tick_step(size / 2);
  const auto ticks = [&](double from, double to, const auto& draw) {
    for_each_tick(from, to, step, [&](double value) {
      if (value != 0) draw(value, fmt::format("{:g}", value));
    });
  };
  ticks(lower.x(), upper.x(), [&](double x, const std::string& label) {
    const Vector2 at = place({x, 0});
    canvas.line(at, at + Vector2(0, 3), 0.5, palette::kUnknown, false, false);
    canvas.text(at + Vector2(0, 3 + kTextSize), label, kTextSize, 0.5);
  });
  ticks(lower.y(), upper.y(), [&](double y, const std::string& label) {
    const Vector2 at = place({0, y});
    canvas.line(at, at - Vector2(3, 0), 0.5, palette::kUnknown, false, false);
    canvas.text(at + Vector2(-5, kTextSize / 3), label, kTextSize, 1);
  });
  canvas.text(place({upper.x(), 0}) + Vector2(0, -4), "first load", kTextSize, 1);
  canvas.text(place({0, upper.y()}) + Vector2(4, 0), "second load", kTextSize, 0);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const Direction& a = directions[k];
    const Direction& b = directions[(k + 1) % directions.size()];
    const bool is_known = (a.is_reached || a.is_never) && (b.is_reached || b.is_never);
    if (!is_known || (a.is_never && b.is_never)) continue;
    const bool is_open = !a.is_reached || !b.is_reached;
    const Vector2 from = a.is_reached ? a.at(a.multiple) : a.at(size);
    const Vector2 to = b.is_reached ? b.at(b.multiple) : b.at(size);
    // An open end is not drawn beyond the square.
    const double share = is_open ? std::min(1.0, 0.2 * size / (to - from).norm()) : 1;
    const Vector2 start = a.is_reached ? from : Vector2(to + share * (from - to));
    const Vector2 stop = b.is_reached ? to : Vector2(from + share * (to - from));
    canvas.line(place(start), place(stop), 1.2, palette::kNegative, is_open, true);
  }
  for (const Direction& direction : directions) {
    if (direction.is_reached)
      canvas.disk(place(direction.at(direction.multiple)), 1.6, palette::kNegative, palette::kNegative, 0.2);
  }
  canvas.disk(place({0, 0}), 2.5, palette::kPositive, palette::kPositive, 0.2);
  caption.draw(canvas, {kBorder, height});
  canvas.finish();
}

}  // namespace indet
