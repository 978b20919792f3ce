#include "libindet/drawing/packing_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "libindet/base/tolerances.h"
#include "libindet/drawing/canvas.h"

namespace indet {
namespace {

// Lengths on paper in points.
constexpr double kMargin = 9;
constexpr double kWidest = 360;
constexpr double kHighest = 500;
constexpr double kNarrowest = 230;  // room for legend and caption
constexpr double kTextSize = 8;
constexpr double kLineHeight = 11;
constexpr double kLegendGap = 10;

constexpr Colour kBlack{0.1, 0.1, 0.1};
constexpr Colour kDiskFill{0.93, 0.93, 0.93};
constexpr Colour kDiskOutline{0.62, 0.62, 0.62};
constexpr Colour kWallFill{0.80, 0.80, 0.80};
constexpr Colour kUnknown{0.5, 0.5, 0.5};
// Okabe and Ito's vermilion and blue, which colour-blind people tell apart.
constexpr Colour kPositive{0.835, 0.369, 0};
constexpr Colour kNegative{0, 0.447, 0.698};
constexpr Colour kUnbounded{0.8, 0, 0.2};

/// The largest of 1, 2, 5, 10, … (times powers of ten) that is at most `value`.
double round_below(double value) {
  if (!(value > 0)) return 0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= value * (1 + tolerance::kRoundNumber)) return factor * power;
  }
  return power;
}

std::string unit_name(const Packing& packing) { return packing.named_force_unit > 0 ? "force units" : "mg"; }

/// Breaks a text into lines that fit.
std::vector<std::string> wrap(const std::string& text, double width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) {
    const std::string longer = line.empty() ? word : line + " " + word;
    if (!line.empty() && text_width(longer, kTextSize) > width) {
      lines.push_back(line);
      line = word;
    } else {
      line = longer;
    }
  }
  if (!line.empty()) lines.push_back(line);
  return lines;
}

/// One entry of the legend: a drawing of some width at the middle of a line, then a text.
struct LegendItem {
  double width;
  std::function<void(Canvas&, const Vector2&)> draw;  ///< Gets the left end of the drawing.
  std::string text;

  double total() const { return width + 4 + text_width(text, kTextSize); }
};

/// Lines of legend items that fit.
std::vector<std::vector<LegendItem>> arrange(const std::vector<LegendItem>& items, double width) {
  std::vector<std::vector<LegendItem>> lines(1);
  double used = 0;
  for (const LegendItem& item : items) {
    if (!lines.back().empty() && used + item.total() > width) {
      lines.emplace_back();
      used = 0;
    }
    used += item.total() + kLegendGap;
    lines.back().push_back(item);
  }
  return lines;
}

/// The part of a convex polygon within a half-plane.
std::vector<Vector2> clip(const std::vector<Vector2>& polygon, const Wall& wall) {
  std::vector<Vector2> inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2& from = polygon[i];
    const Vector2& to = polygon[(i + 1) % polygon.size()];
    const double a = (from - wall.point).dot(wall.normal);
    const double b = (to - wall.point).dot(wall.normal);
    if (a >= 0) inside.push_back(from);
    if ((a < 0) != (b < 0)) inside.emplace_back(from + (to - from) * (a / (a - b)));
  }
  return inside;
}

/// Where things of a packing are on the page, and what the page holds beside it.
class Sheet {
 public:
  Sheet(const std::filesystem::path& path, const Packing& packing, const std::string& caption,
        const std::function<std::vector<LegendItem>(const Sheet&)>& legend, double bar_height)
      : packing_(packing) {
    measure();
    caption_ = wrap(caption, width_ - 2 * kMargin);
    legend_ = arrange(legend(*this), width_ - 2 * kMargin);
    if (legend_.front().empty()) legend_.clear();
    legend_top_ = kMargin + (high_.y() - low_.y()) * scale_ + kMargin;
    const double legend_height = static_cast<double>(legend_.size()) * (kLineHeight + 3) + bar_height;
    caption_top_ = legend_top_ + legend_height;
    const double caption_height = static_cast<double>(caption_.size()) * kLineHeight;
    canvas_.emplace(path, width_, caption_top_ + caption_height + kMargin);
  }

  Canvas& canvas() { return *canvas_; }
  double width() const { return width_; }
  double legend_bottom(double bar_height) const { return caption_top_ - bar_height; }
  /// Points of the page in a unit of length.
  double scale() const { return scale_; }
  /// Mean radius on the page.
  double radius() const { return mean_radius_ * scale_; }

