#include "libindet/verify/rebuilt_ellipsoid.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "libindet/base/tolerances.h"

namespace indet {
namespace {

bool is_first_of_two(const RebuiltProblem& problem, int half_plane) {
  return half_plane % 2 == 0 || half_plane >= 2 * problem.contact_count();
}

}  // namespace

std::unique_ptr<const RebuiltEllipsoid> RebuiltEllipsoid::about(const RebuiltProblem& problem,
                                                                const Eigen::VectorXd& centre, double least) {
  for (int h = 0; h < problem.half_planes(); ++h) {
    if (!(problem.slack(h, centre) > least)) return nullptr;
  }
  std::unique_ptr<const RebuiltEllipsoid> ellipsoid(new RebuiltEllipsoid(problem, centre));
  if (ellipsoid->factor_.info() != Eigen::Success) return nullptr;
  return ellipsoid;
}

RebuiltEllipsoid::RebuiltEllipsoid(const RebuiltProblem& problem, const Eigen::VectorXd& centre)
    : equations_(problem.matrix()), slope_(Eigen::VectorXd::Zero(centre.size())) {
  std::vector<Eigen::Matrix2d> hessian(static_cast<std::size_t>(problem.contact_count()),
                                       Eigen::Matrix2d::Zero());
  for (int h = 0; h < problem.half_planes(); ++h) {
    const auto [contact, along] = problem.gradient_of(h);
    // Without friction both half-planes of a contact are R ≥ 0.
    if (along.y() == 0 && !is_first_of_two(problem, h)) continue;
    const Vector2 normal = along / problem.slack(h, centre);
    slope_.segment<2>(2 * contact) += normal;
    hessian[static_cast<std::size_t>(contact)] += normal * normal.transpose();
  }
  std::vector<bool> is_held(static_cast<std::size_t>(centre.size()), false);
  for (const int component : problem.held()) is_held[static_cast<std::size_t>(component)] = true;
  std::vector<Eigen::Triplet<double>> entries;
  for (int c = 0; c < problem.contact_count(); ++c) {
    const Eigen::Matrix2d& block = hessian[static_cast<std::size_t>(c)];
    const int first = 2 * c;
    const bool holds_R = is_held[static_cast<std::size_t>(first)];
    const bool holds_T = is_held[static_cast<std::size_t>(first) + 1];
    if (!holds_R && !holds_T) {
      const Eigen::Matrix2d inverse = block.inverse();
      for (const int i : {0, 1}) {
        for (const int j : {0, 1}) entries.emplace_back(first + i, first + j, inverse(i, j));
      }
    } else {
      if (!holds_R) entries.emplace_back(first, first, 1 / block(0, 0));
      if (!holds_T) entries.emplace_back(first + 1, first + 1, 1 / block(1, 1));
    }
  }
  inverse_.resize(centre.size(), centre.size());
  inverse_.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseMatrix<double> complement = equations_ * inverse_ * equations_.transpose();
  // Rows of c may depend on each other; what lifts the factor from 0 is an error of λ below.
  for (Eigen::Index i = 0; i < complement.rows(); ++i) {
    const double diagonal = complement.coeff(i, i);
    complement.coeffRef(i, i) = diagonal > 0 ? diagonal * (1 + tolerance::kRebuiltLift) : 1;
  }
  factor_.compute(complement);
}

double RebuiltEllipsoid::size(const Eigen::VectorXd& vector) const {
  // vᵀPv is the least of |v − cᵀλ|² in the norm of H⁻¹, so that an error of λ hardly counts.
  Eigen::VectorXd rest = vector;
  constexpr int kSolves = 3;  // the first, and two that refine it
  for (int k = 0; k < kSolves && equations_.rows() > 0; ++k)
    rest -= equations_.transpose() * factor_.solve(equations_ * (inverse_ * rest));
  return std::sqrt(rest.dot(inverse_ * rest));
}

double RebuiltEllipsoid::decrement() const { return size(slope_); }

double RebuiltEllipsoid::width(int component) const {
  return size(Eigen::VectorXd::Unit(slope_.size(), component));
}

}  // namespace indet
