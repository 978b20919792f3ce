#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/ensemble/members/plan.h"
#include "apps/ensemble/members/run.h"
#include "apps/ensemble/tables/flat_table.h"
#include "libsim/protocol.h"

namespace indet {

/// Everything that figures and statistics are made from, with one row a packing, a contact, and a bin.
/// Forces and distances are in units of mg, lengths in r_max, times in √(r_max/g).
struct EnsembleTables {
  FlatTable runs;      ///< One row a packing, in the order of the plan.
  FlatTable contacts;  ///< One row a contact; `run` is the row of its packing.
  FlatTable extremal;  ///< Histogram of R in the extremal states: run, choice, objective, bin, count.
  FlatTable sampled;   ///< Distributions of R under both samplings, one row a bin (uniform_tables.h).
  FlatTable timings;   ///< Seconds by stage, one row a packing.

  EnsembleTables();
};

/// The protocol of each row of `runs`, whose column `protocol` is text. Throws InputError where it is none.
std::vector<sim::Protocol> protocols_of(const FlatTable& runs);

/// What a plan asks for and what is there.
struct Collection {
  EnsembleTables tables;
  std::vector<std::string> missing;  ///< Members without a complete file of their configuration.
};

/// Reads the member files of `folders` (parts of one ensemble). Throws InputError if a member is in two
/// folders that are not the same one.
Collection collect_members(const Plan& plan, const std::vector<std::filesystem::path>& folders,
                           const ProgressCallback& progress = {});

/// Reads of the file of a member what collect_members would read, and forgets it. Throws as that does.
void read_member(const std::filesystem::path& path);

}  // namespace indet
