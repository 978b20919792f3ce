#include "libsim/balance_solver.h"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "libindet/base/tolerances.h"

namespace indet::sim {
namespace {

/// Place of each disk in an order of elimination that fills in few entries.
std::vector<int> elimination_places(const Packing& packing) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < packing.disk_count(); ++i) entries.emplace_back(i, i, 1);
  for (const Contact& contact : packing.contacts) {
    if (contact.b.is_wall()) continue;
    entries.emplace_back(contact.a.value(), contact.b.disk_id().value(), 1);
    entries.emplace_back(contact.b.disk_id().value(), contact.a.value(), 1);
  }
  Eigen::SparseMatrix<double> graph(packing.disk_count(), packing.disk_count());
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(graph, order);
  std::vector<int> places(static_cast<std::size_t>(packing.disk_count()));
  for (int place = 0; place < packing.disk_count(); ++place) places[order.indices()[place]] = place;
  return places;
}

}  // namespace

BalanceSolver::Direction BalanceSolver::Link::direction(double R, double T) const {
  return {
      .R = R, .T = T, .x = R * nx + T * ny, .y = R * ny - T * nx, .turn_a = arm_a * T, .turn_b = arm_b * T};
}

BalanceSolver::BalanceSolver(const Packing& packing) {
  const int disks = packing.disk_count();
  const double unit = packing.internal_force_unit();
  const std::vector<int> places = elimination_places(packing);
  load_.resize(3 * disks);
  for (int i = 0; i < disks; ++i) {
    const Vector3 wrench = packing.wrench(DiskId(i)) / unit;
    load_.segment<3>(3 * places[i]) << wrench.x(), wrench.y(), wrench.z() / packing[DiskId(i)].radius;
  }
  for (const Contact& contact : packing.contacts) {
    Link link{.nx = contact.normal.x(), .ny = contact.normal.y(), .mu = contact.mu};
    if (packing.has_equations(contact.a)) {
      link.row_a = 3 * places[contact.a.value()];
      link.arm_a = packing.lever_a(contact) / packing[contact.a].radius;
    }
    if (packing.has_equations(contact.b)) {
      link.row_b = 3 * places[contact.b.disk_id().value()];
      link.arm_b = packing.lever_b(contact) / packing[contact.b.disk_id()].radius;
    }
    links_.push_back(link);
  }
  lay_out(disks);
  cholesky_.analyzePattern(normal_);
}

