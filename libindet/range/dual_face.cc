#include "libindet/range/dual_face.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <optional>
#include <set>
#include <utility>

#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"

namespace indet {
namespace {

/// A dual feasible basis of Λ: λ_basic = level − table · λ_others with λ_others = 0. Rows are named by their
/// positions in DualFace::tight.
struct DualBasis {
  std::vector<int> basic, others;
  Eigen::MatrixXd table;
  Eigen::VectorXd level;

  int basic_at(Eigen::Index r) const { return basic[static_cast<std::size_t>(r)]; }
  int other_at(Eigen::Index c) const { return others[static_cast<std::size_t>(c)]; }

  /// λ_others[c] takes the place of λ_basic[r].
  void exchange(Eigen::Index r, Eigen::Index c) {
    const double pivot = table(r, c);
    const Eigen::VectorXd column = table.col(c);
    table.row(r) /= pivot;
    table(r, c) = 1 / pivot;
    level[r] /= pivot;
    for (Eigen::Index i = 0; i < table.rows(); ++i) {
      if (i == r || column[i] == 0) continue;
      table.row(i) -= column[i] * table.row(r);
      table(i, c) = -column[i] / pivot;
      level[i] -= column[i] * level[r];
    }
    std::swap(basic[static_cast<std::size_t>(r)], others[static_cast<std::size_t>(c)]);
  }
  /// The rows that limit λ_others[c]; several where Λ is degenerate.
  std::vector<Eigen::Index> limiting_rows(Eigen::Index c) const {
    const auto ratio = [&](Eigen::Index r) {
      return table(r, c) > tolerance::kReducedCost ? std::max(0.0, level[r]) / table(r, c) : kInfinity;
    };
    double least = kInfinity;
    for (Eigen::Index r = 0; r < table.rows(); ++r) least = std::min(least, ratio(r));
    std::vector<Eigen::Index> rows;
    for (Eigen::Index r = 0; r < table.rows() && least < kInfinity; ++r) {
      if (ratio(r) <= least + tolerance::kReducedCost) rows.push_back(r);
    }
    return rows;
  }
  void remove_column(Eigen::Index c) {
    const Eigen::Index last = table.cols() - 1;
    table.col(c) = table.col(last).eval();
    table.conservativeResize(Eigen::NoChange, last);
    others[static_cast<std::size_t>(c)] = others.back();
    others.pop_back();
  }
  void remove_row(Eigen::Index r) {
    const Eigen::Index last = table.rows() - 1;
    table.row(r) = table.row(last).eval();
    table.conservativeResize(last, Eigen::NoChange);
    level[r] = level[last];
    level.conservativeResize(last);
    basic[static_cast<std::size_t>(r)] = basic.back();
    basic.pop_back();
  }
};

DualBasis first_basis(const SlopeView& view, const Vertex& vertex, const Eigen::VectorXd& multipliers,
                      const std::vector<int>& tight) {
  DualBasis first;
  std::vector<int> rows;
  for (std::size_t k = 0; k < tight.size(); ++k) {
    const bool is_basic = std::binary_search(vertex.basis.begin(), vertex.basis.end(), tight[k]);
    (is_basic ? first.basic : first.others).push_back(static_cast<int>(k));
    if (!is_basic) rows.push_back(tight[k]);
  }
  first.level = multipliers;
  first.table.resize(std::ssize(first.basic), std::ssize(rows));
  for (std::size_t c = 0; c < rows.size(); ++c)
    first.table.col(static_cast<Eigen::Index>(c)) =
        -vertex.multipliers(make_objective(view, {{rows[c], 1.0}}));
  return first;
}

/// The rows with λ > 0 somewhere in Λ: Σλ of the others is made largest by the simplex method (Bland's rule)
/// until it is 0. Nothing where rounding leaves Λ unlimited.
std::optional<std::vector<bool>> positive_rows(DualBasis& basis) {
  std::vector<bool> positive(basis.basic.size() + basis.others.size(), false);
  const auto is_open = [&](int k) { return !positive[static_cast<std::size_t>(k)]; };
  for (int step = 0; step < tolerance::kMostDualSteps; ++step) {
    for (Eigen::Index r = 0; r < basis.level.size(); ++r) {
      if (basis.level[r] > tolerance::kReducedCost)
        positive[static_cast<std::size_t>(basis.basic_at(r))] = true;
    }
    Eigen::RowVectorXd gain = Eigen::RowVectorXd::Zero(basis.table.cols());
    for (Eigen::Index r = 0; r < basis.table.rows(); ++r) {
      if (is_open(basis.basic_at(r))) gain -= basis.table.row(r);
    }
    Eigen::Index entering = -1;
    for (Eigen::Index c = 0; c < gain.size(); ++c) {
      if (is_open(basis.other_at(c))) gain[c] += 1;
      if (gain[c] > tolerance::kReducedCost && (entering < 0 || basis.other_at(c) < basis.other_at(entering)))
        entering = c;
    }
    if (entering < 0) return positive;
    const std::vector<Eigen::Index> rows = basis.limiting_rows(entering);
    if (rows.empty()) return std::nullopt;
    basis.exchange(*std::min_element(rows.begin(), rows.end(),
                                     [&](auto a, auto b) { return basis.basic_at(a) < basis.basic_at(b); }),
                   entering);
  }
  return std::nullopt;
}

/// Leaves of Λ the rows that are positive somewhere. Returns how many equations they need no more.
int drop_other_rows(DualBasis& basis, const std::vector<bool>& positive) {
  const auto stays = [&](int k) { return positive[static_cast<std::size_t>(k)]; };
  for (Eigen::Index c = basis.table.cols() - 1; c >= 0; --c) {
    if (!stays(basis.other_at(c))) basis.remove_column(c);
  }
  int dropped = 0;
  for (Eigen::Index r = basis.table.rows() - 1; r >= 0; --r) {
    if (stays(basis.basic_at(r))) continue;
    Eigen::Index c = 0;
    const double largest = basis.table.cols() > 0 ? basis.table.row(r).cwiseAbs().maxCoeff(&c) : 0;
    if (largest > tolerance::kHeldRate) {
      basis.exchange(r, c);
      basis.remove_column(c);
    } else {
      basis.remove_row(r);
      ++dropped;
    }
  }
  return dropped;
}

/// All vertices of Λ, from one basis to its neighbours; nothing where there are too many.
std::optional<std::vector<Eigen::VectorXd>> vertices_from(const DualBasis& first, std::size_t tight) {
  const auto sorted = [](std::vector<int> key) {
    std::sort(key.begin(), key.end());
    return key;
  };
  if (std::ssize(first.others) >= tolerance::kMostDualBases) return std::nullopt;
  std::vector<Eigen::VectorXd> vertices;
  std::deque<DualBasis> waiting = {first};
  std::set<std::vector<int>> known = {sorted(first.basic)};
  while (!waiting.empty()) {
    const DualBasis basis = std::move(waiting.front());
    waiting.pop_front();
    Eigen::VectorXd costs = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(tight));
    for (Eigen::Index r = 0; r < basis.level.size(); ++r)
      costs[basis.basic_at(r)] = std::max(0.0, basis.level[r]);
    vertices.push_back(std::move(costs));
    for (Eigen::Index c = 0; c < basis.table.cols(); ++c) {
      const std::vector<Eigen::Index> rows = basis.limiting_rows(c);
      if (rows.empty()) return std::nullopt;
      for (const Eigen::Index r : rows) {
        std::vector<int> key = basis.basic;
        key[static_cast<std::size_t>(r)] = basis.other_at(c);
        if (!known.insert(sorted(std::move(key))).second) continue;
        if (std::ssize(known) > tolerance::kMostDualBases) return std::nullopt;
        waiting.push_back(basis);
        waiting.back().exchange(r, c);
      }
    }
  }
  return vertices;
}

}  // namespace

DualFace find_dual_face(const SlopeView& view, const Vertex& vertex, const Eigen::VectorXd& multipliers) {
  DualFace face;
  const double limit = tolerance::kTightHalfPlane * std::max(1.0, vertex.x.lpNorm<Eigen::Infinity>());
  for (int k = 0; k < view.inequalities(); ++k) {
    if (vertex.x[k] <= limit || std::binary_search(vertex.basis.begin(), vertex.basis.end(), k))
      face.tight.push_back(k);
  }
  const std::size_t entries = vertex.basis.size() * (face.tight.size() - vertex.basis.size());
  if (entries > static_cast<std::size_t>(tolerance::kMostDualEntries)) return face;
  DualBasis basis = first_basis(view, vertex, multipliers, face.tight);
  const std::optional<std::vector<bool>> positive = positive_rows(basis);
  if (!positive) return face;
  const int dropped = drop_other_rows(basis, *positive);
  std::optional<std::vector<Eigen::VectorXd>> vertices = vertices_from(basis, face.tight.size());
  if (!vertices) return face;
  face.vertices = std::move(*vertices);
  face.is_whole = true;
  face.has_one_state = dropped == 0;
  return face;
}

}  // namespace indet
