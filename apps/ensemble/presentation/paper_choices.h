#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace indet {

/// A row of the comparison with the paper as it comes out with another choice of what the paper leaves open.
struct PaperChoice {
  std::string choice;    ///< "k = 1.2e6 mg/r_max"
  std::string quantity;  ///< Comparison::quantity
  std::string ours;
  std::string verdict;
};

/// All rows of docs/measurements/paper-choices.tsv, which bench/paper_choices.py makes.
const std::vector<PaperChoice>& paper_choices();

/// The command that made them, and when: the first line of that file.
std::string paper_choices_origin();

/// Those of one quantity, in the order of the file.
std::vector<PaperChoice> choices_of(std::string_view quantity);

}  // namespace indet
