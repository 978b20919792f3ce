#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/batch/run_items.h"
#include "apps/command.h"
#include "apps/ensemble/members/plan.h"
#include "apps/ensemble/tables/collect.h"
#include "libindet/io/replacement.h"

namespace indet::app {

/// Throws InputError unless the files of an ensemble may be written into the folder. One with the
/// ensemble.toml of an ensemble is its own, and its packings may be computed anew; what the run reads may
/// not.
void claim_folder(const std::filesystem::path& folder, const std::vector<Member>& members,
                  const Replacement& rule);

/// Writes what was collected to FOLDER/ensemble.h5 and says what is in it; returns the exit status: 5 if
/// members are missing or something is imprecise.
int finish_ensemble(const std::filesystem::path& folder, const Plan& plan, Collection collection,
                    const BatchSummary& summary, const std::function<double()>& seconds,
                    const Context& context);

}  // namespace indet::app
