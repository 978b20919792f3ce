#pragma once

#include <functional>
#include <string>
#include <vector>

#include "libindet/drawing/canvas.h"

namespace indet {

// Text beside a picture, in points.
inline constexpr double kTextSize = 8;
inline constexpr double kLineHeight = 11;

/// One entry of the legend: a drawing of some width at the middle of a line, then a text.
struct LegendItem {
  double width;
  std::function<void(Canvas&, const Vector2&)> draw;  ///< Gets the left end of the drawing.
  std::string text;
};

/// A legend broken into lines that fit.
class Legend {
 public:
  Legend(const std::vector<LegendItem>& items, double width);

  double height() const;
  /// From the upper left corner.
  void draw(Canvas& canvas, const Vector2& corner) const;

 private:
  std::vector<std::vector<LegendItem>> lines_;
};

/// A caption broken into lines that fit.
class Caption {
 public:
  Caption(const std::string& text, double width);

  double height() const;
  /// From the upper left corner.
  void draw(Canvas& canvas, const Vector2& corner) const;

 private:
  std::vector<std::string> lines_;
};

}  // namespace indet
