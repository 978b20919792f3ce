#include "apps/ensemble/tables/ensemble_tables.h"

#include <fmt/format.h>

#include "apps/ensemble/tables/contact_table.h"
#include "apps/ensemble/tables/reaction_table.h"
#include "apps/ensemble/tables/run_table.h"
#include "apps/ensemble/tables/uniform_tables.h"
#include "libindet/base/error.h"
#include "libindet/base/printable.h"

namespace indet {

EnsembleTables::EnsembleTables()
    : runs(run_columns()),
      contacts(contact_columns()),
      reactions(reaction_columns()),
      extremal(extremal_columns()),
      sampled(sampled_columns()),
      timings(timing_columns()) {}

std::vector<sim::Protocol> protocols_of(const FlatTable& runs) {
  std::vector<sim::Protocol> protocols;
  for (std::size_t run = 0; run < runs.rows(); ++run) {
    const auto protocol = sim::protocol_from(runs.text("protocol", run));
    if (!protocol) {
      throw InputError(
          fmt::format("/table/runs/protocol: \"{}\" is no protocol", excerpt(runs.text("protocol", run))));
    }
    protocols.push_back(*protocol);
  }
  return protocols;
}

}  // namespace indet
