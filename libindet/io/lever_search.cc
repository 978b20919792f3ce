#include "libindet/io/lever_search.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "libindet/base/tolerances.h"

namespace indet {
namespace {

/// Torques over radii (mg) on the disks: of the loads and of all T with arm r, and what arms r − δ/2 add at
/// pairs and at walls.
struct Torques {
  Eigen::ArrayXd base, pairs, walls;

  explicit Torques(const Packing& packing)
      : base(Eigen::ArrayXd::Zero(packing.disk_count())), pairs(base), walls(base) {
    const double unit = packing.force_unit();
    for (int i = 0; i < packing.disk_count(); ++i) {
      base[i] = packing.wrench(DiskId(i)).z() / packing[DiskId(i)].radius / unit;
    }
    for (const Contact& contact : packing.contacts) {
      const double tangential = contact.T / unit;
      const bool at_wall = contact.b.is_wall();
      add(packing, contact.a, tangential, contact.gap, at_wall);
      if (!at_wall) add(packing, contact.b.disk_id(), tangential, contact.gap, false);
    }
  }

  double residual(const Levers& levers) const {
    Eigen::ArrayXd torques = base;
    if (levers.pair == Lever::kMidOverlap) torques += pairs;
    if (levers.wall == Lever::kMidOverlap) torques += walls;
    return torques.size() == 0 ? 0 : torques.abs().maxCoeff();
  }

 private:
  void add(const Packing& packing, DiskId disk, double tangential, double gap, bool at_wall) {
    if (packing[disk].fixed) return;
    base[disk.value()] += tangential;
    (at_wall ? walls : pairs)[disk.value()] += tangential * 0.5 * gap / packing[disk].radius;
  }
};

const LeverTrial* find_trial(const std::vector<LeverTrial>& trials, const Levers& levers) {
  const auto found =
      std::find_if(trials.begin(), trials.end(), [&](const LeverTrial& t) { return t.levers == levers; });
  return found == trials.end() ? nullptr : &*found;
}

/// `documented`, but for what the user says.
Levers allowed(const LeverRule& rule, const Levers& documented) {
  return {rule.pair.value_or(documented.pair), rule.wall.value_or(documented.wall)};
}

void set_levers(Packing& packing, const Levers& levers) {
  for (Contact& contact : packing.contacts) {
    if ((contact.b.is_wall() ? levers.wall : levers.pair) == Lever::kRadius) continue;
    contact.lever_a = packing[contact.a].radius + 0.5 * contact.gap;
    if (!contact.b.is_wall()) contact.lever_b = packing[contact.b.disk_id()].radius + 0.5 * contact.gap;
  }
}

}  // namespace

void choose_levers(ImportedPacking& imported, const LeverRule& rule, const Levers& documented,
                   double tolerance) {
  Packing& packing = imported.packing;
  for (const Contact& contact : packing.contacts) {
    if (!std::isnan(contact.lever_a) || !std::isnan(contact.lever_b)) return;
  }
  LeverChoice choice;
  choice.levers = allowed(rule, documented);
  if (packing.has_simulated_forces()) {
    const Torques torques(packing);
    for (const Lever pair : {Lever::kRadius, Lever::kMidOverlap}) {
      for (const Lever wall : {Lever::kRadius, Lever::kMidOverlap}) {
        const Levers levers{pair, wall};
        if (rule.allows(levers)) choice.trials.push_back({levers, torques.residual(levers)});
      }
    }
    const auto best = std::min_element(
        choice.trials.begin(), choice.trials.end(),
        [](const LeverTrial& left, const LeverTrial& right) { return left.residual < right.residual; });
    const double usual = find_trial(choice.trials, choice.levers)->residual;
    if (best->residual > tolerance) {
      choice.reason = LeverChoice::Reason::kNone;
    } else if (usual <= std::max(tolerance::kAlikeLevers, 10 * best->residual)) {
      choice.reason = LeverChoice::Reason::kDocumented;
    } else {
      choice.levers = best->levers;
      choice.reason = LeverChoice::Reason::kBest;
    }
  }
  if (rule.pair && rule.wall) choice.reason = LeverChoice::Reason::kGiven;
  set_levers(packing, choice.levers);
  imported.levers = choice;
}

}  // namespace indet
