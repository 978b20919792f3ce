#pragma once

#include <limits>

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet::test {

/// Three disks in a heap on a floor, beside a wall: N = 3, W = 2, M = 5. Every number differs from its
/// neighbours, so that a transposed or shifted table shows. (h5py_test.py knows them too.)
///
///      |   2
///      |  / \          .
///      | 0   1
///      +--------
inline Packing sample_packing() {
  Packing packing;
  packing.gravity = {0, -2};
  packing.origin = {"import csv", 17, "[import]\nformat = \"csv\"\n"};
  packing.walls = {Wall{.id = 4, .point = {0.5, 0}, .normal = {0, 1}, .name = "floor"},
                   Wall{.id = 9, .point = {-1, 3}, .normal = {1, 0}, .name = "links ∥"}};
  for (int i = 0; i < 3; ++i) {
    packing.disks.push_back(Disk{.id = 10 + i,
                                 .position = i < 2 ? Vector2(2.5 * i, 1) : Vector2(1.25, 2.5612494995995996),
                                 .radius = 1,
                                 .mass = 1.0 + i,
                                 .inertia = 0.5 + i,
                                 .angle = 0.1 * i,
                                 .velocity = {0.01 * i, 0.02 * i},
                                 .angular_velocity = 0.03 * i,
                                 .load = {0.1 + i, 0.2 + i, 0.3 + i}});
  }
  const auto touch = [&](int a, Body b, double mu) {
    Contact contact{.a = DiskId(a), .b = b, .mu = mu};
    contact.normal = geometric_normal(packing, contact.a, b);
    contact.gap = geometric_gap(packing, contact.a, b);
    contact.R = 10.0 + packing.contact_count();
    contact.T = -1.0 - packing.contact_count();
    packing.contacts.push_back(contact);
  };
  touch(0, Body::wall(WallId(0)), 0.5);
  touch(1, Body::wall(WallId(0)), 0.25);
  touch(0, Body::wall(WallId(1)), 0.125);
  touch(2, Body::disk(DiskId(0)), 0);
  touch(2, Body::disk(DiskId(1)), 1);
  packing.contacts[4].T = std::numeric_limits<double>::quiet_NaN();
  return packing;
}

/// Smallest distances of the packing above, of numbers that mean nothing.
inline SmallestDistances sample_distances() {
  SmallestDistances smallest;
  smallest.d_R = Eigen::VectorXd::LinSpaced(5, 1, 5);
  smallest.d_T = Eigen::VectorXd::LinSpaced(5, 11, 15);
  for (auto* table : {&smallest.lower, &smallest.shortage}) table->resize(5, 2);
  for (int i = 0; i < 5; ++i) {
    smallest.lower.row(i) << 0.5 + i, 10.5 + i;
    smallest.shortage.row(i) << 1e-9 * i, 2e-9 * i;
  }
  smallest.outcome.setConstant(5, 2, Outcome::kEnclosed);
  smallest.outcome(3, 1) = Outcome::kImprecise;
  return smallest;
}

/// Reactions of the packing above, of numbers that mean nothing: P = 4 sums, S = 3 states, U = 1 ray.
/// Of 2 of the 5 contacts of 3 disks and 2 walls.
inline Duals sample_duals() {
  Duals duals;
  duals.seed = 5;
  duals.contacts.resize(2);
  duals.contacts << 1, 4;
  duals.multipliers.setConstant(8, 16, 0.5);
  duals.points.setConstant(8, 10, 1.5);
  duals.bounding.setConstant(16, 2);
  return duals;
}

inline Reactions sample_reactions() {
  Reactions r;
  r.body.resize(4);
  r.component.resize(4);
  r.outcome.setConstant(4, 2, Outcome::kOptimal);
  for (auto* table : {&r.value, &r.lower, &r.upper}) table->resize(4, 2);
  for (auto* table : {&r.vertex, &r.ray}) table->setConstant(4, 2, -1);
  for (int k = 0; k < 4; ++k) {
    r.body[k] = -1 - k / 2;
    r.component[k] = k % 2;
    for (int end = 0; end < 2; ++end) {
      r.value(k, end) = 20 + 10 * k + end;
      r.lower(k, end) = 20 + 10 * k + end - 0.25;
      r.upper(k, end) = 20 + 10 * k + end + 0.25;
      r.vertex(k, end) = (k + end) % 3;
    }
  }
  r.outcome(3, 1) = Outcome::kUnbounded;
  r.vertex(3, 1) = -1;
  r.ray(3, 1) = 0;
  r.states.resize(3, 10);
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 10; ++j) r.states(k, j) = 100 * k + j + 0.5;
  }
  r.rays = Eigen::RowVectorXd::LinSpaced(10, 0, 9);
  return r;
}

