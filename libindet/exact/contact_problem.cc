#include "libindet/exact/contact_problem.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "libindet/exact/certificate.h"
#include "libindet/exact/row_numbers.h"
#include "libindet/packing/force_bounds.h"

namespace indet::exact {
namespace {

using Entries = std::vector<std::pair<int, mpq_class>>;

/// Multiplies a column of dyadic numbers by the smallest power of two that makes it integer.
IntegerColumn integer_column(Entries entries) {
  std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  // A disk that touches an image of itself has two entries in each of its rows.
  for (std::size_t k = 1; k < entries.size(); ++k) {
    if (entries[k].first != entries[k - 1].first) continue;
    entries[k].second += entries[k - 1].second;
    entries[k - 1].second = 0;
  }
  std::erase_if(entries, [](const auto& entry) { return entry.second == 0; });
  IntegerColumn column;
  bool first = true;
  for (const auto& [row, value] : entries) {
    const auto below = static_cast<long>(mpz_sizeinbase(value.get_den_mpz_t(), 2)) - 1;
    const auto zeros = static_cast<long>(mpz_scan1(value.get_num_mpz_t(), 0));
    const long needed = below > 0 ? below : -zeros;
    column.shift = first ? needed : std::max(column.shift, needed);
    first = false;
  }
  for (const auto& [row, value] : entries) {
    column.row.push_back(row);
    column.value.push_back(scaled(value, column.shift).get_num());
  }
  return column;
}

/// The radius of each disk; where a contact has another lever, or its torque is changed, a power of two near
/// it, so that columns are dyadic.
std::vector<double> torque_divisors(const Packing& packing, const Loads* change) {
  std::vector<double> divisors;
  for (const Disk& disk : packing.disks) divisors.push_back(disk.radius);
  const auto see = [&](DiskId disk, double lever) {
    const double radius = packing[disk].radius;
    if (lever != radius)
      divisors[static_cast<std::size_t>(disk.value())] = std::ldexp(1.0, std::ilogb(radius));
  };
  for (int i = 0; i < packing.contact_count(); ++i) {
    const indet::Contact& contact = packing[ContactId(i)];
    see(contact.a, packing.lever_a(ContactId(i)));
    if (!contact.b.is_wall()) see(contact.b.disk_id(), packing.lever_b(ContactId(i)));
  }
  for (int i = 0; change && i < std::ssize(change->disks); ++i) {
    if (change->disks[static_cast<std::size_t>(i)].z() != 0) see(DiskId(i), 0);
  }
  return divisors;
}

/// The wrench of a disk, exactly; the torque divided by `torque_divisor`.
std::array<mpq_class, 3> exact_wrench(const Packing& packing, const Loads& loads, int disk,
                                      double torque_divisor) {
  std::array<mpq_class, 3> wrench;
  const auto i = static_cast<std::size_t>(disk);
  if (packing.disks[i].fixed) return wrench;
  const mpq_class mass(packing.disks[i].mass);
  const Vector3 own = loads.disks.empty() ? Vector3(0, 0, 0) : loads.disks[i];
  wrench[0] = mass * mpq_class(loads.gravity.x()) + mpq_class(own.x());
  wrench[1] = mass * mpq_class(loads.gravity.y()) + mpq_class(own.y());
  wrench[2] = mpq_class(own.z()) / mpq_class(torque_divisor);
  return wrench;
}

/// The lever of each end over the divisor of its disk, and the branch vector over that of the cell.
struct Ends {
  mpq_class arm_a, arm_b;
  std::array<mpq_class, 2> branch;
};

/// x_a − x_b − image · cell vectors, over `divisor`.
std::array<mpq_class, 2> exact_branch(const Packing& packing, const indet::Contact& contact, double divisor) {
  std::array<mpq_class, 2> branch;
  for (const int k : {0, 1}) {
    mpq_class& value = branch[static_cast<std::size_t>(k)];
    value = mpq_class(packing[contact.a].position[k]) - mpq_class(packing[contact.b.disk_id()].position[k]);
    if (packing.cell.a) value -= contact.image[0] * mpq_class((*packing.cell.a)[k]);
    if (packing.cell.b) value -= contact.image[1] * mpq_class((*packing.cell.b)[k]);
    value /= mpq_class(divisor);
  }
  return branch;
}

/// A σ_ij over `divisor`.
mpq_class exact_load(const Packing& packing, double stress, double divisor) {
  const Vector2& a = *packing.cell.a;
  const Vector2& b = *packing.cell.b;
  const mpq_class area = mpq_class(a.x()) * mpq_class(b.y()) - mpq_class(a.y()) * mpq_class(b.x());
  return abs(area) * mpq_class(stress) / mpq_class(divisor);
}

/// R n̂ + T t̂ on a, the opposite on b, and T times its arm on both torques; −R and −T on a loaded wall.
Entries force_entries(const Packing& packing, const RowNumbers& number, const indet::Contact& contact,
                      const Ends& ends, const mpq_class& R, const mpq_class& T) {
  const mpq_class nx(contact.normal.x());
  const mpq_class ny(contact.normal.y());
  const mpq_class fx = R * nx + T * ny;
  const mpq_class fy = R * ny - T * nx;
  Entries entries;
  const auto add = [&](DiskId disk, int sign, const mpq_class& arm) {
    entries.emplace_back(number(disk, 0), sign * fx);
    entries.emplace_back(number(disk, 1), sign * fy);
    if (T != 0) entries.emplace_back(number(disk, 2), arm * T);
  };
  if (packing.has_equations(contact.a)) add(contact.a, 1, ends.arm_a);
  if (packing.is_free_disk(contact.b)) add(contact.b.disk_id(), -1, ends.arm_b);
  if (packing.stress.is_imposed()) {
    const auto& [lx, ly] = ends.branch;
    const std::array<mpq_class, 4> parts = {fx * lx, fy * ly, fx * ly, (fx * lx + fy * ly) / 2};
    for (int k = 0; k < 4; ++k) {
      if (number.of_cell(k) >= 0)
        entries.emplace_back(number.of_cell(k), -parts[static_cast<std::size_t>(k)]);
    }
  }
  if (contact.b.is_wall()) {
    const int along_normal = number(contact.b.wall_id(), 0);
    const int along_tangent = number(contact.b.wall_id(), 1);
    if (along_normal >= 0) entries.emplace_back(along_normal, -R);
    if (along_tangent >= 0) entries.emplace_back(along_tangent, -T);
  }
  return entries;
}

}  // namespace

std::vector<double> edge_growths(const Packing& packing, std::span<const double> forces) {
  std::vector<double> growths;
  growths.reserve(forces.size());
  for (std::size_t i = 0; i < packing.contacts.size(); ++i) {
    const double mu = packing.contacts[i].mu;
    const double R = forces[2 * i];
    const double T = forces[2 * i + 1];
    growths.push_back(mu > 0 ? (R + T / mu) / 2 : R);
    growths.push_back(mu > 0 ? (R - T / mu) / 2 : R);
  }
  for (const ForceBound& bound : force_bounds(packing)) {
    const double force = forces[static_cast<std::size_t>(bound.component())];
    if (bound.side != ForceBound::Side::kEqual)
      growths.push_back(bound.side == ForceBound::Side::kLower ? force : -force);
  }
  return growths;
}

std::vector<double> edge_strengths(const Packing& packing, std::span<const double> forces) {
  std::vector<double> strengths = edge_growths(packing, forces);
  std::size_t next = 2 * packing.contacts.size();
  for (const ForceBound& bound : force_bounds(packing)) {
    if (bound.side != ForceBound::Side::kEqual)
      strengths[next++] += bound.side == ForceBound::Side::kLower ? -bound.value : bound.value;
  }
  return strengths;
}

ContactProblem::ContactProblem(const Packing& packing, const Loads* change) {
  RowNumbers number(packing);
  const std::vector<double> divisors = torque_divisors(packing, change);
  const auto divisor = [&](DiskId disk) { return divisors[static_cast<std::size_t>(disk.value())]; };
  for (int i = 0; i < packing.disk_count(); ++i) {
    spin_scale_.push_back(divisor(DiskId(i)) / packing[DiskId(i)].radius);
  }
  double cell_divisor = 1;
  if (packing.stress.is_imposed()) {
    cell_divisor = std::ldexp(1.0, std::ilogb(packing.cell_length()));
    compression_scale_ = cell_divisor / packing.cell_length();
    row_of_cell_ = number.of_cell();
  }
  // w of some loads: what is not 0, in rows that are numbered if they are not yet.
  const auto wrench_of = [&](const Loads& loads) {
    Entries entries;
    for (int i = 0; i < packing.disk_count(); ++i) {
      const auto exact = exact_wrench(packing, loads, i, divisor(DiskId(i)));
      for (int k = 0; k < 3; ++k) {
        const mpq_class& value = exact[static_cast<std::size_t>(k)];
        if (value != 0) entries.emplace_back(number.need(DiskId(i), k), value);
      }
    }
    for (int w = 0; w < packing.wall_count(); ++w) {
      for (int k = 0; k < 2; ++k) {
        const double load = loads.on_wall(WallId(w), k);
        if (load != 0) entries.emplace_back(number.need(WallId(w), k), mpq_class(load));
      }
    }
    for (std::size_t k = 0; k < loads.stress.size(); ++k) {
      if (row_of_cell_[k] >= 0)
        entries.emplace_back(row_of_cell_[k], exact_load(packing, loads.stress[k], cell_divisor));
    }
    return entries;
  };
  Entries wrench = wrench_of(loads_of(packing));
  Entries changed = change ? wrench_of(*change) : Entries();
  row_of_ = number.all();
  row_of_wall_ = number.of_walls();
  const std::vector<ForceBound> bounds = force_bounds(packing);
  first_bound_ = number.count();
  const int row_count = first_bound_ + static_cast<int>(bounds.size());
  std::vector<std::vector<int>> bounds_of(packing.contacts.size());
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    const int row = row_of_bound(static_cast<int>(k));
    wrench.emplace_back(row, -mpq_class(bounds[k].value));
    bounds_of[static_cast<std::size_t>(bounds[k].contact.value())].push_back(static_cast<int>(k));
    if (bounds[k].side == ForceBound::Side::kEqual) continue;
    const int sign = bounds[k].side == ForceBound::Side::kLower ? -1 : 1;
    slacks_.push_back(integer_column({{row, mpq_class(sign)}}));
  }
  if (change) {
    slacks_.push_back(integer_column(changed));
    for (auto& [row, value] : changed) value = -value;
    slacks_.push_back(integer_column(std::move(changed)));
  }
  for (const auto& [row, value] : wrench) load_scale_ = lcm(load_scale_, value.get_den());
  load_.assign(static_cast<std::size_t>(row_count), 0);
  for (const auto& [row, value] : wrench)
    load_[static_cast<std::size_t>(row)] = -value.get_num() * (load_scale_ / value.get_den());

