#include "libindet/dense/lu.h"

template class Eigen::PartialPivLU<Eigen::MatrixXd>;
