#include "libindet/range/duals.h"

#include "libindet/packing/force_bounds.h"
#include "libindet/range/contact_choice.h"

namespace indet {

std::vector<int> contacts_with_duals(const DualChoice& choice, const std::vector<int>& asked_for) {
  switch (choice.kind) {
    case DualChoice::Kind::kNone:
      return {};
    case DualChoice::Kind::kSample:
      return draw_without_replacement(asked_for, choice.sample_size, choice.seed);
    case DualChoice::Kind::kAll:
      return asked_for;
  }
  return {};
}

std::size_t dual_bytes(const Packing& packing, std::size_t contacts) {
  const auto rows = static_cast<std::size_t>(3 * packing.disk_count() + 2 * packing.wall_count() + 3) +
                    force_bounds(packing).size();
  const auto forces = 2 * static_cast<std::size_t>(packing.contact_count());
  return 4 * contacts * (rows + forces) * sizeof(double);
}

}  // namespace indet
