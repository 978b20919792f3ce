#include "libindet/verify/sparse_optimality.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "libindet/base/tolerances.h"

namespace indet {
namespace {

constexpr int kRounds = 6;  ///< of refinement, which takes the effect of the ridge out again

using Normals = std::map<int, std::vector<Vector2>>;

/// The directions of a contact's force that leave its tight slacks as they are.
std::vector<Vector2> free_directions(const std::vector<Vector2>& normals, bool has_friction) {
  if (normals.empty()) {
    return has_friction ? std::vector<Vector2>{{1, 0}, {0, 1}} : std::vector<Vector2>{{1, 0}};
  }
  if (normals.size() > 1 || !has_friction) return {};
  return {Vector2(-normals[0].y(), normals[0].x())};
}

/// How far `rest` is from Σ λ n, λ ≥ 0.
double distance_from_cone(const Vector2& rest, const std::vector<Vector2>& normals, bool has_friction) {
  if (!has_friction) return normals.empty() ? std::abs(rest.x()) : std::max(0.0, -rest.x());
  if (normals.empty()) return rest.norm();
  double nearest = rest.norm();
  for (const Vector2& n : normals)
    nearest = std::min(nearest, (rest - std::max(0.0, rest.dot(n)) / n.squaredNorm() * n).norm());
  if (normals.size() == 2) {
    Eigen::Matrix2d both;
    both << normals[0], normals[1];
    const Vector2 weights = both.partialPivLu().solve(rest);
    if (weights.minCoeff() >= 0) return 0;
  }
  return nearest;
}

}  // namespace

double sparse_optimality_gap(const RebuiltProblem& problem, int component, double sign,
                             const std::vector<int>& tight) {
  Normals normals;
  for (const int h : tight) {
    const auto [contact, along] = problem.gradient_of(h);
    normals[contact].push_back(along);
  }
  const auto normals_of = [&](int contact) {
    const auto at = normals.find(contact);
    return at == normals.end() ? std::vector<Vector2>() : at->second;
  };
  // The columns of c along which forces are free, and the gradient there.
  const Eigen::SparseMatrix<double>& c = problem.matrix();
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> gradient;
  for (int i = 0; i < problem.contact_count(); ++i) {
    for (const Vector2& along : free_directions(normals_of(i), problem.has_friction(i))) {
      const auto column = static_cast<int>(gradient.size());
      for (const int k : {0, 1}) {
        if (along[k] == 0) continue;
        for (Eigen::SparseMatrix<double>::InnerIterator entry(c, 2 * i + k); entry; ++entry)
          entries.emplace_back(static_cast<int>(entry.row()), column, along[k] * entry.value());
      }
      gradient.push_back(component / 2 == i ? sign * along[component % 2] : 0);
    }
  }
  Eigen::SparseMatrix<double> free(c.rows(), static_cast<Eigen::Index>(gradient.size()));
  free.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseMatrix<double> identity(c.rows(), c.rows());
  identity.setIdentity();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(
      Eigen::SparseMatrix<double>(free * free.transpose()) + tolerance::kOptimalityRidge * identity);
  if (factor.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(c.rows());
  const Eigen::Map<const Eigen::VectorXd> wanted(gradient.data(), std::ssize(gradient));
  for (int round = 0; round < kRounds; ++round) y += factor.solve(free * (wanted - free.transpose() * y));
  const Eigen::VectorXd along = c.transpose() * y;
  double gap = 0;
  for (int i = 0; i < problem.contact_count(); ++i) {
    Vector2 rest = along.segment<2>(2 * i);
    if (component / 2 == i) rest[component % 2] -= sign;
    gap = std::max(gap, distance_from_cone(rest, normals_of(i), problem.has_friction(i)));
  }
  return gap;
}

}  // namespace indet
