#include "libsim/polish.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace indet::sim {
namespace {

enum class Status { kSticking, kSlidingUp, kSlidingDown, kOpen };

using Sparse = Eigen::SparseMatrix<double>;

/// The rows of one contact's force (R, T) on its bodies: force x, y and torque/r.
struct Columns {
  int row_a = 0;
  int row_b = -1;  ///< −1: a wall.
  double nx = 0, ny = 0;
};

Columns columns_of(const Contact& contact) {
  return {.row_a = 3 * contact.a.value(),
          .row_b = contact.b.is_wall() ? -1 : 3 * contact.b.disk_id().value(),
          .nx = contact.normal.x(),
          .ny = contact.normal.y()};
}

/// Adds the column of a unit force with components (R, T) to the matrix.
void add_column(const Columns& c, int column, double R, double T,
                std::vector<Eigen::Triplet<double>>& entries) {
  const double x = R * c.nx + T * c.ny;
  const double y = R * c.ny - T * c.nx;
  for (const auto& [row, sign] : {std::pair(c.row_a, 1.0), std::pair(c.row_b, -1.0)}) {
    if (row < 0) continue;
    entries.emplace_back(row, column, sign * x);
    entries.emplace_back(row + 1, column, sign * y);
    if (T != 0) entries.emplace_back(row + 2, column, T);
  }
}

/// cF + w in units of force; `forces` are in those units already.
Eigen::VectorXd imbalance(const Packing& packing, const Eigen::VectorXd& forces, double unit) {
  Eigen::VectorXd sum(3 * packing.disk_count());
  for (int i = 0; i < packing.disk_count(); ++i) {
    const Vector3 wrench = packing.wrench(DiskId(i)) / unit;
    sum[3 * i] = wrench.x();
    sum[3 * i + 1] = wrench.y();
    sum[3 * i + 2] = wrench.z() / packing[DiskId(i)].radius;
  }
  for (int i = 0; i < packing.contact_count(); ++i) {
    const Columns c = columns_of(packing[ContactId(i)]);
    const double R = forces[2 * i];
    const double T = forces[2 * i + 1];
    const double x = R * c.nx + T * c.ny;
    const double y = R * c.ny - T * c.nx;
    sum[c.row_a] += x;
    sum[c.row_a + 1] += y;
    sum[c.row_a + 2] += T;
    if (c.row_b < 0) continue;
    sum[c.row_b] -= x;
    sum[c.row_b + 1] -= y;
    sum[c.row_b + 2] += T;
  }
  return sum;
}

/// A x = b with A's columns the unit force directions that the contacts' states leave free; x, the change of
/// the forces along them, of least norm.
class LeastChange {
 public:
  LeastChange(const Packing& packing, const std::vector<Status>& status) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < packing.contact_count(); ++i) {
      if (status[i] == Status::kOpen) continue;
      const Contact& contact = packing[ContactId(i)];
      const Columns c = columns_of(contact);
      if (status[i] == Status::kSticking) {
        add(c, i, 1, 0, entries);
        add(c, i, 0, 1, entries);
        continue;
      }
      const double T = status[i] == Status::kSlidingUp ? contact.mu : -contact.mu;
      const double length = std::sqrt(1 + T * T);
      add(c, i, 1 / length, T / length, entries);
    }
    matrix_.resize(3 * packing.disk_count(), static_cast<int>(directions_.size()));
    matrix_.setFromTriplets(entries.begin(), entries.end());
    // Rows that the contacts cannot balance make A Aᵀ singular; the shift is undone by the refinement.
    Sparse normal = matrix_ * Sparse(matrix_.transpose());
    Sparse shift(normal.rows(), normal.cols());
    shift.setIdentity();
    normal += tolerance::kNormalShift * shift;
    cholesky_.compute(normal);
  }

  bool usable() const { return cholesky_.info() == Eigen::Success; }

  /// Adds the least change to `forces` (dimensionless) that balances them; `residual()` must return cF + w.
  template <class Residual>
  void apply(Eigen::VectorXd& forces, const Residual& residual) const {
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kRefinements; ++i) {
      const Eigen::VectorXd out_of_balance = residual(forces);
      const double size = out_of_balance.lpNorm<Eigen::Infinity>();
      if (!(size < 0.5 * best)) break;
      best = size;
      const Eigen::VectorXd change = matrix_.transpose() * cholesky_.solve(out_of_balance);
      for (std::size_t k = 0; k < directions_.size(); ++k) {
        forces[2 * directions_[k].contact] -= change[static_cast<int>(k)] * directions_[k].R;
        forces[2 * directions_[k].contact + 1] -= change[static_cast<int>(k)] * directions_[k].T;
      }
    }
  }

 private:
  static constexpr int kRefinements = 12;

  struct Direction {
    int contact;
    double R, T;
  };

  void add(const Columns& c, int contact, double R, double T, std::vector<Eigen::Triplet<double>>& entries) {
    add_column(c, static_cast<int>(directions_.size()), R, T, entries);
    directions_.push_back({contact, R, T});
  }

  std::vector<Direction> directions_;
  Sparse matrix_;
  Eigen::SimplicialLDLT<Sparse> cholesky_;
};

