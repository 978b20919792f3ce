#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace indet {

/// How a curve is drawn. Colours are those of Okabe and Ito, which colour-blind people tell apart.
enum class Mark : std::uint8_t { kLine, kDashed, kDotted, kPoints };

/// One curve of a figure: points with, where there are any, standard errors. NaN in y is a gap.
struct Series {
  std::string name;
  std::vector<double> x, y;
  std::vector<double> error = {};  ///< Empty: none.
  Mark mark = Mark::kLine;
  int colour = 0;  ///< 0 … 7.
  bool thick = true;
  int symbol = 0;  ///< Of points: 0 … 3.
};

struct Axis {
  std::string label;         ///< In words and Unicode; "δR (mg)".
  double low = 0, high = 0;  ///< Equal: from the data.
  bool logarithmic = false;
};

struct Panel {
  std::string title;
  Axis x, y;
  std::vector<Series> series;
  bool legend_left = false;
  bool legend_below = false;  ///< Under the axis, where curves fill the panel.
};

/// One figure: its data and what is said about it. SVG, PDF, CSV, gnuplot script, HDF5 group and HTML are all
/// made from this.
struct Figure {
  std::string id;  ///< "fig07".
  std::string title;
  std::string caption;  ///< With the definitions.
  std::string claim;    ///< Of the paper.
  std::string finding;  ///< Ours, with numbers.
  std::vector<Panel> panels;
};

}  // namespace indet
