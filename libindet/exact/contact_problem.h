#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "libindet/exact/modular_lu.h"
#include "libindet/packing/loads.h"
#include "libindet/packing/packing.h"

namespace indet::exact {

/// The equilibrium problem of a packing over the rational numbers, with the doubles of the packing taken as
/// they are (docs/decisions/exact-problem.md):
///
///   for each free disk:  Σ χ (R n̂ + T t̂) + m g + load = 0,   Σ l T + load_z = 0,   t̂ = (n_y, −n_x), χ = ±1
///   for each imposed component of stress:  −Σ f_i l_j + A σ_ij = 0,   l = x_a − x_b − image · cell vectors
///   for each loaded wall, where it is free:  −ΣR + load_n = 0,  −ΣT + load_t = 0
///   for each contact:  R ≥ 0,  |T| ≤ μR
///   for each bound (force_bounds.h) of a force F:  F − s = lo,  F + s = hi,  F = value,  s ≥ 0
///
/// n̂ is what is stored, also where its length is not exactly 1; products, sums and quotients are exact.
/// Multiplying a row or an unknown by a number does not change this problem, so none of the scales of the
/// analysis enters. Torque rows are divided by the radius; where a contact of the disk has a lever l ≠ r, by
/// a power of two near the radius instead, so that all coefficients have finitely many binary digits. Rows of
/// stress are divided by a power of two near the length of the cell (Packing::cell_length).
///
/// Unknowns are strengths of cone edges, R = x₊ + x₋, T = μ (x₊ − x₋), x ≥ 0. Edge 2α is x₊ of contact α (R
/// itself where μ = 0), edge 2α + 1 is x₋ (absent where μ = 0): the numbers of the half-planes in
/// /extremal/active, each of which is "this edge has strength 0". Edges 2M, 2M + 1, … are the slacks s.
///
/// With a change w_1 of the load, which is w + λ w_1 then, the last two edges are the parts of λ = λ₊ − λ₋,
/// both ≥ 0, with the columns w_1 and −w_1: no basis holds both. Relaxed, λ is added to
/// every strength x of an edge of a contact instead: the largest λ, negative if need be, tells by its sign
/// whether there are states.
class ContactProblem {
 public:
  /// Precondition: find_defect(packing) is empty.
  explicit ContactProblem(const Packing& packing) : ContactProblem(packing, nullptr) {}
  /// Precondition: defect_of(change, packing) is empty, and the change is not zero.
  ContactProblem(const Packing& packing, const Loads& change) : ContactProblem(packing, &change) {}
  /// The same equations with strengths x + λ, x ≥ 0, of edges of contacts (not of slacks).
  static ContactProblem relaxed(const Packing& packing);

  /// The same problem with only those edges, of the ones it has, that are set in `open` (one an edge); the
  /// others are held at 0. Rows, edges and contacts keep their numbers; the rank may fall.
  ContactProblem restricted_to(const std::vector<bool>& open) const;

  int rows() const { return static_cast<int>(load_.size()); }
  int contacts() const { return static_cast<int>(contacts_.size()); }
  int edges() const { return 2 * contacts() + static_cast<int>(slacks_.size()); }
  /// λ₊ and λ₋. Precondition: the problem has a change of the load, or is relaxed.
  int rise() const { return edges() - 2; }
  int fall() const { return edges() - 1; }
  bool is_slack(int edge) const { return edge >= 2 * contacts(); }
  bool has_edge(int edge) const { return has_edge_[static_cast<std::size_t>(edge)]; }
  /// The edges that there are, ascending.
  std::vector<int> open_edges() const;
  /// The row of an equation of a disk (0: force x, 1: force y, 2: torque), wall (0: along the normal, 1:
  /// along the tangent) or the cell (the component of stress), −1 if it reads 0 = 0, the wall is not free,
  /// the component not imposed.
  int row(Body body, int component) const {
    const auto k = static_cast<std::size_t>(component);
    if (body.is_cell()) return row_of_cell_[k];
    return body.is_wall() ? row_of_wall_[static_cast<std::size_t>(body.wall_id().value())][k]
                          : row_of_[static_cast<std::size_t>(body.disk_id().value())][k];
  }
  /// The row of a bound, by its place in force_bounds().
  int row_of_bound(int bound) const { return first_bound_ + bound; }
  /// What the torque row of a disk is divided by (its radius, or the power of two in its place), over its
  /// radius. A motion has this times rω in that row.
  double spin_scale(DiskId disk) const { return spin_scale_[static_cast<std::size_t>(disk.value())]; }
  /// The same of rows of stress: their divisor over the cell's length.
  double compression_scale() const { return compression_scale_; }

