#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "libindet/drawing/canvas.h"
#include "libindet/drawing/legend.h"
#include "libindet/packing/packing.h"

namespace indet {

/// The unit of forces in a picture: "mg", or "force units" where the scene names one or nothing has weight.
std::string unit_name(const Packing& packing);

/// The page of a packing: where its things are, and what stands below them. From the top: the picture, the
/// legend, room for a colour bar, the caption.
class Sheet {
 public:
  /// Lengths on paper in points.
  static constexpr double kMargin = 9;

  /// `legend` is asked once the scale is known. `bar_height`: room to leave for a colour bar.
  Sheet(const std::filesystem::path& path, const Packing& packing, const std::string& caption,
        const std::function<std::vector<LegendItem>(const Sheet&)>& legend, double bar_height);

  Canvas& canvas() { return *canvas_; }
  double width() const { return width_; }
  double legend_bottom(double bar_height) const { return caption_top_ - bar_height; }
  /// Mean radius on the page.
  double radius() const { return mean_radius_ * scale_; }

  /// A point of the scene on the page.
  Vector2 place(const Vector2& point) const;
  /// A direction of the scene on the page.
  static Vector2 direction(const Vector2& vector) { return {vector.x(), -vector.y()}; }

  /// A contact on the page: the centre of a, the contact point, and the end of its line at body b: its
  /// centre, or the contact point at a wall.
  struct Line {
    Vector2 from, point, to;
  };
  /// A contact with an image has two: from a to the image of b, and from the image of a to b.
  std::vector<Line> lines(const Contact& contact) const;

  void draw_bodies();
  /// Draws legend and caption, and writes the file.
  void finish();

 private:
  void measure();
  void draw_wall_lines(const std::vector<Vector2>& domain);
  void draw_loads(const std::vector<Vector2>& domain);
  /// The sides of the cell, dashed, about the middle of the disks.
  void draw_cell();
  void measure_cell();

  const Packing& packing_;
  Vector2 low_{0, 0}, high_{0, 0};
  std::vector<std::pair<Vector2, Vector2>> cell_sides_;  ///< in the scene
  double scale_ = 1, mean_radius_ = 1, width_ = 0, left_ = 0, legend_top_ = 0, caption_top_ = 0;
  std::optional<Legend> legend_;
  std::optional<Caption> caption_;
  std::optional<Canvas> canvas_;
};

}  // namespace indet
