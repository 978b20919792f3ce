#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/batch/task_record.h"
#include "apps/ensemble/members/plan.h"
#include "apps/ensemble/tables/ensemble_tables.h"
#include "apps/ensemble/tables/figure.h"
#include "libindet/io/packing_file.h"

namespace indet {

/// ensemble.h5 (docs/ensemble.md).
struct EnsembleContents {
  std::string config;
  std::string hash;  ///< Of the plan.
  EnsembleTables tables;
  std::vector<std::string> missing;  ///< Members that the plan has and the tables lack.
  std::vector<ItemFailure> failures;
};

void write_ensemble(const std::filesystem::path& path, const EnsembleContents& contents,
                    const std::vector<Figure>& figures, const Provenance& provenance);

/// Throws InputError.
EnsembleContents read_ensemble(const Hdf5File& file);

}  // namespace indet