  /// A point of the scene on the page.
  Vector2 place(const Vector2& point) const {
    return {left_ + (point.x() - low_.x()) * scale_, kMargin + (high_.y() - point.y()) * scale_};
  }
  /// A direction of the scene on the page.
  static Vector2 direction(const Vector2& vector) { return {vector.x(), -vector.y()}; }

  Vector2 centre(DiskId disk) const { return place(packing_[disk].position); }
  /// The end of a contact's line at body b: its centre, or the contact point at a wall.
  Vector2 end(const Contact& contact) const {
    return contact.b.is_wall() ? contact_point(contact) : centre(contact.b.disk_id());
  }
  Vector2 contact_point(const Contact& contact) const {
    const Disk& disk = packing_[contact.a];
    return place(disk.position - disk.radius * contact.normal);
  }

  void draw_bodies() {
    const std::vector<Vector2> view = {low_, {high_.x(), low_.y()}, high_, {low_.x(), high_.y()}};
    std::vector<Vector2> domain = view;
    for (const Wall& wall : packing_.walls) domain = clip(domain, wall);
    for (Wall wall : packing_.walls) {
      wall.normal = -wall.normal;
      std::vector<Vector2> behind = clip(view, wall);
      for (Vector2& corner : behind) corner = place(corner);
      canvas_->polygon(behind, kWallFill);
    }
    for (const Disk& disk : packing_.disks) {
      canvas_->disk(place(disk.position), disk.radius * scale_, kDiskFill, kDiskOutline,
                    std::min(0.5, 0.1 * disk.radius * scale_));
    }
    draw_wall_lines(domain);
  }

  void finish() {
    double y = legend_top_ + kTextSize;
    for (const auto& line : legend_) {
      double x = kMargin;
      for (const LegendItem& item : line) {
        item.draw(*canvas_, {x, y - 0.35 * kTextSize});
        canvas_->text({x + item.width + 4, y}, item.text, kTextSize);
        x += item.total() + kLegendGap;
      }
      y += kLineHeight + 3;
    }
    y = caption_top_ + kTextSize;
    for (const std::string& line : caption_) {
      canvas_->text({kMargin, y}, line, kTextSize);
      y += kLineHeight;
    }
    canvas_->finish();
  }

 private:
  /// The part of the scene that is shown, and its scale.
  void measure() {
    if (packing_.disks.empty()) {
      low_ = {-1, -1};
      high_ = {1, 1};
    } else {
      low_ = high_ = packing_.disks.front().position;
    }
    double sum = 0;
    for (const Disk& disk : packing_.disks) {
      low_ = low_.cwiseMin((disk.position.array() - disk.radius).matrix());
      high_ = high_.cwiseMax((disk.position.array() + disk.radius).matrix());
      sum += disk.radius / static_cast<double>(packing_.disks.size());
    }
    mean_radius_ = packing_.disks.empty() ? 1 : sum;
    const Vector2 border = Vector2::Constant(0.4 * mean_radius_);
    low_ -= border;
    high_ += border;
    const Vector2 size = high_ - low_;
    scale_ = std::min(kWidest / size.x(), kHighest / size.y());
    // A handful of disks needs no whole page.
    scale_ = std::min(scale_, 60 / mean_radius_);
    width_ = std::max(size.x() * scale_, kNarrowest) + 2 * kMargin;
    left_ = 0.5 * (width_ - size.x() * scale_);
  }

  /// The edges of the domain that walls make.
  void draw_wall_lines(const std::vector<Vector2>& domain) {
    const double close = tolerance::kSamePoint * (high_ - low_).norm();
    for (std::size_t i = 0; i < domain.size(); ++i) {
      const Vector2& from = domain[i];
      const Vector2& to = domain[(i + 1) % domain.size()];
      const bool wall = std::any_of(packing_.walls.begin(), packing_.walls.end(), [&](const Wall& w) {
        return std::abs((from - w.point).dot(w.normal)) < close &&
               std::abs((to - w.point).dot(w.normal)) < close;
      });
      if (wall && (to - from).norm() > close) canvas_->line(place(from), place(to), 1, kBlack);
    }
  }

