#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>

#include "libindet/io/hdf5_file.h"

namespace indet {

/// A dataset with the entries of a vector.
inline void write_vector(Hdf5File& file, const std::string& path, const Eigen::VectorXd& values,
                         const Label& label) {
  const auto size = static_cast<std::size_t>(values.size());
  file.write(path, std::span<const double>(values.data(), size), {size}, label);
}

}  // namespace indet
