#include "libindet/barrier/dikin_widths.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace indet::barrier {
namespace {

constexpr int kMost = 4;  ///< rows of a node
using Block = std::array<double, kMost * kMost>;

/// (L Lᵀ)⁻¹ in the blocks of L.
class SelectedInverse {
 public:
  SelectedInverse(const BlockStructure& structure, const BlockCholesky& cholesky)
      : s_(structure), L_(cholesky.values()), inverse_(static_cast<std::size_t>(structure.values()), 0.0) {
    for (int j = s_.nodes() - 1; j >= 0; --j) invert_column(j);
  }

  /// Entry r, q of the block of two nodes.
  double operator()(int a, int r, int b, int q) const {
    if (a < b) return (*this)(b, q, a, r);
    const int block = find(a, b);
    return inverse_[static_cast<std::size_t>(s_.block_value(block) + r * s_.node_rows(b) + q)];
  }

 private:
  int find(int row, int column) const {
    int low = s_.first_block(column), high = s_.first_block(column + 1);
    while (high - low > 1) {
      const int middle = (low + high) / 2;
      (s_.block_node(middle) <= row ? low : high) = middle;
    }
    return low;
  }

  /// With U_k = L_kj L_jj⁻¹:  Z_ij = −Σ_k Z_ik U_k,  Z_jj = (L_jj L_jjᵀ)⁻¹ − Σ_k U_kᵀ Z_kj.
  void invert_column(int j) {
    const int n = s_.node_rows(j);
    const double* own = L_.data() + s_.block_value(s_.first_block(j));
    Block inverse{};  // of L_jj, lower triangle
    for (int c = 0; c < n; ++c) {
      inverse[entry(c, c)] = 1 / own[c * n + c];
      for (int r = c + 1; r < n; ++r) {
        double sum = 0;
        for (int q = c; q < r; ++q) sum -= own[r * n + q] * inverse[entry(q, c)];
        inverse[entry(r, c)] = sum / own[r * n + r];
      }
    }
    const int first = s_.first_block(j) + 1;
    const int end = s_.first_block(j + 1);
    U_.resize(static_cast<std::size_t>(end - first));
    for (int k = first; k < end; ++k) {
      const double* block = L_.data() + s_.block_value(k);
      for (int r = 0; r < s_.node_rows(s_.block_node(k)); ++r) {
        for (int c = 0; c < n; ++c) {
          double sum = 0;
          for (int q = c; q < n; ++q) sum += block[r * n + q] * inverse[entry(q, c)];
          U_[static_cast<std::size_t>(k - first)][entry(r, c)] = sum;
        }
      }
    }
    // Every pair of rows below has a block of its own: fill.
    for (int k = first; k < end; ++k) {
      const int node = s_.block_node(k);
      int at = s_.first_block(node);
      for (int i = k; i < end; ++i) {
        while (s_.block_node(at) != s_.block_node(i)) ++at;
        add_product(at, i, k, first, n);
      }
    }
    double* diagonal = inverse_.data() + s_.block_value(s_.first_block(j));
    for (int r = 0; r < n; ++r) {
      for (int c = 0; c < n; ++c) {
        double sum = 0;
        for (int q = std::max(r, c); q < n; ++q) sum += inverse[entry(q, r)] * inverse[entry(q, c)];
        for (int k = first; k < end; ++k) {
          const double* z = inverse_.data() + s_.block_value(k);
          for (int q = 0; q < s_.node_rows(s_.block_node(k)); ++q)
            sum -= U_[static_cast<std::size_t>(k - first)][entry(q, r)] * z[q * n + c];
        }
        diagonal[r * n + c] = sum;
      }
    }
  }

  /// Takes Z_ik, in block `at`, to Z_ij and, where i ≠ k, its transpose to Z_kj.
  void add_product(int at, int i, int k, int first, int n) {
    const double* z = inverse_.data() + s_.block_value(at);
    const int rows = s_.node_rows(s_.block_node(i));
    const int columns = s_.node_rows(s_.block_node(k));
    double* to_i = inverse_.data() + s_.block_value(i);
    double* to_k = inverse_.data() + s_.block_value(k);
    const Block& U_i = U_[static_cast<std::size_t>(i - first)];
    const Block& U_k = U_[static_cast<std::size_t>(k - first)];
    for (int r = 0; r < rows; ++r) {
      for (int q = 0; q < columns; ++q) {
        const double value = z[r * columns + q];
        for (int c = 0; c < n; ++c) {
          to_i[r * n + c] -= value * U_k[entry(q, c)];
          if (i != k) to_k[q * n + c] -= value * U_i[entry(r, c)];
        }
      }
    }
  }

  static std::size_t entry(int r, int c) { return static_cast<std::size_t>(r * kMost + c); }

  const BlockStructure& s_;
  std::span<const double> L_;
  std::vector<double> inverse_;
  std::vector<Block> U_;
};

}  // namespace

DikinWidths dikin_widths(const EquilibriumProblem& problem, const BlockStructure& structure,
                         const AnalyticCentre& centre, BlockCholesky& cholesky) {
  std::vector<double> squares;
  for (const double x : centre.x) squares.push_back(x * x);
  cholesky.factor(squares);
  const SelectedInverse inverse(structure, cholesky);
  DikinWidths widths;
  widths.R.assign(problem.contacts.size(), 0);
  widths.T.assign(problem.contacts.size(), 0);
  for (const BlockStructure::Group& group : structure.groups()) {
    if (group.first_column == problem.unknowns()) continue;  // the slack of a limit
    const Edge& first = problem.edge(group.first_column);
    if (first.is_slack()) continue;
    for (const bool tangential : {false, true}) {
      // v = A X² cᵀ, by the nodes that the group touches.
      double own = 0;
      std::vector<std::pair<const BlockStructure::Touch*, Block>> v;
      for (int t = group.first_touch; t < group.end_touch; ++t)
        v.emplace_back(&structure.touches()[static_cast<std::size_t>(t)], Block{});
      for (int e = 0; e < group.columns; ++e) {
        const Edge& edge = problem.edge(group.first_column + e);
        const double c = tangential ? edge.T : edge.R;
        const double weight = c * squares[static_cast<std::size_t>(group.first_column + e)];
        own += c * weight;
        for (auto& [touch, sum] : v) {
          for (int r = 0; r < touch->rows; ++r)
            sum[static_cast<std::size_t>(r)] +=
                weight *
                structure.coefficients()[static_cast<std::size_t>(touch->coefficients + e * touch->rows + r)];
        }
      }
      double taken = 0;
      for (const auto& [a, on_a] : v) {
        for (const auto& [b, on_b] : v) {
          for (int r = 0; r < a->rows; ++r) {
            for (int q = 0; q < b->rows; ++q)
              taken += on_a[static_cast<std::size_t>(r)] * inverse(a->node, r, b->node, q) *
                       on_b[static_cast<std::size_t>(q)];
          }
        }
      }
      (tangential ? widths.T : widths.R)[static_cast<std::size_t>(first.contact.value())] =
          std::sqrt(std::max(0.0, own - taken));
    }
  }
  return widths;
}

}  // namespace indet::barrier
