#include "libindet/verify/rebuilt_problem.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "libindet/base/tolerances.h"
#include "libindet/dense/lu.h"
#include "libindet/dense/qr.h"
#include "libindet/verify/nonnegative.h"

namespace indet {

std::optional<int> nullity_by_inertia(const Eigen::SparseMatrix<double>& matrix, double threshold) {
  double largest = 0;
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) largest = std::max(largest, matrix.col(j).norm());
  if (largest == 0) return static_cast<int>(matrix.cols());
  Eigen::SparseMatrix<double> unit(matrix.rows(), matrix.rows());
  unit.setIdentity();
  const double shift = threshold * largest;
  const Eigen::SparseMatrix<double> shifted = matrix * matrix.transpose() - shift * shift * unit;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(shifted);
  if (factor.info() != Eigen::Success) return std::nullopt;
  const auto rank = static_cast<int>((factor.vectorD().array() > 0).count());
  return static_cast<int>(matrix.cols()) - rank;
}

RebuiltProblem::RebuiltProblem(const Packing& packing)
    : packing_(packing),
      force_unit_(packing.force_unit()),
      internal_unit_(packing.internal_force_unit() / force_unit_) {
  const int disks = packing.disk_count();
  const int contacts = packing.contact_count();
  const int rows = 3 * disks + 2 * packing.wall_count() + 3;
  std::vector<Eigen::Triplet<double>> entries;
  wrench_.setZero(rows);
  for (int w = 0; w < packing.wall_count(); ++w) {
    const Wall& wall = packing[WallId(w)];
    if (!std::isnan(wall.load_n)) wrench_[3 * disks + 2 * w] = wall.load_n / force_unit_;
    if (!std::isnan(wall.load_t)) wrench_[3 * disks + 2 * w + 1] = wall.load_t / force_unit_;
  }
  for (int i = 0; i < disks; ++i) {
    const Disk& disk = packing[DiskId(i)];
    if (disk.fixed) continue;
    wrench_[3 * i] = (disk.mass * packing.gravity.x() + disk.load.x()) / force_unit_;
    wrench_[3 * i + 1] = (disk.mass * packing.gravity.y() + disk.load.y()) / force_unit_;
    wrench_[3 * i + 2] = disk.load.z() / (force_unit_ * disk.radius);
  }
  for (int c = 0; c < contacts; ++c) {
    const Contact& contact = packing[ContactId(c)];
    const double nx = contact.normal.x();
    const double ny = contact.normal.y();
    const auto place = [&](DiskId id, double chi, double lever) {
      const Disk& disk = packing[id];
      if (disk.fixed) return;
      const double arm = std::isnan(lever) ? 1 : lever / disk.radius;
      const int row = 3 * id.value();
      entries.insert(entries.end(), {{row, 2 * c, chi * nx},
                                     {row, 2 * c + 1, chi * ny},
                                     {row + 1, 2 * c, chi * ny},
                                     {row + 1, 2 * c + 1, -chi * nx},
                                     {row + 2, 2 * c + 1, arm}});
    };
    place(contact.a, 1, contact.lever_a);
    if (!contact.b.is_wall()) {
      place(contact.b.disk_id(), -1, contact.lever_b);
    } else {
      const Wall& wall = packing[contact.b.wall_id()];
      const int row = 3 * disks + 2 * contact.b.wall_id().value();
      if (!std::isnan(wall.load_n)) entries.emplace_back(row, 2 * c, -1);
      if (!std::isnan(wall.load_t)) entries.emplace_back(row + 1, 2 * c + 1, -1);
    }
    if (contact.mu == 0) held_.push_back(2 * c + 1);
  }
  if (packing.stress.is_imposed()) add_stress(entries);
  matrix_.resize(rows, 2 * contacts);
  matrix_.setFromTriplets(entries.begin(), entries.end());  // a sum where a disk is at both ends
  bounds_ = force_bounds(packing);
  for (const ForceBound& bound : bounds_) {
    const bool is_equal = bound.side == ForceBound::Side::kEqual;
    (is_equal ? equalities_ : inequalities_).push_back(bound);
    if (is_equal) held_.push_back(bound.component());
  }
}

