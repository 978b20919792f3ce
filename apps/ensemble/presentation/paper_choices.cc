#include "apps/ensemble/presentation/paper_choices.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <sstream>

#include "apps/ensemble/presentation/paper_choices_table.h"

namespace indet {

const std::vector<PaperChoice>& paper_choices() {
  static const std::vector<PaperChoice> kChoices = [] {
    std::vector<PaperChoice> choices;
    std::istringstream table(paper_choices_table());
    std::string line;
    std::getline(table, line);  // Where it comes from.
    std::getline(table, line);  // Names of the columns.
    while (std::getline(table, line)) {
      std::istringstream cells(line);
      std::array<std::string, 4> cell;
      for (std::string& text : cell) std::getline(cells, text, '\t');
      choices.push_back({.choice = cell[0], .quantity = cell[1], .ours = cell[2], .verdict = cell[3]});
    }
    return choices;
  }();
  return kChoices;
}

std::string paper_choices_origin() {
  const std::string_view table = paper_choices_table();
  const std::size_t begin = table.find_first_not_of("# ");
  return std::string(table.substr(begin, table.find('\n') - begin));
}

std::vector<PaperChoice> choices_of(std::string_view quantity) {
  std::vector<PaperChoice> found;
  std::copy_if(paper_choices().begin(), paper_choices().end(), std::back_inserter(found),
               [&](const PaperChoice& choice) { return choice.quantity == quantity; });
  return found;
}

}  // namespace indet
