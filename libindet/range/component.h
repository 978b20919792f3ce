#pragma once

#include <utility>
#include <vector>

namespace indet {

/// A linear functional e·x whose minimum and maximum are wanted: a force component of one contact.
struct Component {
  std::vector<std::pair<int, double>> on_edges;  ///< (index into x, coefficient)
  bool minimise = true;
  bool maximise = true;
};

}  // namespace indet
