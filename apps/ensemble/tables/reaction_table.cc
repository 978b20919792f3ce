#include "apps/ensemble/tables/reaction_table.h"

#include <utility>

namespace indet {

std::vector<FlatTable::Column> reaction_columns() {
  return {FlatTable::integer("run", "row of the packing in /table/runs"),
          FlatTable::integer("body", "-(w+1) for the wall of row w"),
          FlatTable::integer("component", "0: sum of R, 1: sum of T"),
          FlatTable::real("minimum", "mg", "smallest value of the sum"),
          FlatTable::real("maximum", "mg", "largest value of the sum"),
          FlatTable::real("lower", "mg", "lower end of the enclosure of the minimum"),
          FlatTable::real("upper", "mg", "upper end of the enclosure of the maximum")};
}

void add_reactions(const Hdf5File& file, const Packing& packing, std::size_t run, FlatTable& table) {
  if (!file.has("/reactions")) return;
  const std::size_t count = file.shape("/reactions/body", 1)[0];
  const std::size_t first = table.rows();
  table.add_rows(count);
  const std::vector<std::int32_t> body = file.read_integers("/reactions/body", {count});
  const std::vector<std::int32_t> component = file.read_integers("/reactions/component", {count});
  for (std::size_t k = 0; k < count; ++k) {
    table.set("run", first + k, static_cast<double>(run));
    table.set("body", first + k, body[k]);
    table.set("component", first + k, component[k]);
  }
  const double mg = packing.force_unit();
  const auto take = [&](const char* dataset, std::size_t end, const char* column) {
    const std::vector<double> values = file.read_doubles(dataset, {count, 2});
    for (std::size_t k = 0; k < count; ++k) table.set(column, first + k, values[2 * k + end] / mg);
  };
  take("/reactions/value", 0, "minimum");
  take("/reactions/value", 1, "maximum");
  take("/reactions/lower", 0, "lower");
  take("/reactions/upper", 1, "upper");
}

}  // namespace indet
