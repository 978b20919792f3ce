#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>

#include "indet/io/packing_file.h"
#include "indet/packing/packing.h"

namespace indet {

/// /sampling: the centre of an ensemble of contact states (R_1, T_1, …), in the scene's units, and numbers
/// about it
/// (@r, @spread, … in mg).
struct SamplingRecord {
  std::string method;
  Eigen::VectorXd center;
  std::map<std::string, double> numbers;
};

/// Writes the packing and its /sampling.
void write_sampling(const std::filesystem::path& path, const Packing& packing, const SamplingRecord& record,
                    const Provenance& provenance);

/// /sampling alone, for the writers of files that hold more.
void write_sampling_part(Hdf5File& file, const SamplingRecord& record);

/// Throws InputError if the file has no /sampling.
SamplingRecord read_sampling(const std::filesystem::path& path);

}  // namespace indet
