#include "libindet/io/stress_rule.h"

#include <fmt/format.h>

#include <cmath>

#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/equilibrium/contact_state.h"
#include "libindet/io/table.h"
#include "libindet/packing/validate.h"

namespace indet {

StressRule StressRule::parse(const std::vector<std::string>& items) {
  StressRule rule;
  rule.is_given = !items.empty();
  if (items.size() == 1 && items.front() == "none") return rule;
  for (const std::string& item : items) {
    const std::size_t equals = item.find('=');
    const std::string name = item.substr(0, equals);
    double* const component = rule.stress.find(name);
    double value = 0;
    if (equals == std::string::npos || component == nullptr ||
        !parse_number(std::string_view(item).substr(equals + 1), &value) || !std::isfinite(value)) {
      throw InputError(
          fmt::format("\"{}\" is not xx=, yy=, xy= or pressure= with a number, nor none", excerpt(item)));
    }
    if (!std::isnan(*component)) throw InputError(fmt::format("{} is given twice", name));
    *component = value;
  }
  if (const char* reason = rule.stress.contradiction()) throw InputError(reason);
  return rule;
}

StressReport impose_stress(ImportedPacking& imported, const StressRule& rule, const std::string& option) {
  Packing& packing = imported.packing;
  StressReport report;
  const bool is_possible = packing.cell.is_full() && packing.fixed_disk_count() == 0;
  if (packing.cell.is_full() && packing.has_simulated_forces())
    report.of_forces = contact_stress(packing, packing.simulated_forces());
  if (rule.is_given) {
    if (imported.stress_is_named)
      throw InputError(
          fmt::format("{}: the files say which stress is imposed, so it cannot be given", option));
    packing.stress = rule.stress;
  } else if (!imported.stress_is_named && is_possible && report.of_forces) {
    packing.stress.xx = (*report.of_forces)(0, 0);
    packing.stress.yy = (*report.of_forces)(1, 1);
    packing.stress.xy = (*report.of_forces)(0, 1);
    report.is_taken_from_forces = true;
  }
  const auto defect = find_defect(packing);
  if (defect && defect->part == PackingPart::kStress)
    throw InputError(fmt::format("{}: {}", option, defect->reason));
  return report;
}

}  // namespace indet
