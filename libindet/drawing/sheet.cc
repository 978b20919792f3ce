#include "libindet/drawing/sheet.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "libindet/base/tolerances.h"
#include "libindet/drawing/palette.h"

namespace indet {
namespace {

constexpr double kWidest = 360;
constexpr double kHighest = 500;
constexpr double kNarrowest = 230;  // room for legend and caption

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

}  // namespace

std::string unit_name(const Packing& packing) {
  return packing.named_force_unit > 0 || !packing.has_weight() ? "force units" : "mg";
}

Sheet::Sheet(const std::filesystem::path& path, const Packing& packing, const std::string& caption,
             const std::function<std::vector<LegendItem>(const Sheet&)>& legend, double bar_height)
    : packing_(packing) {
  measure();
  caption_.emplace(caption, width_ - 2 * kMargin);
  legend_.emplace(legend(*this), width_ - 2 * kMargin);
  legend_top_ = kMargin + (high_.y() - low_.y()) * scale_ + kMargin;
  caption_top_ = legend_top_ + (legend_->height() + bar_height);
  canvas_.emplace(path, width_, caption_top_ + caption_->height() + kMargin);
}

Vector2 Sheet::place(const Vector2& point) const {
  return {left_ + (point.x() - low_.x()) * scale_, kMargin + (high_.y() - point.y()) * scale_};
}

std::vector<Sheet::Line> Sheet::lines(const Contact& contact) const {
  const Vector2& a = packing_[contact.a].position;
  const Vector2 point = packing_.contact_point(contact);
  if (contact.b.is_wall()) return {{place(a), place(point), place(point)}};
  const Vector2& b = packing_[contact.b.disk_id()].position;
  if (!contact.has_image()) return {{place(a), place(point), place(b)}};
  const Vector2 image = a - packing_.branch(contact);
  const Vector2 back = b - image;
  return {{place(a), place(point), place(image)}, {place(a + back), place(point + back), place(b)}};
}

void Sheet::draw_bodies() {
  const std::vector<Vector2> view = {low_, {high_.x(), low_.y()}, high_, {low_.x(), high_.y()}};
  std::vector<Vector2> domain = view;
  for (const Wall& wall : packing_.walls) domain = clip(domain, wall);
  for (Wall wall : packing_.walls) {
    wall.normal = -wall.normal;
    std::vector<Vector2> behind = clip(view, wall);
    for (Vector2& corner : behind) corner = place(corner);
    canvas_->polygon(behind, palette::kWallFill);
  }
  for (const Disk& disk : packing_.disks) {
    const double thickness = std::min(0.5, 0.1 * disk.radius * scale_);
    canvas_->disk(place(disk.position), disk.radius * scale_, palette::kDiskFill, palette::kDiskOutline,
                  thickness);
    if (disk.fixed)
      canvas_->hatch(place(disk.position), disk.radius * scale_, palette::kDiskOutline, thickness);
  }
  draw_wall_lines(domain);
  draw_cell();
  draw_loads(domain);
}

void Sheet::finish() {
  legend_->draw(*canvas_, {kMargin, legend_top_});
  caption_->draw(*canvas_, {kMargin, caption_top_});
  canvas_->finish();
}

/// The part of the scene that is shown, and its scale.
void Sheet::measure() {
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
  if (packing_.cell.is_periodic() && !packing_.disks.empty()) measure_cell();
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

/// Where the cell lies is not known, only its vectors: its middle is put at that of the disks, in coordinates
/// along these. Contacts across the boundary may reach beyond the disks.
void Sheet::measure_cell() {
  const auto& [a, b] = packing_.cell;
  const bool is_full = packing_.cell.is_full();
  const Vector2 first = a ? *a : *b;
  const Vector2 second = is_full ? *b : Vector2(-first.y(), first.x()).normalized();
  Eigen::Matrix2d vectors;
  vectors << first, second;
  const Eigen::Matrix2d inverse = vectors.inverse();
  Vector2 least = inverse * packing_.disks.front().position;
  Vector2 most = least;
  for (const Disk& disk : packing_.disks) {
    const Vector2 place = inverse * disk.position;
    // Across a cell of one direction the sides reach as far as the disks do.
    const Vector2 reach(0, is_full ? 0 : disk.radius);
    least = least.cwiseMin(place - reach);
    most = most.cwiseMax(place + reach);
  }
  const Vector2 size(1, is_full ? 1 : most.y() - least.y());
  const Vector2 start = (least + most - size) / 2;
  const Vector2 corner = vectors * start;
  const Vector2 right = first * size.x();
  const Vector2 up = second * size.y();
  cell_sides_ = {{corner, corner + up}, {corner + right, corner + right + up}};
  if (is_full) {
    cell_sides_.emplace_back(corner, corner + right);
    cell_sides_.emplace_back(corner + up, corner + right + up);
  }
  const auto show = [&](const Vector2& point) {
    low_ = low_.cwiseMin(point);
    high_ = high_.cwiseMax(point);
  };
  for (const auto& [from, to] : cell_sides_) {
    show(from);
    show(to);
  }
  for (const Contact& contact : packing_.contacts) {
    if (!contact.has_image()) continue;
    const Vector2 branch = packing_.branch(contact);
    show(packing_[contact.a].position - branch);
    show(packing_[contact.b.disk_id()].position + branch);
  }
}

void Sheet::draw_cell() {
  for (const auto& [from, to] : cell_sides_)
    canvas_->line(place(from), place(to), 0.6, palette::kCell, true, false);
}

/// The edges of the domain that walls make.
void Sheet::draw_wall_lines(const std::vector<Vector2>& domain) {
  const double close = tolerance::kSamePoint * (high_ - low_).norm();
  for (std::size_t i = 0; i < domain.size(); ++i) {
    const Vector2& from = domain[i];
    const Vector2& to = domain[(i + 1) % domain.size()];
    const bool wall = std::any_of(packing_.walls.begin(), packing_.walls.end(), [&](const Wall& w) {
      return std::abs((from - w.point).dot(w.normal)) < close &&
             std::abs((to - w.point).dot(w.normal)) < close;
    });
    if (wall && (to - from).norm() > close) canvas_->line(place(from), place(to), 1, palette::kBlack);
  }
}

/// At the middle of each loaded wall's part of the domain's edge: an arrow for what pushes along its normal,
/// ending on the wall, a thinner one along its tangent (t), and the loads behind the wall.
void Sheet::draw_loads(const std::vector<Vector2>& domain) {
  constexpr double kArrow = 16;
  constexpr double kHead = 5;
  constexpr double kText = 6;
  const double close = tolerance::kSamePoint * (high_ - low_).norm();
  const double unit = packing_.force_unit();
  const auto arrow = [&](const Vector2& tip, const Vector2& towards, double thickness) {
    const Vector2 side(-towards.y(), towards.x());
    const Vector2 neck = tip - kHead * towards;
    canvas_->line(tip - kArrow * towards, neck, thickness, palette::kLoad, false, false);
    canvas_->polygon({tip, neck + kHead / 2 * side, neck - kHead / 2 * side}, palette::kLoad);
  };
  for (const Wall& wall : packing_.walls) {
    if (!wall.is_loaded()) continue;
    Vector2 middle = wall.point;
    double longest = 0;
    for (std::size_t i = 0; i < domain.size(); ++i) {
      const Vector2& from = domain[i];
      const Vector2& to = domain[(i + 1) % domain.size()];
      const bool on_wall = std::abs((from - wall.point).dot(wall.normal)) < close &&
                           std::abs((to - wall.point).dot(wall.normal)) < close;
      if (!on_wall || (to - from).norm() <= longest) continue;
      longest = (to - from).norm();
      middle = (from + to) / 2;
    }
    const Vector2 at = place(middle);
    const Vector2 outwards = direction(Vector2(-wall.normal));
    const Vector2 behind = at + kArrow / 2 * outwards;
    const bool is_upright = std::abs(outwards.x()) > std::abs(outwards.y());
    if (wall.is_free_along_normal()) {
      const Vector2 towards = wall.load_n < 0 ? outwards : Vector2(-outwards);
      if (wall.load_n != 0) arrow(wall.load_n < 0 ? Vector2(at + kArrow * outwards) : at, towards, 1.5);
      const Vector2 aside = is_upright ? Vector2(0, -kArrow / 2 - 2) : Vector2(kHead, kText / 3);
      canvas_->text(behind + aside, fmt::format("{:.3g} {}", wall.load_n / unit, unit_name(packing_)), kText,
                    is_upright ? 0.5 : 0);
    }
    if (wall.is_free_along_tangent()) {
      const Vector2 towards = direction(wall.load_t < 0 ? Vector2(-wall.tangent()) : wall.tangent());
      if (wall.load_t != 0) arrow(at + kArrow / 2 * towards, towards, 0.75);
      const Vector2 aside = is_upright ? Vector2(0, kArrow / 2 + kText) : Vector2(-kHead, kText / 3);
      canvas_->text(behind + aside, fmt::format("t {:.3g} {}", wall.load_t / unit, unit_name(packing_)),
                    kText, is_upright ? 0.5 : 1);
    }
  }
}

}  // namespace indet
