#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "apps/command.h"
#include "apps/ensemble/members/plan.h"
#include "apps/ensemble/members/run.h"
#include "apps/ensemble/tables/collect.h"
#include "libindet/io/replacement.h"

namespace indet::app {

/// What became of the members of this run.
struct Outcomes {
  int done = 0;
  int skipped = 0;
  std::vector<MemberFailure> failures;
};

/// Throws InputError unless the files of an ensemble may be written into the folder. One with the
/// ensemble.toml of an ensemble is its own, and its packings may be computed anew; what the run reads may
/// not.
void claim_folder(const std::filesystem::path& folder, const Plan& plan, const Replacement& rule);

/// Says what a run of some members did; returns the exit status.
int report_part(const std::filesystem::path& folder, int first, int last, const Outcomes& outcomes,
                double seconds, const Context& context);

/// Writes what was collected to FOLDER/ensemble.h5 and says what is in it; returns the exit status: 5 if
/// members are missing or something is imprecise.
int finish_ensemble(const std::filesystem::path& folder, const Plan& plan, Collection collection,
                    const Outcomes& outcomes, const std::function<double()>& seconds, const Context& context);

}  // namespace indet::app
