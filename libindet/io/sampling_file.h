#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "libindet/io/packing_file.h"
#include "libindet/packing/packing.h"

namespace indet {

/// Numbers about single components of F, of a sample of states with convergence diagnostics.
struct ComponentRecord {
  Eigen::VectorXd deviation;         ///< 2M: standard deviation, in the scene's units
  Eigen::VectorXd quantile_levels;   ///< Q, ascending, in [0, 1]
  Eigen::MatrixXd quantiles;         ///< 2M × Q, in the scene's units
  Eigen::VectorXd rhat, bulk, tail;  ///< 2M; NaN where a component is determined
  Eigen::MatrixXd states;            ///< 2M × K: some states, in the scene's units; K may be 0
  Eigen::MatrixXd covariance;        ///< 2M × 2M, in squares of the scene's units; may be empty
  Eigen::VectorXd percentile_R;  ///< M: percentage of samples with a smaller R than simulated; may be empty
};

/// /sampling: the centre of an ensemble of contact states (R_1, T_1, …), in the scene's units, and numbers
/// about it (@r, @spread, … in mg).
struct SamplingRecord {
  std::string method;
  Eigen::VectorXd center;
  std::map<std::string, double> numbers;
  std::optional<ComponentRecord> components;
};

/// Writes the packing and its /sampling.
void write_sampling(const std::filesystem::path& path, const Packing& packing, const SamplingRecord& record,
                    const Provenance& provenance);

/// The group alone, for the writers of files that hold more.
void write_sampling_part(Hdf5File& file, const SamplingRecord& record,
                         const std::string& group = "/sampling");

/// Throws InputError if the file has no such group, or tables in it that do not fit each other.
SamplingRecord read_sampling(const Hdf5File& file, const std::string& group = "/sampling");

}  // namespace indet
