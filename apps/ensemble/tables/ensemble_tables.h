#pragma once

#include <vector>

#include "apps/ensemble/tables/flat_table.h"
#include "libsim/protocol.h"

namespace indet {

/// Everything that figures and statistics are made from, with one row a packing, a contact, and a bin.
/// Forces and distances are in units of mg, lengths in r_max, times in √(r_max/g).
struct EnsembleTables {
  FlatTable runs;       ///< One row a packing, in the order of the plan (run_table.h).
  FlatTable contacts;   ///< One row a contact; `run` is the row of its packing (contact_table.h).
  FlatTable reactions;  ///< One row a sum over the contacts of a wall (reaction_table.h).
  FlatTable extremal;   ///< Histogram of R in the extremal states: run, choice, objective, bin, count.
  FlatTable sampled;    ///< Distributions of R under both samplings, one row a bin (uniform_tables.h).
  FlatTable timings;    ///< Seconds by stage, one row a packing.

  EnsembleTables();
};

/// The protocol of each row of `runs`, whose column `protocol` is text. Throws InputError where it is none.
std::vector<sim::Protocol> protocols_of(const FlatTable& runs);

}  // namespace indet