  for (int i = 0; i < packing.contact_count(); ++i) {
    const indet::Contact& contact = packing[ContactId(i)];
    Ends ends;
    ends.arm_a = mpq_class(packing.lever_a(ContactId(i))) / mpq_class(divisor(contact.a));
    if (!contact.b.is_wall()) {
      ends.arm_b = mpq_class(packing.lever_b(ContactId(i))) / mpq_class(divisor(contact.b.disk_id()));
    }
    if (packing.stress.is_imposed()) ends.branch = exact_branch(packing, contact, cell_divisor);
    const auto column = [&](const mpq_class& R, const mpq_class& T) {
      Entries entries = force_entries(packing, number, contact, ends, R, T);
      for (const int k : bounds_of[static_cast<std::size_t>(i)])
        entries.emplace_back(row_of_bound(k), bounds[static_cast<std::size_t>(k)].tangential ? T : R);
      return integer_column(std::move(entries));
    };
    Contact exact;
    exact.mu = mpq_class(contact.mu);
    exact.normal = column(1, 0);
    if (contact.mu > 0) {
      exact.tangential = column(0, 1);
      exact.plus = column(1, exact.mu);
      exact.minus = column(1, -exact.mu);
    }
    contacts_.push_back(std::move(exact));
  }
  for (int e = 0; e < edges(); ++e) has_edge_.push_back(is_slack(e) || e % 2 == 0 || mu(e / 2) > 0);
  find_independent_rows();
}

