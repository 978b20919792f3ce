#include "libindet/exact/block_form.h"

#include <algorithm>
#include <utility>

namespace indet::exact {

BlockForm::BlockForm(const std::vector<const IntegerColumn*>& columns, SparseLu::Blocks proposed)
    : BlockForm(columns.size()) {
  const auto count = static_cast<std::size_t>(proposed.count);
  std::vector<int> excess(count, 0);
  std::vector<std::vector<int>> above(count);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const int block = proposed.of_column[j];
    ++excess[static_cast<std::size_t>(block)];
    --excess[static_cast<std::size_t>(proposed.of_row[j])];
    for (const int i : columns[j]->row) {
      const int other = proposed.of_row[static_cast<std::size_t>(i)];
      if (other > block) return;
      if (other < block) above[static_cast<std::size_t>(block)].push_back(other);
    }
  }
  if (std::any_of(excess.begin(), excess.end(), [](int rest) { return rest != 0; })) return;
  of_row_ = std::move(proposed.of_row);
  of_column_ = std::move(proposed.of_column);
  above_ = std::move(above);
}

void BlockForm::spread_to_earlier(Blocks& blocks) const {
  for (std::size_t k = count(); k-- > 0;) {
    if (!blocks[k]) continue;
    for (const int other : above_[k]) blocks[static_cast<std::size_t>(other)] = true;
  }
}

void BlockForm::spread_to_later(Blocks& blocks) const {
  for (std::size_t k = 0; k < count(); ++k) {
    for (const int other : above_[k]) blocks[k] = blocks[k] || blocks[static_cast<std::size_t>(other)];
  }
}

BlockForm::Blocks BlockForm::reached(const std::vector<mpz_class>& right, bool transposed) const {
  Blocks blocks(count(), false);
  for (std::size_t i = 0; i < right.size(); ++i) {
    if (right[i] != 0) blocks[static_cast<std::size_t>(of_equation(i, transposed))] = true;
  }
  transposed ? spread_to_later(blocks) : spread_to_earlier(blocks);
  return blocks;
}

BlockForm::Blocks BlockForm::needed(const std::vector<int>& unknowns, bool transposed) const {
  Blocks blocks(count(), false);
  for (const int i : unknowns)
    blocks[static_cast<std::size_t>(of_unknown(static_cast<std::size_t>(i), transposed))] = true;
  transposed ? spread_to_earlier(blocks) : spread_to_later(blocks);
  return blocks;
}

}  // namespace indet::exact
