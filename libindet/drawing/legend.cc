#include "libindet/drawing/legend.h"

#include <sstream>

namespace indet {
namespace {

constexpr double kItemGap = 10;
constexpr double kTextGap = 4;  ///< Between a drawing and its text.
constexpr double kLineGap = 3;

double width_of(const LegendItem& item) { return item.width + kTextGap + text_width(item.text, kTextSize); }

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

/// Lines of legend items that fit.
std::vector<std::vector<LegendItem>> arrange(const std::vector<LegendItem>& items, double width) {
  std::vector<std::vector<LegendItem>> lines(1);
  double used = 0;
  for (const LegendItem& item : items) {
    if (!lines.back().empty() && used + width_of(item) > width) {
      lines.emplace_back();
      used = 0;
    }
    used += width_of(item) + kItemGap;
    lines.back().push_back(item);
  }
  return lines;
}

}  // namespace

Legend::Legend(const std::vector<LegendItem>& items, double width) : lines_(arrange(items, width)) {
  if (lines_.front().empty()) lines_.clear();
}

double Legend::height() const { return static_cast<double>(lines_.size()) * (kLineHeight + kLineGap); }

void Legend::draw(Canvas& canvas, const Vector2& corner) const {
  double y = corner.y() + kTextSize;
  for (const auto& line : lines_) {
    double x = corner.x();
    for (const LegendItem& item : line) {
      item.draw(canvas, {x, y - 0.35 * kTextSize});
      canvas.text({x + item.width + kTextGap, y}, item.text, kTextSize);
      x += width_of(item) + kItemGap;
    }
    y += kLineHeight + kLineGap;
  }
}

Caption::Caption(const std::string& text, double width) : lines_(wrap(text, width)) {}

double Caption::height() const { return static_cast<double>(lines_.size()) * kLineHeight; }

void Caption::draw(Canvas& canvas, const Vector2& corner) const {
  double y = corner.y() + kTextSize;
  for (const std::string& line : lines_) {
    canvas.text({corner.x(), y}, line, kTextSize);
    y += kLineHeight;
  }
}

}  // namespace indet