Eigen::SparseMatrix<double> RebuiltProblem::constraints() const {
  std::vector<Eigen::Triplet<double>> entries;
  const auto held = static_cast<int>(held_.size());
  for (int k = 0; k < held; ++k) entries.emplace_back(k, held_[static_cast<std::size_t>(k)], 1);
  for (Eigen::Index j = 0; j < matrix_.outerSize(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix_, j); it; ++it)
      entries.emplace_back(held + it.row(), it.col(), it.value());
  }
  Eigen::SparseMatrix<double> result(held + matrix_.rows(), matrix_.cols());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

const Eigen::MatrixXd& RebuiltProblem::kernel() const {
  if (!kernel_) kernel_ = kernel_basis(Eigen::MatrixXd(constraints()), tolerance::kRebuiltRank);
  return *kernel_;
}

std::optional<int> RebuiltProblem::nullity_by_inertia(double threshold) const {
  return indet::nullity_by_inertia(constraints(), threshold);
}

void RebuiltProblem::add_stress(std::vector<Eigen::Triplet<double>>& entries) {
  const Stress& stress = packing_.stress;
  const Vector2 a = *packing_.cell.a;
  const Vector2 b = *packing_.cell.b;
  const double area = std::abs(a.x() * b.y() - a.y() * b.x());
  double length = std::sqrt(area);
  for (const Disk& disk : packing_.disks) length = std::max(length, 2 * disk.radius);
  const bool isotropic = !std::isnan(stress.pressure);
  const auto first = static_cast<int>(wrench_.size()) - 3;
  const double imposed[3] = {isotropic ? stress.pressure : stress.xx, stress.yy, stress.xy};
  for (int k = 0; k < 3; ++k) {
    if (std::isnan(imposed[k])) continue;
    wrench_[first + k] = area * imposed[k] / (length * force_unit_);
    for (int c = 0; c < packing_.contact_count(); ++c) {
      const Contact& contact = packing_[ContactId(c)];
      const Vector2 image = contact.image[0] * a + contact.image[1] * b;
      const Vector2 l =
          (packing_[contact.a].position - packing_[contact.b.disk_id()].position - image) / length;
      const Vector2 n = contact.normal;
      const Vector2 t(n.y(), -n.x());
      const int i = k == 1 ? 1 : 0;
      const int j = k == 0 ? 0 : 1;
      entries.emplace_back(first + k, 2 * c, k == 0 && isotropic ? -n.dot(l) / 2 : -n[i] * l[j]);
      entries.emplace_back(first + k, 2 * c + 1, k == 0 && isotropic ? -t.dot(l) / 2 : -t[i] * l[j]);
    }
  }
}

double RebuiltProblem::imbalance_without_load(const Eigen::VectorXd& forces) const {
  return matrix_.rows() == 0 || matrix_.cols() == 0
             ? 0
             : Eigen::VectorXd(matrix_ * forces).lpNorm<Eigen::Infinity>();
}

double RebuiltProblem::imbalance(const Eigen::VectorXd& forces) const {
  if (!forces.allFinite()) return std::numeric_limits<double>::infinity();
  return wrench_.size() == 0 ? 0 : Eigen::VectorXd(matrix_ * forces + wrench_).lpNorm<Eigen::Infinity>();
}

double RebuiltProblem::slack(int half_plane, const Eigen::VectorXd& forces) const {
  const int first = 2 * packing_.contact_count();
  if (half_plane >= first)
    return indet::slack(inequalities_[static_cast<std::size_t>(half_plane - first)], forces, force_unit_);
  const int contact = half_plane / 2;
  const double mu = packing_[ContactId(contact)].mu;
  const double R = forces[2 * contact];
  const double T = forces[2 * contact + 1];
  if (mu == 0) return R - std::abs(T);
  return (mu * R + (half_plane % 2 == 0 ? T : -T)) / std::hypot(1.0, mu);
}

double RebuiltProblem::violation(const Eigen::VectorXd& forces) const {
  double worst = 0;
  for (int h = 0; h < half_planes(); ++h) worst = std::max(worst, -slack(h, forces));
  for (const ForceBound& bound : equalities_)
    worst = std::max(worst, -indet::slack(bound, forces, force_unit_));
  return worst;
}

double RebuiltProblem::narrowest_interval() const {
  double narrowest = std::numeric_limits<double>::infinity();
  for (const ForceBound& bound : inequalities_)
    narrowest = std::min(narrowest, std::abs(bound.value - bound.other) / force_unit_);
  return narrowest;
}

