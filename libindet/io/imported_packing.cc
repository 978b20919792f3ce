#include "libindet/io/imported_packing.h"

#include <fmt/format.h>

#include <cmath>

#include "libindet/base/counted.h"
namespace indet {

void warn_of_large_gaps(ImportedPacking& imported) {
  const Packing& packing = imported.packing;
  const double limit = 0.01 * packing.max_radius();
  int count = 0;
  const Contact* worst = nullptr;
  for (const Contact& contact : packing.contacts) {
    if (std::abs(contact.gap) <= limit) continue;
    ++count;
    if (worst == nullptr || std::abs(contact.gap) > std::abs(worst->gap)) worst = &contact;
  }
  if (worst == nullptr) return;
  imported.warnings.push_back(
      fmt::format("{} a gap or overlap above 1 % of the largest radius; the largest, {:.3g}, is between disk "
                  "{} and {} {}",
                  counted(count, "contact has", "contacts have"), worst->gap, packing[worst->a].id,
                  worst->b.is_wall() ? "wall" : "disk",
                  worst->b.is_wall() ? packing[worst->b.wall_id()].id : packing[worst->b.disk_id()].id));
}

}  // namespace indet