void BalanceSolver::lay_out(int disks) {
  // Blocks of 3 × 3, by columns, the block of a body with itself last; of that the upper triangle.
  std::vector<std::set<int>> above(static_cast<std::size_t>(disks));
  for (const Link& link : links_) {
    if (!link.joins_two_rows()) continue;
    const auto [low, high] = std::minmax(link.row_a, link.row_b);
    above[high / 3].insert(low);
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (int body = 0; body < disks; ++body) {
    for (int column = 3 * body; column < 3 * body + 3; ++column) {
      for (const int first : above[body]) {
        for (int row = first; row < first + 3; ++row) entries.emplace_back(row, column, 0);
      }
      for (int row = 3 * body; row <= column; ++row) entries.emplace_back(row, column, 0);
    }
  }
  normal_.resize(3 * disks, 3 * disks);
  normal_.setFromTriplets(entries.begin(), entries.end());

  const auto columns = [&](int block_column, int blocks_before) {
    std::array<int, 3> starts{};
    for (int k = 0; k < 3; ++k) starts[k] = normal_.outerIndexPtr()[3 * block_column + k] + 3 * blocks_before;
    return starts;
  };
  for (int body = 0; body < disks; ++body) {
    diagonal_.push_back(columns(body, static_cast<int>(above[body].size())));
  }
  for (Link& link : links_) {
    if (!link.joins_two_rows()) continue;
    const auto [low, high] = std::minmax(link.row_a, link.row_b);
    const std::set<int>& blocks = above[high / 3];
    link.columns = columns(high / 3, static_cast<int>(std::distance(blocks.begin(), blocks.find(low))));
  }
}

void BalanceSolver::add(const Link& link, const Direction& direction) {
  double* values = normal_.valuePtr();
  const std::array<double, 3> on_a{direction.x, direction.y, direction.turn_a};
  const std::array<double, 3> on_b{-direction.x, -direction.y, direction.turn_b};
  const auto add_to_diagonal = [&](int row, const std::array<double, 3>& on) {
    const std::array<int, 3>& starts = diagonal_[row / 3];
    for (int column = 0; column < 3; ++column) {
      for (int k = 0; k <= column; ++k) values[starts[column] + k] += on[k] * on[column];
    }
  };
  if (link.row_a >= 0) add_to_diagonal(link.row_a, on_a);
  if (link.row_b >= 0) add_to_diagonal(link.row_b, on_b);
  if (!link.joins_two_rows()) return;
  const auto& [upper, right] = link.row_a < link.row_b ? std::pair(on_a, on_b) : std::pair(on_b, on_a);
  for (int column = 0; column < 3; ++column) {
    for (int k = 0; k < 3; ++k) values[link.columns[column] + k] += upper[k] * right[column];
  }
}

bool BalanceSolver::factorise(const std::vector<ContactStatus>& statuses) {
  if (usable_ && statuses == factorised_) return true;
  factorised_ = statuses;
  std::fill_n(normal_.valuePtr(), normal_.nonZeros(), 0.0);
  // Rows that the contacts cannot balance make A Aᵀ singular; the shift is undone by the refinement.
  for (const std::array<int, 3>& starts : diagonal_) {
    for (int k = 0; k < 3; ++k) normal_.valuePtr()[starts[k] + k] = tolerance::kNormalShift;
  }
  for (std::size_t i = 0; i < links_.size(); ++i) {
    Link& link = links_[i];
    link.free = 0;
    if (statuses[i] == ContactStatus::kSticking) {
      link.directions = {link.direction(1, 0), link.direction(0, 1)};
      link.free = 2;
    } else if (statuses[i] != ContactStatus::kOpen) {
      const double T = statuses[i] == ContactStatus::kSlidingUp ? link.mu : -link.mu;
      const double length = std::sqrt(1 + T * T);
      link.directions[0] = link.direction(1 / length, T / length);
      link.free = 1;
    }
    for (int k = 0; k < link.free; ++k) add(link, link.directions[k]);
  }
  cholesky_.factorize(normal_);
  usable_ = cholesky_.info() == Eigen::Success;
  return usable_;
}

double BalanceSolver::residual(const Eigen::VectorXd& forces) {
  imbalance_ = load_;
  double* sum = imbalance_.data();
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    const double R = forces[2 * static_cast<Eigen::Index>(i)];
    const double T = forces[2 * static_cast<Eigen::Index>(i) + 1];
    const double x = R * link.nx + T * link.ny;
    const double y = R * link.ny - T * link.nx;
    if (link.row_a >= 0) {
      sum[link.row_a] += x;
      sum[link.row_a + 1] += y;
      sum[link.row_a + 2] += link.arm_a * T;
    }
    if (link.row_b < 0) continue;
    sum[link.row_b] -= x;
    sum[link.row_b + 1] -= y;
    sum[link.row_b + 2] += link.arm_b * T;
  }
  return imbalance_.size() == 0 ? 0 : imbalance_.lpNorm<Eigen::Infinity>();
}

double BalanceSolver::least_change(const Eigen::VectorXd& forces) {
  residual(forces);
  solution_ = cholesky_.solve(imbalance_);
  // ‖Aᵀ y‖² with (A Aᵀ + shift) y = cF + w.
  return std::sqrt(
      std::max(0.0, solution_.dot(imbalance_) - tolerance::kNormalShift * solution_.squaredNorm()));
}

void BalanceSolver::apply(Eigen::VectorXd& forces) {
  constexpr int kRefinements = 12;
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kRefinements; ++i) {
    const double size = residual(forces);
    if (!(size < 0.5 * best)) break;
    best = size;
    solution_ = cholesky_.solve(imbalance_);
    const double* x = solution_.data();
    for (std::size_t c = 0; c < links_.size(); ++c) {
      const Link& link = links_[c];
      for (int k = 0; k < link.free; ++k) {
        const Direction& d = link.directions[k];
        double change = 0;
        if (link.row_a >= 0)
          change = d.x * x[link.row_a] + d.y * x[link.row_a + 1] + d.turn_a * x[link.row_a + 2];
        if (link.row_b >= 0)
          change += -d.x * x[link.row_b] - d.y * x[link.row_b + 1] + d.turn_b * x[link.row_b + 2];
        forces[2 * static_cast<Eigen::Index>(c)] -= change * d.R;
        forces[2 * static_cast<Eigen::Index>(c) + 1] -= change * d.T;
      }
    }
  }
}

}  // namespace indet::sim
