#include "libsim/polish.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "libsim/unsupported.h"

namespace indet::sim {
namespace {

/// cF + w in units of force, 0 for fixed disks; `forces` are in those units already.
Eigen::VectorXd imbalance(const Packing& packing, const Eigen::VectorXd& forces, double unit) {
  Eigen::VectorXd sum(3 * packing.disk_count());
  for (int i = 0; i < packing.disk_count(); ++i) {
    const Vector3 wrench = packing.wrench(DiskId(i)) / unit;
    sum[3 * i] = wrench.x();
    sum[3 * i + 1] = wrench.y();
    sum[3 * i + 2] = wrench.z() / packing[DiskId(i)].radius;
  }
  for (int i = 0; i < packing.contact_count(); ++i) {
    const Contact& contact = packing[ContactId(i)];
    const double R = forces[2 * i];
    const double T = forces[2 * i + 1];
    const double x = R * contact.normal.x() + T * contact.normal.y();
    const double y = R * contact.normal.y() - T * contact.normal.x();
    const auto add = [&](DiskId disk, double side, double lever) {
      sum.segment<3>(3 * disk.value()) +=
          Eigen::Vector3d(side * x, side * y, T * (lever / packing[disk].radius));
    };
    if (packing.has_equations(contact.a)) add(contact.a, 1, packing.lever_a(contact));
    if (packing.is_free_disk(contact.b)) add(contact.b.disk_id(), -1, packing.lever_b(contact));
  }
  return sum;
}

/// The state that the raw force is in.
ContactStatus status_of(double R, double T, double mu, const PolishOptions& options) {
  if (!(R > options.transmitting)) return ContactStatus::kOpen;
  if (mu * R - std::abs(T) > options.sliding * std::max(R, 1.0)) return ContactStatus::kSticking;
  return T >= 0 ? ContactStatus::kSlidingUp : ContactStatus::kSlidingDown;
}

/// The raw force, moved onto what its state allows.
void project(ContactStatus status, double mu, double& R, double& T) {
  if (status == ContactStatus::kOpen) {
    R = 0;
    T = 0;
  } else if (status != ContactStatus::kSticking) {
    T = status == ContactStatus::kSlidingUp ? mu * R : -mu * R;
  }
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

Polisher::Polisher(const Packing& packing, const PolishOptions& options)
    : packing_(packing), options_(options), units_(packing.force_units()), solver_(packing) {
  refuse_unsupported(packing, "the polish");
}

Polisher::Attempt Polisher::attempt(std::vector<ContactStatus> statuses) {
  const int contacts = packing_.contact_count();
  Attempt run;
  run.statuses = std::move(statuses);
  const auto project_all = [&] {
    for (int i = 0; i < contacts; ++i) {
      project(run.statuses[i], packing_[ContactId(i)].mu, run.forces[2 * i], run.forces[2 * i + 1]);
    }
  };
  while (!run.settled && run.rounds < options_.max_rounds) {
    ++run.rounds;
    run.forces = raw_;
    project_all();
    if (!solver_.factorise(run.statuses)) break;
    solver_.apply(run.forces);
    run.settled = true;
    for (int i = 0; i < contacts; ++i) {
      ContactStatus& status = run.statuses[i];
      if (status == ContactStatus::kOpen) continue;
      const double R = run.forces[2 * i];
      const double T = run.forces[2 * i + 1];
      if (!(R > options_.transmitting)) {
        status = ContactStatus::kOpen;
        run.settled = false;
      } else if (status == ContactStatus::kSticking && std::abs(T) > packing_[ContactId(i)].mu * R) {
        status = T > 0 ? ContactStatus::kSlidingUp : ContactStatus::kSlidingDown;
        run.settled = false;
      }
    }
  }
  project_all();  // Rounding leaves sliding contacts an ulp off their limit.
  run.residual = solver_.residual(run.forces);
  return run;
}

double Polisher::least_distance(const Eigen::VectorXd& raw) {
  raw_ = raw / units_.internal_in_scene();
  const std::vector<ContactStatus> statuses(packing_.contact_count(), ContactStatus::kSticking);
  if (!solver_.factorise(statuses)) return 0;
  return units_.weights(InternalForce(solver_.least_change(raw_))).value();
}

Polished Polisher::polish(const Eigen::VectorXd& raw) {
  const int contacts = packing_.contact_count();
  const double unit = units_.internal_in_scene();
  raw_ = raw / unit;
  std::vector<ContactStatus> sliding(contacts);
  std::vector<ContactStatus> sticking(contacts);
  for (int i = 0; i < contacts; ++i) {
    sliding[i] = status_of(raw_[2 * i], raw_[2 * i + 1], packing_[ContactId(i)].mu, options_);
    sticking[i] = sliding[i] == ContactStatus::kOpen ? ContactStatus::kOpen : ContactStatus::kSticking;
  }
  Attempt run = attempt(sliding);
  Polished result;
  if (!run.settled || !(run.residual <= options_.residual)) {
    // More sliding contacts than the balance allows: let those stick that must.
    Attempt second = attempt(sticking);
    if (second.settled && second.residual <= options_.residual) {
      result.sliding_kept = false;
      run = std::move(second);
    }
  }
  for (const ContactStatus status : run.statuses) {
    result.opened += status == ContactStatus::kOpen ? 1 : 0;
    result.sliding += status == ContactStatus::kSlidingUp || status == ContactStatus::kSlidingDown ? 1 : 0;
  }
  result.rounds = run.rounds;
  result.forces = unit * run.forces;
  for (int i = 0; i < contacts; ++i) {
    // Rounding of the product must not push a sliding contact out of its cone.
    project(run.statuses[i], packing_[ContactId(i)].mu, result.forces[2 * i], result.forces[2 * i + 1]);
  }
  result.residual = balance_residual(packing_, result.forces);
  result.cone_violation = cone_violation(packing_, result.forces);
  result.distance = units_.weights(InternalForce((run.forces - raw_).norm())).value();
  if (!run.settled) {
    result.reason =
        fmt::format("which contacts slide and which are open was not settled in {} rounds", run.rounds);
  } else if (!(result.residual <= options_.residual * units_.internal_in_weights())) {
    result.reason = fmt::format("the contacts cannot balance the disks: {:.2e} mg remain", result.residual);
  } else {
    result.balanced = true;
  }
  return result;
}

Polished polish(const Packing& packing, const Eigen::VectorXd& raw, const PolishOptions& options) {
  return Polisher(packing, options).polish(raw);
}

}  // namespace indet::sim
