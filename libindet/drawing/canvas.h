#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "libindet/drawing/colour_map.h"
#include "libindet/packing/packing.h"

namespace indet {

/// A page to draw on, in points (1/72 inch) from its upper left corner, y downwards. It becomes the kind of
/// file that its extension says: svg, pdf or png (300 dpi, white). Wraps Cairo.
class Canvas {
 public:
  /// Throws InputError if the extension is none of these.
  Canvas(const std::filesystem::path& path, double width, double height);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void disk(const Vector2& centre, double radius, const Colour& fill, const Colour& outline,
            double thickness);
  /// Slanted lines across a disk.
  void hatch(const Vector2& centre, double radius, const Colour& colour, double thickness);
  void line(const Vector2& from, const Vector2& to, double thickness, const Colour& colour,
            bool dashed = false, bool round = true);
  void polygon(const std::vector<Vector2>& corners, const Colour& fill);
  /// A rectangle filled with map_colour from 0 (left) to 1 (right).
  void colour_bar(const Vector2& corner, double width, double height);
  /// `align`: 0 the text begins at x, 0.5 it is centred there, 1 it ends there. y is the base line.
  void text(const Vector2& place, const std::string& text, double size, double align = 0);

  /// Writes the file.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Width of a line of text in points.
double text_width(const std::string& text, double size);

}  // namespace indet
