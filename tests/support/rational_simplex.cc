#include "tests/support/rational_simplex.h"

#include <cmath>
#include <limits>

namespace indet::oracle {

RationalSimplex::RationalSimplex(const Packing& packing) {
  const std::size_t contacts = packing.contacts.size();
  const std::size_t disk_rows = 3 * packing.disks.size();
  const std::size_t equations = disk_rows + 2 * packing.walls.size();
  columns_ = 2 * contacts;
  const std::size_t artificial = columns_;
  rows_.assign(equations, std::vector<mpq_class>(columns_ + equations + 1, 0));
  for (std::size_t c = 0; c < contacts; ++c) {
    const Contact& contact = packing.contacts[c];
    const mpq_class mu(contact.mu);
    mu_.push_back(mu);
    const mpq_class nx(contact.normal.x());
    const mpq_class ny(contact.normal.y());
    for (int side = 0; side < 2; ++side) {
      if (mu == 0 && side == 1) continue;  // the second edge would be the first again
      const mpq_class tangential = side == 0 ? mu : mpq_class(-mu);
      const std::size_t column = 2 * c + static_cast<std::size_t>(side);
      const auto act = [&](int disk, int chi, double lever) {
        const Disk& body = packing.disks[static_cast<std::size_t>(disk)];
        if (body.fixed) return;
        const auto row = 3 * static_cast<std::size_t>(disk);
        rows_[row][column] += chi * (nx + tangential * ny);
        rows_[row + 1][column] += chi * (ny - tangential * nx);
        rows_[row + 2][column] += tangential * mpq_class(std::isnan(lever) ? body.radius : lever);
      };
      act(contact.a.value(), 1, contact.lever_a);
      if (!contact.b.is_wall()) {
        act(contact.b.disk_id().value(), -1, contact.lever_b);
        continue;
      }
      const Wall& wall = packing[contact.b.wall_id()];
      const std::size_t row = disk_rows + 2 * static_cast<std::size_t>(contact.b.wall_id().value());
      if (!std::isnan(wall.load_n)) rows_[row][column] = 1;
      if (!std::isnan(wall.load_t)) rows_[row + 1][column] = tangential;
    }
  }
  for (std::size_t i = 0; i < packing.disks.size(); ++i) {
    const Disk& disk = packing.disks[i];
    if (disk.fixed) continue;
    const mpq_class mass(disk.mass);
    rows_[3 * i].back() = -(mass * mpq_class(packing.gravity.x()) + mpq_class(disk.load.x()));
    rows_[3 * i + 1].back() = -(mass * mpq_class(packing.gravity.y()) + mpq_class(disk.load.y()));
    rows_[3 * i + 2].back() = -mpq_class(disk.load.z());
  }
  for (std::size_t w = 0; w < packing.walls.size(); ++w) {
    const Wall& wall = packing.walls[w];
    if (!std::isnan(wall.load_n)) rows_[disk_rows + 2 * w].back() = mpq_class(wall.load_n);
    if (!std::isnan(wall.load_t)) rows_[disk_rows + 2 * w + 1].back() = mpq_class(wall.load_t);
  }
  std::vector<mpq_class> costs(columns_ + equations, 0);
  for (std::size_t i = 0; i < equations; ++i) {
    if (rows_[i].back() < 0) {
      for (mpq_class& entry : rows_[i]) entry = -entry;
    }
    rows_[i][artificial + i] = 1;
    costs[artificial + i] = -1;
    basic_.push_back(artificial + i);
  }
  maximise(costs);
  empty_ = reduced_.back() != 0;
  // Drive the artificial variables out; rows where none can replace them are combinations of the others.
  for (std::size_t i = 0; i < equations; ++i) {
    if (basic_[i] < columns_) continue;
    for (std::size_t j = 0; j < columns_; ++j) {
      if (rows_[i][j] == 0) continue;
      if (!empty_) pivot(i, j);
      break;
    }
  }
  if (empty_) return;
  std::vector<std::vector<mpq_class>> kept;
  std::vector<std::size_t> basic;
  for (std::size_t i = 0; i < equations; ++i) {
    if (basic_[i] >= columns_) continue;
    rows_[i].erase(rows_[i].begin() + static_cast<std::ptrdiff_t>(columns_), rows_[i].end() - 1);
    kept.push_back(std::move(rows_[i]));
    basic.push_back(basic_[i]);
  }
  rows_ = std::move(kept);
  basic_ = std::move(basic);
  rank_ = static_cast<int>(rows_.size());
}

void RationalSimplex::pivot(std::size_t row, std::size_t column) {
  const mpq_class inverse = 1 / rows_[row][column];
  for (mpq_class& entry : rows_[row]) {
    if (entry != 0) entry *= inverse;
  }
  const auto eliminate = [&](std::vector<mpq_class>& target) {
    const mpq_class factor = target[column];
    if (factor == 0) return;
    for (std::size_t j = 0; j < target.size(); ++j) {
      if (rows_[row][j] != 0) target[j] -= factor * rows_[row][j];
    }
  };
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (i != row) eliminate(rows_[i]);
  }
  if (reduced_.size() == rows_[row].size()) eliminate(reduced_);
  basic_[row] = column;
}

void RationalSimplex::price(const std::vector<mpq_class>& costs) {
  reduced_ = costs;
  reduced_.emplace_back(0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const mpq_class factor = reduced_[basic_[i]];
    if (factor == 0) continue;
    for (std::size_t j = 0; j < reduced_.size(); ++j) reduced_[j] -= factor * rows_[i][j];
  }
}

bool RationalSimplex::maximise(const std::vector<mpq_class>& costs) {
  price(costs);
  for (;;) {
    std::size_t entering = 0;
    while (entering < costs.size() && reduced_[entering] <= 0) ++entering;
    if (entering == costs.size()) return true;
    std::size_t leaving = rows_.size();
    mpq_class least;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i][entering] <= 0) continue;
      const mpq_class ratio = rows_[i].back() / rows_[i][entering];
      const bool first = leaving == rows_.size();
      if (first || ratio < least || (ratio == least && basic_[i] < basic_[leaving])) {
        leaving = i;
        least = ratio;
      }
    }
    if (leaving == rows_.size()) return false;
    pivot(leaving, entering);
  }
}

std::optional<mpq_class> RationalSimplex::extremum(int component, int sign) {
  return extremum({{component, 1.0}}, sign);
}

std::optional<mpq_class> RationalSimplex::extremum(const std::vector<std::pair<int, double>>& terms,
                                                   int sign) {
  std::vector<mpq_class> costs(columns_, 0);
  for (const auto& [component, coefficient] : terms) {
    const auto contact = static_cast<std::size_t>(component / 2);
    const mpq_class part = sign * mpq_class(coefficient);
    if (component % 2 == 0) {
      costs[2 * contact] += part;
      if (mu_[contact] > 0) costs[2 * contact + 1] += part;
    } else {
      costs[2 * contact] += part * mu_[contact];
      costs[2 * contact + 1] -= part * mu_[contact];
    }
  }
  if (!maximise(costs)) return {};
  return mpq_class(-sign * reduced_.back());
}

}  // namespace indet::oracle