  const Packing& packing_;
  Vector2 low_{0, 0}, high_{0, 0};
  double scale_ = 1, mean_radius_ = 1, width_ = 0, left_ = 0, legend_top_ = 0, caption_top_ = 0;
  std::vector<std::string> caption_;
  std::vector<std::vector<LegendItem>> legend_;
  std::optional<Canvas> canvas_;
};

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
                       canvas.line(at, at + Vector2(22, 0), thickness, kBlack, false, false);
                     },
                     fmt::format("R = {:g} {}", r, unit)});
  }
  if (const double t = round_below(scale.largest_T); t > 0) {
    const double length = scale.length(t, sheet);
    const double thickness = tangent_thickness(sheet);
    for (const auto& [colour, text] :
         {std::pair(kPositive, fmt::format("T = {:g} {} (turns disks ↺)", t, unit)),
          std::pair(kNegative, fmt::format("T = −{:g} {} (↻)", t, unit))}) {
      items.push_back({length,
                       [=, c = colour](Canvas& canvas, const Vector2& at) {
                         canvas.line(at, at + Vector2(length, 0), thickness, c, false, false);
                       },
                       text});
    }
  }
  if (scale.unknown) {
    items.push_back(
        {22,
         [](Canvas& canvas, const Vector2& at) { canvas.line(at, at + Vector2(22, 0), 0.6, kUnknown, true); },
         "contact of unknown force"});
  }
  return items;
}

void draw_tangential(Sheet& sheet, const Contact& contact, double t, const ForceScale& scale) {
  const double length = scale.length(t, sheet);
  const double thickness = tangent_thickness(sheet);
  if (length < 0.1) return;
  const Colour& colour = t > 0 ? kPositive : kNegative;
  const Vector2 along = Sheet::direction(contact.tangent()) * (t > 0 ? length : -length);
  const Vector2 inwards = Sheet::direction(contact.normal) * (0.5 * thickness);
  const Vector2 point = sheet.contact_point(contact);
  sheet.canvas().line(point + inwards, point + inwards + along, thickness, colour, false, false);
  if (contact.b.is_wall()) return;
  sheet.canvas().line(point - inwards, point - inwards - along, thickness, colour, false, false);
}

constexpr double kBarHeight = 34;

/// The colour bar with ticks, its label above.
void draw_colour_bar(Sheet& sheet, double largest, const std::string& unit) {
  const double width = std::min(220.0, sheet.width() - 4 * kMargin);
  const Vector2 corner{0.5 * (sheet.width() - width), sheet.legend_bottom(kBarHeight) + 10};
  Canvas& canvas = sheet.canvas();
  canvas.text({0.5 * sheet.width(), corner.y() - 3}, fmt::format("δR = R_max − R_min ({})", unit), kTextSize,
              0.5);
  canvas.colour_bar(corner, width, 7);
  const double step = round_below(largest / 4);
  for (int i = 0; step > 0 && i * step <= largest * (1 + tolerance::kLastTick); ++i) {
    const double x = corner.x() + width * i * step / largest;
    canvas.line({x, corner.y() + 7}, {x, corner.y() + 9}, 0.4, kBlack, false, false);
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
    if (!std::isfinite(r) || !std::isfinite(forces[2 * i + 1])) {
      sheet.canvas().line(sheet.centre(contact.a), sheet.end(contact), 0.6, kUnknown, true);
    } else if (r > 0) {
      sheet.canvas().line(sheet.centre(contact.a), sheet.end(contact), scale.thickness(r, sheet), kBlack,
                          false, !contact.b.is_wall());
    }
  }
  for (const int i : order) {
    const double t = forces[2 * i + 1] / scale.unit;
    if (std::isfinite(t)) draw_tangential(sheet, packing[ContactId(i)], t, scale);
  }
  sheet.finish();
}

void draw_delta_R(const std::filesystem::path& path, const Packing& packing,
                  const Eigen::Ref<const Eigen::VectorXd>& delta_R, const std::string& caption) {
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
    if (unbounded) items.push_back({22, sample(kUnbounded, 2, true), "unbounded"});
    if (missing) items.push_back({22, sample(kUnknown, 0.6, false), "no value"});
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
    const Vector2 from = sheet.centre(contact.a);
    const Vector2 to = sheet.end(contact);
    const bool round = !contact.b.is_wall();
    if (std::isnan(delta_R[i])) {
      sheet.canvas().line(from, to, 0.6, kUnknown);
    } else if (std::isinf(delta_R[i])) {
      sheet.canvas().line(from, to, thickness, kUnbounded, true, false);
    } else {
      const double fraction = largest > 0 ? delta_R[i] / largest : 0;
      sheet.canvas().line(from, to, thickness, map_colour(fraction), false, round);
    }
  }
  if (largest > 0) draw_colour_bar(sheet, largest, unit_name(packing));
  sheet.finish();
}

}  // namespace indet