ContactProblem ContactProblem::relaxed(const Packing& packing) {
  ContactProblem problem(packing);
  std::vector<mpq_class> sum(static_cast<std::size_t>(problem.rows()));
  for (int e = 0; e < 2 * problem.contacts(); ++e) {
    if (!problem.has_edge(e)) continue;
    const IntegerColumn& column = problem.edge(e);
    for (std::size_t k = 0; k < column.row.size(); ++k)
      sum[static_cast<std::size_t>(column.row[k])] += scaled(mpq_class(column.value[k]), -column.shift);
  }
  for (const int sign : {1, -1}) {
    Entries entries;
    for (int row = 0; row < problem.rows(); ++row) {
      const mpq_class& value = sum[static_cast<std::size_t>(row)];
      if (value != 0) entries.emplace_back(row, sign * value);
    }
    problem.slacks_.push_back(integer_column(std::move(entries)));
    problem.has_edge_.push_back(true);
  }
  problem.find_independent_rows();
  return problem;
}

ContactProblem ContactProblem::restricted_to(const std::vector<bool>& open) const {
  ContactProblem part = *this;
  for (std::size_t e = 0; e < has_edge_.size(); ++e) part.has_edge_[e] = has_edge_[e] && open[e];
  part.find_independent_rows();
  return part;
}