  /// The rank of the columns of the edges modulo a prime near 2^62. It is a lower bound of the exact rank,
  /// and equals it but for an accident of probability below 1e-12.
  int rank() const { return static_cast<int>(independent_.size()); }
  /// rank() rows that are independent (this is certain), ascending; and the place of each row among them, −1
  /// if none.
  const std::vector<int>& independent_rows() const { return independent_; }
  const std::vector<int>& row_number() const { return row_number_; }
  /// Whether all other rows follow from these, the load included, so that what satisfies these satisfies all.
  /// Proven when first asked for (proves_structure); false where it is not proven.
  bool is_consistent() const;

  const mpq_class& mu(int contact) const { return contacts_[static_cast<std::size_t>(contact)].mu; }
  /// Columns of R and T of one contact, and of an edge. Precondition of mu(): no slack's.
  const IntegerColumn& normal(int contact) const {
    return contacts_[static_cast<std::size_t>(contact)].normal;
  }
  const IntegerColumn& tangential(int contact) const {
    return contacts_[static_cast<std::size_t>(contact)].tangential;
  }
  const IntegerColumn& edge(int edge) const;
  /// The part of a column on the independent rows, numbered among these.
  IntegerColumn on_independent_rows(const IntegerColumn& column) const;

  /// −w times load_scale(): the right-hand side, integers, one a row.
  const std::vector<mpz_class>& load() const { return load_; }
  const mpz_class& load_scale() const { return load_scale_; }

  /// At most rank() edges whose columns are independent, taken greedily from the highest preference down.
  /// Ascending. Precondition: one preference an edge.
  std::vector<int> choose_basis(std::span<const double> preference) const;

 private:
  ContactProblem(const Packing& packing, const Loads* change);
  struct Contact {
    mpq_class mu;
    IntegerColumn normal, tangential, plus, minus;
  };
  void find_independent_rows();

  std::vector<std::array<int, 3>> row_of_;
  std::vector<std::array<int, 2>> row_of_wall_;
  std::array<int, 4> row_of_cell_{-1, -1, -1, -1};
  std::vector<double> spin_scale_;
  double compression_scale_ = 1;
  std::vector<Contact> contacts_;
  int first_bound_ = 0;                ///< row
  std::vector<IntegerColumn> slacks_;  ///< of edges 2M, 2M + 1, …; then of λ
  std::vector<bool> has_edge_;
  std::vector<mpz_class> load_;
  mpz_class load_scale_ = 1;
  std::vector<int> independent_;
  std::vector<int> row_number_;
  struct Consistency {
    std::once_flag once;
    bool is_proven = false;
  };
  std::shared_ptr<Consistency> consistency_;  ///< copies have the same
};

/// Strengths of all edges, in double precision, at forces R and T of each contact in turn:
/// (R ± T/μ)/2, and R on both edges where μ = 0, then the slacks of bounds. Precondition: two forces a
/// contact.
std::vector<double> edge_strengths(const Packing& packing, std::span<const double> forces);
/// The same along a direction of growth, in which bounds have the value 0.
std::vector<double> edge_growths(const Packing& packing, std::span<const double> forces);

}  // namespace indet::exact
