#pragma once

#include <Eigen/Core>
#include <vector>

#include "libindet/packing/packing.h"

namespace indet {

/// A reaction (range/reactions.h) set up anew from the packing: coefficients · (R_1, T_1, …, R_M, T_M).
struct RebuiltSum {
  Body body;
  int component = 0;
  Eigen::VectorXd coefficients;  ///< 2M
};

/// Of walls first, then of fixed disks; those without contacts, and ΣT of frictionless walls, are left out.
std::vector<RebuiltSum> rebuilt_sums(const Packing& packing);

}  // namespace indet