std::vector<int> ContactProblem::open_edges() const {
  std::vector<int> open;
  for (int e = 0; e < edges(); ++e) {
    if (has_edge(e)) open.push_back(e);
  }
  return open;
}

void ContactProblem::find_independent_rows() {
  std::vector<const IntegerColumn*> columns;
  for (int e = 0; e < edges(); ++e) {
    if (!has_edge(e)) continue;
    // Both edges of a contact span what its normal and tangential forces do, whose columns are sparser.
    const bool has_both = !is_slack(e) && has_edge(e - e % 2) && has_edge(e - e % 2 + 1);
    columns.push_back(!has_both ? &edge(e) : e % 2 == 0 ? &normal(e / 2) : &tangential(e / 2));
  }
  const PrimeField field(large_prime(0));
  independent_ = ModularLu(field, rows(), columns).pivot_rows();
  row_number_.assign(static_cast<std::size_t>(rows()), -1);
  for (std::size_t k = 0; k < independent_.size(); ++k)
    row_number_[static_cast<std::size_t>(independent_[k])] = static_cast<int>(k);
  consistency_ = std::make_shared<Consistency>();
}

bool ContactProblem::is_consistent() const {
  std::call_once(consistency_->once,
                 [this] { consistency_->is_proven = proves_structure(*this, {}, rank()); });
  return consistency_->is_proven;
}

const IntegerColumn& ContactProblem::edge(int edge) const {
  if (is_slack(edge)) return slacks_[static_cast<std::size_t>(edge - 2 * contacts())];
  const Contact& contact = contacts_[static_cast<std::size_t>(edge / 2)];
  if (contact.mu == 0) return contact.normal;
  return edge % 2 == 0 ? contact.plus : contact.minus;
}

IntegerColumn ContactProblem::on_independent_rows(const IntegerColumn& column) const {
  IntegerColumn part;
  part.shift = column.shift;
  for (std::size_t k = 0; k < column.row.size(); ++k) {
    const int row = row_number_[static_cast<std::size_t>(column.row[k])];
    if (row < 0) continue;
    part.row.push_back(row);
    part.value.push_back(column.value[k]);
  }
  return part;
}

std::vector<int> ContactProblem::choose_basis(std::span<const double> preference) const {
  std::vector<int> order = open_edges();
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return preference[static_cast<std::size_t>(a)] > preference[static_cast<std::size_t>(b)];
  });
  std::vector<const IntegerColumn*> columns;
  for (const int e : order) columns.push_back(&edge(e));
  const PrimeField field(large_prime(0));
  std::vector<int> basis;
  for (const int position : independent_prefix(field, row_number_, rank(), columns, rank()))
    basis.push_back(order[static_cast<std::size_t>(position)]);
  std::sort(basis.begin(), basis.end());
  return basis;
}

}  // namespace indet::exact
