#include "libindet/drawing/trajectory_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "libindet/io/picture_mark.h"
#include "libindet/io/whole_file.h"

namespace indet {
namespace {

// Points.
constexpr double kFrameHeight = 300;
constexpr double kFrameWidest = 240;
constexpr double kGap = 12;
constexpr double kText = 9;
constexpr double kThickest = 0.5;  ///< Of a force line, in radii of the largest disk.

/// Maps the scene to one frame of the picture.
class View {
 public:
  View(const Packing& packing, const Trajectory& trajectory) : packing_(packing) {
    Vector2 low = trajectory.front().positions.front();
    Vector2 high = low;
    for (const TrajectoryFrame& frame : trajectory) {
      for (std::size_t i = 0; i < frame.positions.size(); ++i) {
        const Vector2 r = Vector2::Constant(packing.disks[i].radius);
        low = low.cwiseMin(frame.positions[i] - r);
        high = high.cwiseMax(frame.positions[i] + r);
      }
    }
    // Impacts on the way are much stronger than the forces at rest; they are cut off when drawn.
    for (const Contact& contact : trajectory.back().contacts) largest_ = std::max(largest_, contact.R);
    low_ = low;
    high_ = high;
    scale_ = std::min(kFrameHeight / (high.y() - low.y()), kFrameWidest / (high.x() - low.x()));
  }

  double width() const { return (high_.x() - low_.x()) * scale_; }
  double height() const { return (high_.y() - low_.y()) * scale_; }

  void draw(const TrajectoryFrame& frame, std::string& svg) const {
    const auto out = std::back_inserter(svg);
    draw_walls(svg);
    for (std::size_t i = 0; i < frame.positions.size(); ++i) {
      const Vector2 centre = place(frame.positions[i]);
      const double r = packing_.disks[i].radius * scale_;
      const double angle = frame.angles[i];
      fmt::format_to(
          out, "<circle {}cx='{:.2f}' cy='{:.2f}' r='{:.2f}'/><path d='M{:.2f} {:.2f}l{:.2f} {:.2f}'/>\n",
          packing_.disks[i].fixed ? "class='x' " : "", centre.x(), centre.y(), r, centre.x(), centre.y(),
          r * std::cos(angle), -r * std::sin(angle));
    }
    if (!(largest_ > 0)) return;
    for (const Contact& contact : frame.contacts) {
      const Vector2& a = frame.positions[static_cast<std::size_t>(contact.a.value())];
      const Vector2 b = contact.b.is_wall()
                            ? Vector2(a - packing_.lever_a(contact) * contact.normal)
                            : frame.positions[static_cast<std::size_t>(contact.b.disk_id().value())];
      const Vector2 from = place(a);
      const Vector2 to = place(b);
      fmt::format_to(out, "<path class='f' stroke-width='{:.2f}' d='M{:.2f} {:.2f}L{:.2f} {:.2f}'/>\n",
                     kThickest * packing_.max_radius() * scale_ * std::min(1.0, contact.R / largest_),
                     from.x(), from.y(), to.x(), to.y());
    }
  }

 private:
  Vector2 place(const Vector2& p) const {
    return {(p.x() - low_.x()) * scale_, (high_.y() - p.y()) * scale_};
  }

  void draw_walls(std::string& svg) const {
    const double reach = (high_ - low_).norm();
    for (const Wall& wall : packing_.walls) {
      const Vector2 along(wall.normal.y(), -wall.normal.x());
      const Vector2 middle = (low_ + high_) / 2;
      const Vector2 foot = wall.point + along * along.dot(middle - wall.point);
      const Vector2 from = place(foot - reach * along);
      const Vector2 to = place(foot + reach * along);
      fmt::format_to(std::back_inserter(svg), "<path class='w' d='M{:.2f} {:.2f}L{:.2f} {:.2f}'/>\n",
                     from.x(), from.y(), to.x(), to.y());
    }
  }