double RebuiltProblem::ray_violation(const Eigen::VectorXd& ray) const {
  double worst = 0;
  for (int h = 0; h < 2 * packing_.contact_count(); ++h) worst = std::max(worst, -slack(h, ray));
  for (ForceBound bound : bounds_) {
    bound.value = 0;
    worst = std::max(worst, -indet::slack(bound, ray));
  }
  return worst;
}

RebuiltProblem::SlidingCount RebuiltProblem::count_sliding(const Eigen::VectorXd& forces) const {
  const double epsilon = tolerance::kSliding * internal_unit_;
  SlidingCount count;
  for (int i = 0; i < packing_.contact_count(); ++i) {
    const double mu = packing_[ContactId(i)].mu;
    const double R = forces[2 * i];
    const double T = std::abs(forces[2 * i + 1]);
    const bool transmits = std::abs(R) >= epsilon || T >= epsilon;
    count.non_transmitting += transmits ? 0 : 1;
    count.sliding += transmits ? (mu > 0 && mu * R - T < epsilon ? 1 : 0) : 2;
  }
  return count;
}

RebuiltProblem::Gradient RebuiltProblem::gradient_of(int half_plane) const {
  const int first = 2 * packing_.contact_count();
  if (half_plane >= first) {
    const ForceBound& bound = inequalities_[static_cast<std::size_t>(half_plane - first)];
    const double sign = bound.side == ForceBound::Side::kLower ? 1 : -1;
    return {bound.contact.value(), bound.tangential ? Vector2(0, sign) : Vector2(sign, 0)};
  }
  const double mu = packing_[ContactId(half_plane / 2)].mu;
  if (mu == 0) return {half_plane / 2, Vector2(1, 0)};
  return {half_plane / 2, Vector2(mu, half_plane % 2 == 0 ? 1 : -1) / std::hypot(1.0, mu)};
}

Eigen::VectorXd RebuiltProblem::normal_of(int half_plane) const {
  const auto [contact, along] = gradient_of(half_plane);
  return kernel().middleRows<2>(2 * contact).transpose() * along;
}

double RebuiltProblem::optimality_gap(int component, double sign, const std::vector<int>& tight) const {
  return optimality_gap(Eigen::VectorXd::Unit(matrix_.cols(), component) * sign, tight);
}

double RebuiltProblem::optimality_gap(const Eigen::VectorXd& coefficients,
                                      const std::vector<int>& tight) const {
  const Eigen::VectorXd gradient = kernel().transpose() * coefficients;
  if (gradient.size() == 0 || gradient.norm() == 0) return 0;
  Eigen::MatrixXd normals(nullity(), static_cast<Eigen::Index>(tight.size()));
  for (std::size_t i = 0; i < tight.size(); ++i)
    normals.col(static_cast<Eigen::Index>(i)) = normal_of(tight[i]);
  if (normals.cols() == 0) return gradient.norm();
  if (normals.cols() == normals.rows()) {  // the usual case: a simple vertex
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(normals);
    const Eigen::VectorXd y = lu.solve(-gradient).cwiseMax(0);
    const double gap = (normals * y + gradient).norm();
    if (gap < tolerance::kOptimalityGap) return gap;
  }
  // Where both sides of a cone are tight, R ≥ 0 is a sum of theirs, with large weights if μ is small.
  for (std::size_t i = 1; i < tight.size(); ++i) {
    const bool is_apex = tight[i] < 2 * packing_.contact_count() && tight[i] % 2 == 1 &&
                         tight[i - 1] == tight[i] - 1 && packing_[ContactId(tight[i] / 2)].mu > 0;
    if (!is_apex) continue;
    normals.conservativeResize(Eigen::NoChange, normals.cols() + 1);
    normals.rightCols<1>() = kernel().row(tight[i] - 1).transpose();
  }
  return (normals * solve_nonnegative(normals, -gradient) + gradient).norm();
}