/// The state that the raw force is in.
Status status_of(double R, double T, double mu, const PolishOptions& options) {
  if (!(R > options.transmitting)) return Status::kOpen;
  if (mu * R - std::abs(T) > options.sliding * std::max(R, 1.0)) return Status::kSticking;
  return T >= 0 ? Status::kSlidingUp : Status::kSlidingDown;
}

/// The raw force, moved onto what its state allows.
void project(Status status, double mu, double& R, double& T) {
  if (status == Status::kOpen) {
    R = 0;
    T = 0;
  } else if (status != Status::kSticking) {
    T = status == Status::kSlidingUp ? mu * R : -mu * R;
  }
}

/// One run of the active set from the given states.
struct Attempt {
  std::vector<Status> status;
  Eigen::VectorXd forces;  ///< Dimensionless.
  int rounds = 0;
  bool settled = false;
  double residual = 0;
};

Attempt attempt(const Packing& packing, const Eigen::VectorXd& raw, std::vector<Status> status,
                const PolishOptions& options) {
  const double unit = packing.internal_force_unit();
  const int contacts = packing.contact_count();
  const auto residual = [&](const Eigen::VectorXd& forces) { return imbalance(packing, forces, unit); };
  Attempt run;
  run.status = std::move(status);
  while (!run.settled && run.rounds < options.max_rounds) {
    ++run.rounds;
    run.forces = raw;
    for (int i = 0; i < contacts; ++i) {
      project(run.status[i], packing[ContactId(i)].mu, run.forces[2 * i], run.forces[2 * i + 1]);
    }
    const LeastChange solver(packing, run.status);
    if (!solver.usable()) break;
    solver.apply(run.forces, residual);
    run.settled = true;
    for (int i = 0; i < contacts; ++i) {
      Status& state = run.status[i];
      if (state == Status::kOpen) continue;
      const double R = run.forces[2 * i];
      const double T = run.forces[2 * i + 1];
      if (!(R > options.transmitting)) {
        state = Status::kOpen;
        run.settled = false;
      } else if (state == Status::kSticking && std::abs(T) > packing[ContactId(i)].mu * R) {
        state = T > 0 ? Status::kSlidingUp : Status::kSlidingDown;
        run.settled = false;
      }
    }
  }
  for (int i = 0; i < contacts; ++i) {
    // Rounding leaves sliding contacts an ulp off their limit.
    project(run.status[i], packing[ContactId(i)].mu, run.forces[2 * i], run.forces[2 * i + 1]);
  }
  run.residual = contacts == 0 && packing.disks.empty() ? 0 : residual(run.forces).lpNorm<Eigen::Infinity>();
  return run;
}

}  // namespace

double balance_residual(const Packing& packing, const Eigen::VectorXd& forces) {
  if (packing.disks.empty()) return 0;
  const double unit = packing.force_unit();
  return imbalance(packing, forces / unit, unit).lpNorm<Eigen::Infinity>();
}

double cone_violation(const Packing& packing, const Eigen::VectorXd& forces) {
  double worst = 0;
  for (int i = 0; i < packing.contact_count(); ++i) {
    const double R = forces[2 * i];
    const double T = forces[2 * i + 1];
    worst = std::max({worst, -R, std::abs(T) - packing[ContactId(i)].mu * R});
  }
  return worst / packing.force_unit();
}

Polished polish(const Packing& packing, const Eigen::VectorXd& raw, const PolishOptions& options) {
  const ForceUnits units = packing.force_units();
  const double unit = units.internal_in_scene();
  const int contacts = packing.contact_count();
  const Eigen::VectorXd scaled = raw / unit;
  std::vector<Status> sliding(contacts);
  std::vector<Status> sticking(contacts);
  for (int i = 0; i < contacts; ++i) {
    sliding[i] = status_of(scaled[2 * i], scaled[2 * i + 1], packing[ContactId(i)].mu, options);
    sticking[i] = sliding[i] == Status::kOpen ? Status::kOpen : Status::kSticking;
  }
  Attempt run = attempt(packing, scaled, sliding, options);
  Polished result;
  if (!run.settled || !(run.residual <= options.residual)) {
    // More sliding contacts than the balance allows: let those stick that must.
    Attempt second = attempt(packing, scaled, sticking, options);
    if (second.settled && second.residual <= options.residual) {
      result.sliding_kept = false;
      run = std::move(second);
    }
  }
  for (const Status state : run.status) {
    result.opened += state == Status::kOpen ? 1 : 0;
    result.sliding += state == Status::kSlidingUp || state == Status::kSlidingDown ? 1 : 0;
  }
  result.rounds = run.rounds;
  result.forces = unit * run.forces;
  for (int i = 0; i < contacts; ++i) {
    // Rounding of the product must not push a sliding contact out of its cone.
    project(run.status[i], packing[ContactId(i)].mu, result.forces[2 * i], result.forces[2 * i + 1]);
  }
  result.residual = balance_residual(packing, result.forces);
  result.cone_violation = cone_violation(packing, result.forces);
  result.distance = units.weights(InternalForce((run.forces - scaled).norm())).value();
  if (!run.settled) {
    result.reason =
        fmt::format("which contacts slide and which are open was not settled in {} rounds", run.rounds);
  } else if (!(result.residual <= options.residual * units.internal_in_weights())) {
    result.reason = fmt::format("the contacts cannot balance the disks: {:.2e} mg remain", result.residual);
  } else {
    result.balanced = true;
  }
  return result;
}

}  // namespace indet::sim