/// Ranges of the packing above with K = 7 states and dim F = 3. The numbers mean nothing; each is a different
/// function of its row and column.
inline ForceRanges sample_ranges() {
  constexpr int kContacts = 5;
  constexpr int kStates = 7;
  ForceRanges ranges;
  ranges.status = PolytopeStatus::kUnbounded;
  ranges.unknowns = 9;
  ranges.equations = 8;
  ranges.rank = 6;
  ranges.nullity = 4;
  ranges.dim = 3;
  ranges.blocks = 2;
  ranges.rank_gap = 1e12;
  ranges.smallest_accepted = 0.25;
  ranges.largest_rejected = 1e-16;
  ranges.rank_ambiguous = true;
  ranges.doubtful = true;
  ranges.residual = 1e-14;
  ranges.force_unit = 4;
  ranges.sliding = 1;
  ranges.non_transmitting = 0;
  ranges.value.resize(kContacts, 4);
  ranges.lower.resize(kContacts, 4);
  ranges.upper.resize(kContacts, 4);
  ranges.primal_residual.resize(kContacts, 4);
  ranges.dual_residual.resize(kContacts, 4);
  ranges.sensitivity.clear(kContacts);
  ranges.outcome.resize(kContacts, 4);
  ranges.unique.resize(kContacts, 4);
  ranges.vertex.resize(kContacts, 4);
  for (auto* column :
       {&ranges.delta_R, &ranges.delta_T, &ranges.d_R, &ranges.d_T, &ranges.R_star, &ranges.T_star}) {
    column->resize(kContacts);
  }
  for (int i = 0; i < kContacts; ++i) {
    for (int j = 0; j < 4; ++j) {
      ranges.value(i, j) = 100 + 10 * i + j;
      ranges.lower(i, j) = 200 + 10 * i + j;
      ranges.upper(i, j) = 300 + 10 * i + j;
      ranges.primal_residual(i, j) = 1e-15 * (10 * i + j);
      ranges.dual_residual(i, j) = -1e-16 * (10 * i + j);
      ranges.sensitivity.value(i, j) = 0.5 * (10 * i + j);
      ranges.sensitivity.claim(i, j) = static_cast<std::uint8_t>((i + j) % 3);
      ranges.outcome(i, j) = static_cast<Outcome>((i + j) % 5);
      ranges.unique(i, j) = static_cast<std::uint8_t>((i * j) % 2);
      ranges.vertex(i, j) = (4 * i + j) % (kStates + 1) - 1;
    }
    ranges.delta_R[i] = 1.5 * i;
    ranges.delta_T[i] = 2.5 * i;
    ranges.d_R[i] = 3.5 * i;
    ranges.d_T[i] = 4.5 * i;
    ranges.R_star[i] = 0.125 * i;
    ranges.T_star[i] = -0.125 * i;
  }
  ranges.value(2, kMaxR) = std::numeric_limits<double>::infinity();
  ranges.value(3, kMinT) = std::numeric_limits<double>::quiet_NaN();
  ranges.states.resize(kStates, 2 * kContacts);
  ranges.norm.resize(kStates);
  ranges.active.resize(kStates, 3);
  for (int k = 0; k < kStates; ++k) {
    for (int j = 0; j < 2 * kContacts; ++j) ranges.states(k, j) = 1000 * k + j + 0.5;
    ranges.norm[k] = 7.0 - k;
    for (int j = 0; j < 3; ++j) ranges.active(k, j) = k + j;
  }
  ranges.requested = kContacts;
  ranges.largest_norm = 6;
  ranges.rays = Eigen::RowVectorXd::LinSpaced(2 * kContacts, 0, 9);
  ranges.ray.setConstant(kContacts, 4, -1);
  ranges.ray(2, kMaxR) = 0;
  ranges.formulation = "edge";
  ranges.objectives = 20;
  ranges.solves = 11;
  ranges.pivots = 57;
  ranges.determined = 2;
  ranges.certified = 12;
  ranges.imprecise = 3;
  ranges.failed = 1;
  ranges.unbounded = 4;
  ranges.worst_primal_residual = 4.3e-14;
  ranges.worst_dual_residual = 2.5e-15;
  ranges.reactions = sample_reactions();
  ranges.seconds = {{"rank", 0.25}, {"ranges", 1.5}};
  return ranges;
}

}  // namespace indet::test
