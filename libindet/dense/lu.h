#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

// Compiled once, in lu.cc: include this header, not <Eigen/LU>.
extern template class Eigen::PartialPivLU<Eigen::MatrixXd>;