Eigen::VectorXd RebuiltProblem::flat_motion(const Eigen::MatrixXd& disks, const Eigen::MatrixXd& walls,
                                            const Eigen::MatrixXd& cell) const {
  Eigen::VectorXd flat = Eigen::VectorXd::Zero(matrix_.rows());
  for (Eigen::Index i = 0; i < disks.rows(); ++i) flat.segment<3>(3 * i) = disks.row(i).transpose();
  for (Eigen::Index w = 0; w < walls.rows(); ++w)
    flat.segment<2>(3 * disks.rows() + 2 * w) = walls.row(w).transpose();
  if (cell.rows() == 2) {
    const bool isotropic = !std::isnan(packing_.stress.pressure);
    flat.tail<3>() << cell(0, 0) + (isotropic ? cell(1, 1) : 0), isotropic ? 0 : cell(1, 1), cell(0, 1);
  }
  return flat;
}

double RebuiltProblem::load_power(const Eigen::VectorXd& motion) const { return wrench_.dot(motion); }

double RebuiltProblem::bounds_power(const Eigen::VectorXd& multipliers) const {
  double power = 0;
  for (std::size_t k = 0; k < bounds_.size(); ++k)
    power -= multipliers[static_cast<Eigen::Index>(k)] * bounds_[k].value / force_unit_;
  return power;
}

RebuiltProblem::Sum RebuiltProblem::load_product(const Eigen::VectorXd& y) const {
  Sum sum;
  for (Eigen::Index i = 0; i < matrix_.rows(); ++i) sum.add(-wrench_[i] * y[i]);
  for (std::size_t k = 0; k < bounds_.size(); ++k)
    sum.add(y[matrix_.rows() + static_cast<Eigen::Index>(k)] * bounds_[k].value / force_unit_);
  return sum;
}

void RebuiltProblem::for_each_edge(
    const Eigen::VectorXd& y,
    const std::function<void(int contact, double R, double T, const Sum& along)>& visit) const {
  std::vector<Sum> forces(static_cast<std::size_t>(matrix_.cols()));
  for (Eigen::Index j = 0; j < matrix_.cols(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix_, j); it; ++it)
      forces[static_cast<std::size_t>(j)].add(it.value() * y[it.row()]);
  }
  const auto multiplier = [&](std::size_t k) { return y[matrix_.rows() + static_cast<Eigen::Index>(k)]; };
  for (std::size_t k = 0; k < bounds_.size(); ++k)
    forces[static_cast<std::size_t>(bounds_[k].component())].add(multiplier(k));
  for (int c = 0; c < packing_.contact_count(); ++c) {
    const Sum& normal = forces[static_cast<std::size_t>(2 * c)];
    const Sum& tangential = forces[static_cast<std::size_t>(2 * c + 1)];
    const double mu = packing_[ContactId(c)].mu;
    const double size = normal.size + mu * tangential.size;
    visit(c, 1, mu, {normal.value + mu * tangential.value, size});
    if (mu > 0) visit(c, 1, -mu, {normal.value - mu * tangential.value, size});
  }
  for (std::size_t k = 0; k < bounds_.size(); ++k) {
    if (bounds_[k].side == ForceBound::Side::kEqual) continue;
    const double sign = bounds_[k].side == ForceBound::Side::kLower ? -1 : 1;
    visit(bounds_[k].contact.value(), 0, 0, {sign * multiplier(k), std::abs(multiplier(k))});
  }
}

double RebuiltProblem::smallest_contact_power(const Eigen::VectorXd& motion) const {
  return smallest_power(motion, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(bounds_.size())));
}

double RebuiltProblem::smallest_power(const Eigen::VectorXd& motion,
                                      const Eigen::VectorXd& multipliers) const {
  Eigen::VectorXd relative = matrix_.transpose() * motion;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < bounds_.size(); ++k) {
    const double multiplier = multipliers[static_cast<Eigen::Index>(k)];
    relative[bounds_[k].component()] += multiplier;
    if (bounds_[k].side == ForceBound::Side::kEqual) continue;
    smallest = std::min(smallest, bounds_[k].side == ForceBound::Side::kLower ? -multiplier : multiplier);
  }
  for (int c = 0; c < packing_.contact_count(); ++c) {
    const double mu = packing_[ContactId(c)].mu;
    const double tangential = mu * std::abs(relative[2 * c + 1]);
    smallest = std::min(smallest, (relative[2 * c] - tangential) / std::hypot(1.0, mu));
  }
  return smallest;
}

}  // namespace indet