  const Packing& packing_;
  Vector2 low_, high_;
  double scale_ = 1;
  double largest_ = 0;
};

/// The hatching of fixed disks, where there are any.
std::string hatching(const Packing& packing) {
  if (packing.fixed_disk_count() == 0) return "";
  return "<defs><pattern id='h' width='3' height='3' patternUnits='userSpaceOnUse' "
         "patternTransform='rotate(45)'><path d='M0 0v3'/></pattern></defs><style>.x{fill:url(#h)}</style>\n";
}

std::string head(double width, double height) {
  return fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.2f}' height='{1:.2f}' viewBox='0 0 {0:.2f} "
      "{1:.2f}'>\n"
      "<style>circle{{fill:#eee;stroke:#999;stroke-width:.5}}path{{stroke:#999;stroke-width:.5;fill:none}}"
      ".f{{stroke:#0072b2;stroke-linecap:round}}.w{{stroke:#333;stroke-width:1}}"
      "text{{font:{2}px sans-serif;text-anchor:middle}}svg svg{{overflow:hidden}}</style>\n"
      "<rect width='100%' height='100%' fill='#fff'/>\n",
      width, height, kText);
}

std::string time_label(double time) { return fmt::format("t = {:.4g}", time); }

/// One frame as a nested picture, so that walls end at its edge.
std::string framed(const View& view, const TrajectoryFrame& frame, double x) {
  std::string svg = fmt::format("<svg x='{:.2f}' y='{:.2f}' width='{:.2f}' height='{:.2f}'>\n", x, kGap,
                                view.width(), view.height());
  view.draw(frame, svg);
  svg += "</svg>\n";
  svg += fmt::format("<text x='{:.2f}' y='{:.2f}'>{}</text>\n", x + view.width() / 2,
                     kGap + view.height() + 1.5 * kText, time_label(frame.time));
  return svg;
}

}  // namespace

void draw_trajectory_strip(const std::filesystem::path& path, const Packing& packing,
                           const Trajectory& trajectory, int frames) {
  const View view(packing, trajectory);
  const int count = std::min(frames, static_cast<int>(trajectory.size()));
  std::string svg = head(kGap + count * (view.width() + kGap), view.height() + 2 * kGap + 2 * kText);
  svg += hatching(packing);
  for (int i = 0; i < count; ++i) {
    const std::size_t at = count == 1 ? trajectory.size() - 1
                                      : static_cast<std::size_t>(i) * (trajectory.size() - 1) /
                                            static_cast<std::size_t>(count - 1);
    svg += framed(view, trajectory[at], kGap + i * (view.width() + kGap));
  }
  write_whole_file(path, mark_svg(svg + "</svg>\n"));
}

void draw_trajectory_animation(const std::filesystem::path& path, const Packing& packing,
                               const Trajectory& trajectory, double seconds) {
  const View view(packing, trajectory);
  std::string svg = head(2 * kGap + view.width(), view.height() + 2 * kGap + 2 * kText);
  svg += hatching(packing);
  const auto count = static_cast<double>(trajectory.size());
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const double begin = static_cast<double>(i) / count;
    const double end = static_cast<double>(i + 1) / count;
    svg += fmt::format("<g visibility='{}'>\n", i + 1 == trajectory.size() ? "visible" : "hidden");
    // Hidden, visible from `begin`, hidden again from `end`.
    if (i == 0) {
      svg +=
          fmt::format("<animate attributeName='visibility' values='visible;hidden' keyTimes='0;{:.6f}'", end);
    } else if (i + 1 == trajectory.size()) {
      svg += fmt::format("<animate attributeName='visibility' values='hidden;visible' keyTimes='0;{:.6f}'",
                         begin);
    } else {
      svg += fmt::format(
          "<animate attributeName='visibility' values='hidden;visible;hidden' keyTimes='0;{:.6f};{:.6f}'",
          begin, end);
    }
    svg += fmt::format(" calcMode='discrete' dur='{}s' repeatCount='indefinite'/>\n", seconds);
    svg += framed(view, trajectory[i], kGap) + "</g>\n";
  }
  write_whole_file(path, mark_svg(svg + "</svg>\n"));
}

}  // namespace indet
