#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "libindet/io/hdf5_file.h"

namespace indet {

/// /bias of a packing of an ensemble, as stored: how perturb-and-resolve differs from the uniform
/// distribution (docs/ensemble.md). Forces in mg.
struct BiasRecord {
  /// How often values lie in [k width, (k + 1) width), k = first, first + 1, …
  struct Histogram {
    double width = 0;
    std::int64_t first = 0;
    std::vector<std::int32_t> counts;
  };
  struct SampledForces {
    std::int64_t states = 0;
    Histogram force, standard, place;  ///< R, standard_R, R_star
  };

  std::map<std::string, double> numbers;            ///< attributes
  std::map<std::string, Eigen::VectorXd> contacts;  ///< M each: mean_R, …, by the names of the datasets
  SampledForces uniform, perturb;
};

/// None if the file has no /bias. Throws InputError if something in it is missing or misshapen.
std::optional<BiasRecord> read_bias(const Hdf5File& file);

}  // namespace indet
