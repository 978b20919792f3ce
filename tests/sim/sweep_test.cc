#include "libsim/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "libindet/base/random.h"

namespace indet::sim {
namespace {

constexpr int kBodies = 40;

struct Scene {
  std::vector<ContactGroup> groups;
  std::vector<VelocityRow> rows;
};

Scene random_scene(std::uint64_t seed, SweepParts parts) {
  Random random(seed, 0);
  Scene scene;
  for (int i = 0; i < kBodies; ++i) {
    scene.rows.push_back(
        {.v = Lanes{random.normal(), random.normal()}, .s = Lanes{parts.friction ? random.normal() : 0, 0}});
  }
  for (int group = 0; group < 30; ++group) {
    std::vector<int> bodies(kBodies);
    for (int i = 0; i < kBodies; ++i) bodies[i] = i;
    for (int i = kBodies - 1; i > 0; --i) std::swap(bodies[i], bodies[random.below(i + 1)]);
    ContactGroup c;
    for (std::size_t lane = 0; lane < 4; ++lane) {
      c.a[lane] = bodies[2 * lane];
      c.b[lane] = bodies[2 * lane + 1];
      for (FourLanes* member : {&c.nx, &c.ny, &c.p_n, &c.p_t, &c.scale_n, &c.scale_t, &c.inverse_mass_a,
                                &c.inverse_mass_b, &c.turn_a, &c.turn_b})
        member->set(lane, random.uniform(-1, 1));
      for (FourLanes* member : {&c.arm_a, &c.arm_b})
        member->set(lane, parts.arms ? random.uniform(0.9, 1) : 1);
      c.mu.set(lane, parts.friction ? random.uniform(0, 1) : 0);
      if (!parts.friction) c.p_t.set(lane, 0);
      if (!parts.offset) continue;
      for (FourLanes* member : {&c.bias_n, &c.bias_t, &c.compliance})
        member->set(lane, random.uniform(-1, 1));
    }
    scene.groups.push_back(c);
  }
  return scene;
}

/// The formulas of contact_solver.h, one contact after the other in plain doubles.
double plain_sweep(Scene& scene) {
  double change = 0;
  for (ContactGroup& c : scene.groups) {
    for (std::size_t k = 0; k < 4; ++k) {
      VelocityRow& a = scene.rows[static_cast<std::size_t>(c.a[k])];
      VelocityRow& b = scene.rows[static_cast<std::size_t>(c.b[k])];
      const double ux = a.v[0] - b.v[0];
      const double uy = a.v[1] - b.v[1];
      const double u_n = c.nx[k] * ux + c.ny[k] * uy + c.compliance[k] * c.p_n[k] + c.bias_n[k];
      const double u_t = c.ny[k] * ux - c.nx[k] * uy + (c.arm_a[k] * a.s[0] + c.arm_b[k] * b.s[0]) +
                         c.compliance[k] * c.p_t[k] + c.bias_t[k];
      const double p_n = std::max(c.p_n[k] - u_n * c.scale_n[k], 0.0);
      const double limit = c.mu[k] * p_n;
      const double p_t = std::min(std::max(c.p_t[k] - u_t * c.scale_t[k], -limit), limit);
      const double d_n = p_n - c.p_n[k];
      const double d_t = p_t - c.p_t[k];
      change = std::max({change, std::abs(d_n), std::abs(d_t)});
      c.p_n.set(k, p_n);
      c.p_t.set(k, p_t);
      const double px = c.nx[k] * d_n + c.ny[k] * d_t;
      const double py = c.ny[k] * d_n - c.nx[k] * d_t;
      a.v += Lanes{c.inverse_mass_a[k] * px, c.inverse_mass_a[k] * py};
      b.v -= Lanes{c.inverse_mass_b[k] * px, c.inverse_mass_b[k] * py};
      a.s[0] += c.turn_a[k] * d_t;
      b.s[0] += c.turn_b[k] * d_t;
    }
  }
  return change;
}

void expect_same_bits(const Scene& first, const Scene& second) {
  for (std::size_t i = 0; i < first.rows.size(); ++i) {
    EXPECT_EQ(first.rows[i].v[0], second.rows[i].v[0]) << "body " << i;
    EXPECT_EQ(first.rows[i].v[1], second.rows[i].v[1]) << "body " << i;
    EXPECT_EQ(first.rows[i].s[0], second.rows[i].s[0]) << "body " << i;
  }
  for (std::size_t i = 0; i < first.groups.size(); ++i) {
    for (std::size_t lane = 0; lane < 4; ++lane) {
      EXPECT_EQ(first.groups[i].p_n[lane], second.groups[i].p_n[lane]) << "group " << i;
      EXPECT_EQ(first.groups[i].p_t[lane], second.groups[i].p_t[lane]) << "group " << i;
    }
  }
}

/// All that a sweep can leave out or do.
std::vector<SweepParts> all_parts() {
  std::vector<SweepParts> all;
  for (int bits = 0; bits < 16; ++bits) {
    all.push_back({.friction = (bits & 1) != 0,
                   .arms = (bits & 2) != 0,
                   .offset = (bits & 4) != 0,
                   .measure = (bits & 8) != 0});
  }
  return all;
}

TEST(Sweep, IsThatOfPlainDoublesWhateverTheRegisters) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    for (const SweepParts& parts : all_parts()) {
      Scene plain = random_scene(seed, parts);
      Scene pairs = plain;
      Scene widest = plain;
      for (int sweeps = 0; sweeps < 3; ++sweeps) {
        const double change = plain_sweep(plain);
        EXPECT_EQ(sweep_in_pairs(parts, pairs.groups, pairs.rows), parts.measure ? change : 0);
        EXPECT_EQ(sweep(parts, widest.groups, widest.rows), parts.measure ? change : 0);
      }
      expect_same_bits(plain, pairs);
      expect_same_bits(plain, widest);
    }
  }
}

}  // namespace
}  // namespace indet::sim
