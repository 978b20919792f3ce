#include "libindet/barrier/verified_equations.h"

#include <algorithm>
#include <cmath>

#include "libindet/barrier/stored_entries.h"
#include "libindet/barrier/vectors.h"
#include "libindet/base/constants.h"
#include "libindet/base/rounding_bounds.h"

namespace indet::barrier {
namespace {

constexpr double kSmallest = 0x1p-300;
constexpr double kSmallestSquared = 0x1p-500;  ///< below it squares lose digits
/// More of the centre's multipliers than rounding asks for, so that their own rounding does no harm.
constexpr double kRoomForRounding = 1.5;
/// A residual, in the unit of the problem, of which a repair may leave more than rounding: it leaves some
/// 1e-9 of it.
constexpr double kLargeResidual = 1e-6;

/// γ_n of Higham: the relative rounding of a sum of n products.
double gamma(double n) { return n * kRoundoff / (1 - n * kRoundoff); }

/// |A| |x|.
std::vector<double> magnitude_product(const BlockStructure& s, std::span<const double> x) {
  std::vector<double> result(static_cast<std::size_t>(s.rows()), 0.0);
  for (const BlockStructure::Group& group : s.groups()) {
    for (int t = group.first_touch; t < group.end_touch; ++t) {
      const BlockStructure::Touch& touch = s.touches()[static_cast<std::size_t>(t)];
      for (int e = 0; e < group.columns; ++e) {
        for (int r = 0; r < touch.rows; ++r) {
          result[static_cast<std::size_t>(touch.first_row + r)] +=
              std::abs(s.coefficients()[static_cast<std::size_t>(touch.coefficients + e * touch.rows + r)]) *
              std::abs(x[static_cast<std::size_t>(group.first_column + e)]);
        }
      }
    }
  }
  return result;
}

double norm(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum);
}

}  // namespace

VerifiedEquations::VerifiedEquations(const EquilibriumProblem& problem, const BlockStructure& structure,
                                     const AnalyticCentre& centre)
    : structure_(structure),
      centre_(centre),
      widen_(kWiden + 4 * kRoundoff * static_cast<double>(structure.rows() + structure.columns())),
      cholesky_(structure) {
  entry_error_ = entry_rounding(problem, structure);
  load_error_ = load_rounding(problem, structure);
  row_terms_.assign(entry_error_.size(), 0);
  for_each_entry(structure, [&](std::size_t, std::size_t place, double) { row_terms_[place] += 1; });
  is_unlimited_.assign(static_cast<std::size_t>(structure.columns()), false);
  for (const int k : structure.limit().columns) is_unlimited_[static_cast<std::size_t>(k)] = true;
  if (structure.has_limit()) is_unlimited_.back() = true;
  for (std::size_t g = 0; g < structure.groups().size(); ++g)
    group_.insert(group_.end(), static_cast<std::size_t>(structure.groups()[g].columns), g);
  for (const double x : centre.x) squares_.push_back(x * x);
  // Beyond these, squares and the scales that go with them leave the range where rounding is relative.
  const bool is_in_range = std::all_of(centre.x.begin(), centre.x.end(),
                                       [](double x) { return x > kSmallest && x < 1 / kSmallest; });
  if (is_in_range) bound_singular_value();
  bound_strengths();
  cholesky_.factor(squares_);
  centre_shift_ = shift_of(centre.x);
  if (!(centre_shift_ < 1)) sigma_ = 0;
}

void VerifiedEquations::bound_singular_value() {
  // A scale of powers of two that makes the diagonal of S A X² Aᵀ S about 1.
  std::vector<double> diagonal(row_terms_.size(), 0);
  for_each_entry(structure_, [&](std::size_t column, std::size_t place, double entry) {
    diagonal[place] += entry * entry * squares_[column];
  });
  for (const double d : diagonal) scale_.push_back(d > 0 ? std::exp2(-std::round(0.5 * std::log2(d))) : 1);
  if (diagonal.empty()) {
    sigma_ = kInfinity;
    return;
  }
  // The smallest eigenvalue, estimated by inverse iteration from a generic start.
  if (!cholesky_.factor(squares_, scale_)) return;
  std::vector<double> v(diagonal.size());
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = 1 + 0.5 * std::sin(1.7 * static_cast<double>(i));
  double estimate = kInfinity;
  for (int step = 0; step < 12; ++step) {
    const double length = norm(v);
    for (double& entry : v) entry /= length;
    cholesky_.solve(v);
    estimate = std::min(estimate, 1 / norm(v));
  }
  // What rounding can have done to the entries of the matrix: each is a sum over the columns of its row.
  std::vector<double> along(squares_.size(), 0);
  for_each_entry(structure_, [&](std::size_t column, std::size_t place, double entry) {
    along[column] += std::abs(entry) * scale_[place];
  });
  for (std::size_t k = 0; k < along.size(); ++k) along[k] *= squares_[k];
  const std::vector<double> sums = magnitude_product(structure_, along);
  double assembly = 0;
  for (std::size_t i = 0; i < sums.size(); ++i)
    assembly = std::max(assembly, gamma(row_terms_[i] + 9) * sums[i] * scale_[i]);
  double entries = 0;
  for_each_entry(structure_, [&](std::size_t column, std::size_t place, double) {
    const double error = entry_error_[place] * scale_[place] * centre_.x[column];
    entries += error * error;
  });
  for (const double share : {0.8, 0.5, 0.2}) {
    const double shift = share * estimate;
    if (!cholesky_.factor(squares_, scale_, shift)) continue;
    const double square = shift - widen_ * widen_ * (assembly + factor_rounding()) - kTiny;
    sigma_ = square > 0 ? std::max(0.0, std::sqrt(square) / widen_ - widen_ * std::sqrt(entries)) : 0;
    if (sigma_ > 0) break;
  }
}

/// What rounding can have done in the factorisation: L Lᵀ differs from the matrix by at most γ |L| |L|ᵀ entry
/// by entry, γ of the number of terms (Higham, Accuracy and Stability of Numerical Algorithms, theorem 10.3),
/// so in norm by the largest row sum of that.
double VerifiedEquations::factor_rounding() const {
  const std::span<const double> L = cholesky_.values();
  std::vector<double> column_sums(row_terms_.size(), 0), row_sums(row_terms_.size(), 0);
  const auto for_each_value = [&](auto visit) {
    for (int j = 0; j < structure_.nodes(); ++j) {
      const int n = structure_.node_rows(j);
      for (int k = structure_.first_block(j); k < structure_.first_block(j + 1); ++k) {
        const int node = structure_.block_node(k);
        for (int r = 0; r < structure_.node_rows(node); ++r) {
          const int end = node == j ? r + 1 : n;  // the rest of a diagonal block is no part of L
          for (int c = 0; c < end; ++c) {
            visit(static_cast<std::size_t>(structure_.first_row(node) + r),
                  static_cast<std::size_t>(structure_.first_row(j) + c),
                  std::abs(L[static_cast<std::size_t>(structure_.block_value(k) + r * n + c)]));
          }
        }
      }
    }
  };
  for_each_value([&](std::size_t, std::size_t column, double size) { column_sums[column] += size; });
  for_each_value(
      [&](std::size_t row, std::size_t column, double size) { row_sums[row] += size * column_sums[column]; });
  double largest = 0;
  for (int node = 0; node < structure_.nodes(); ++node) {
    for (int i = structure_.first_row(node); i < structure_.first_row(node + 1); ++i) {
      largest =
          std::max(largest, gamma(structure_.row_length(node) + 4) * row_sums[static_cast<std::size_t>(i)]);
    }
  }
  return widen_ * largest;
}

VerifiedEquations::LoadProduct VerifiedEquations::load_product(std::span<const double> y) const {
  const Dot dot = accurate_dot(y, structure_.load());
  double loads = 0;
  for (std::size_t i = 0; i < y.size(); ++i) loads += std::abs(y[i]) * load_error_[i];
  return {dot.value, widen_ * (dot.error + widen_ * loads)};
}

VerifiedEquations::Transposed VerifiedEquations::verified_transposed_product(
    std::span<const double> y) const {
  Transposed result;
  const auto n = static_cast<std::size_t>(structure_.columns());
  result.value.assign(n, 0);
  result.error.assign(n, 0);
  for (const BlockStructure::Group& group : structure_.groups()) {
    int terms = 4;
    for (int t = group.first_touch; t < group.end_touch; ++t)
      terms += structure_.touches()[static_cast<std::size_t>(t)].rows;
    for (int e = 0; e < group.columns; ++e) {
      double sum = 0, magnitude = 0, rounded = 0;
      for (int t = group.first_touch; t < group.end_touch; ++t) {
        const BlockStructure::Touch& touch = structure_.touches()[static_cast<std::size_t>(t)];
        const double* a = structure_.coefficients().data() + touch.coefficients +
                          static_cast<std::ptrdiff_t>(e * touch.rows);
        for (int r = 0; r < touch.rows; ++r) {
          const auto place = static_cast<std::size_t>(touch.first_row + r);
          const double product = a[r] * y[place];
          sum += product;
          magnitude += std::abs(product);
          rounded += entry_error_[place] * std::abs(y[place]);
        }
      }
      const auto k = static_cast<std::size_t>(group.first_column + e);
      result.value[k] = sum;
      const bool rests = magnitude == 0 && rounded == 0;
      result.error[k] = rests ? 0 : widen_ * (kRoundoff * terms * magnitude + widen_ * rounded) + kTiny;
    }
  }
  return result;
}

void VerifiedEquations::bound_strengths() {
  const auto n = static_cast<std::size_t>(structure_.columns());
  strength_.assign(n, kInfinity);
  const std::vector<double> y = bounding_multipliers();
  const LoadProduct load = load_product(y);
  const double total = load.value + load.error;
  const Transposed along = verified_transposed_product(y);
  is_bounded_ = std::isfinite(total);
  for (std::size_t k = 0; k < n; ++k) {
    if (is_unlimited_[k]) continue;
    const double least = along.value[k] - along.error[k];
    if (least > 0) {
      strength_[k] = widen_ * std::max(0.0, total / least);
    } else {
      is_bounded_ = false;
    }
  }
  if (!is_bounded_) std::fill(strength_.begin(), strength_.end(), kInfinity);
}

std::vector<double> VerifiedEquations::bounding_multipliers() const {
  std::vector<double> y = centre_.y;
  if (!structure_.has_limit()) return y;
  for (std::size_t k = 0; k < is_unlimited_.size(); ++k) {
    if (is_unlimited_[k]) stop_motion(k, y);
  }
  return y;
}

bool VerifiedEquations::stop_motion(std::size_t column, std::vector<double>& y) const {
  const BlockStructure::Group& group = structure_.groups()[group_[column]];
  const std::size_t e = column - static_cast<std::size_t>(group.first_column);
  bool stops = false;
  for (int t = group.first_touch; t < group.end_touch; ++t) {
    const BlockStructure::Touch& touch = structure_.touches()[static_cast<std::size_t>(t)];
    for (int r = 0; r < touch.rows; ++r) {
      const std::size_t place = static_cast<std::size_t>(touch.first_row + r);
      const std::size_t entry =
          static_cast<std::size_t>(touch.coefficients + r) + e * static_cast<std::size_t>(touch.rows);
      if (structure_.coefficients()[entry] == 0 || y[place] == 0) continue;
      y[place] = 0;
      stops = true;
    }
  }
  return stops;
}

std::vector<double> VerifiedEquations::repaired(std::span<const double> x) const {
  std::vector<double> result(x.begin(), x.end());
  double residual = kInfinity;
  for (int step = 0; step < 2 && residual > kLargeResidual; ++step) {
    std::vector<double> w = product(structure_, result);
    for (std::size_t i = 0; i < w.size(); ++i) w[i] = structure_.load()[i] - w[i];
    if (structure_.has_limit()) w[static_cast<std::size_t>(structure_.limit_place())] = 0;
    residual = largest_entry(w);
    cholesky_.solve(w);
    const std::vector<double> along = transposed_product(structure_, w);
    for (std::size_t k = 0; k < result.size(); ++k) result[k] += squares_[k] * along[k];
  }
  return result;
}

double VerifiedEquations::shift_of(std::span<const double> x) const {
  if (!(sigma_ > 0)) return kInfinity;
  if (row_terms_.empty()) return 0;
  struct Row {
    double residual = 0, size = 0, strengths = 0;  // b − A x, |b| + |A| |x|, Σ |x|
  };
  std::vector<Row> rows(row_terms_.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i] = {structure_.load()[i], std::abs(structure_.load()[i]), 0};
  for_each_entry(structure_, [&](std::size_t column, std::size_t place, double entry) {
    const double term = entry * x[column];
    rows[place].residual -= term;
    rows[place].size += std::abs(term);
    rows[place].strengths += std::abs(x[column]);
  });
  std::vector<double> residual(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double rounding = gamma(row_terms_[i] + 2) * rows[i].size + entry_error_[i] * rows[i].strengths;
    residual[i] = std::abs(rows[i].residual) + widen_ * rounding + load_error_[i] + kTiny;
  }
  return shift_of_residual(residual);
}

double VerifiedEquations::shift_of_residual(std::span<const double> residual) const {
  if (!(sigma_ > 0)) return kInfinity;
  double sum = 0;
  for (std::size_t i = 0; i < residual.size(); ++i) {
    if (static_cast<int>(i) == structure_.limit_place()) continue;  // the slack, of any sign, makes up for it
    const double scaled = std::max(residual[i] * scale_[i], kSmallestSquared);
    sum += scaled * scaled;
  }
  const double shift = widen_ * std::sqrt(widen_ * sum) / sigma_;
  return std::isnan(shift) ? kInfinity : shift;
}

VerifiedEquations::Transposed VerifiedEquations::reduced_costs(const Objective& objective,
                                                               std::span<const double> y) const {
  Transposed along = verified_transposed_product(y);
  for (const auto& [column, weight] : objective) {
    const auto k = static_cast<std::size_t>(column);
    along.error[k] += widen_ * 4 * kRoundoff * (std::abs(weight) + std::abs(along.value[k]));
    along.value[k] -= weight;
  }
  return along;
}

double VerifiedEquations::lower_bound(const Objective& objective, std::span<const double> y) const {
  if (structure_.has_limit()) {
    // How small h_k is on the edges of a ray, in units of the limit's multiplier, differs: all bounds hold.
    double best = -kInfinity;
    for (const double resting : {0.0, 10.0, 1e3})
      best = std::max(best, lower_bound_beyond_limit(objective, {y.begin(), y.end()}, resting));
    return best;
  }
  const LoadProduct load = load_product(y);
  const Transposed along = reduced_costs(objective, y);
  double excess = 0;
  for (std::size_t k = 0; k < along.value.size(); ++k) {
    const double h = along.value[k] + along.error[k];  // above −h_k
    if (!(h <= 0)) excess += h * strength_[k];
  }
  const double bound = load.value - load.error - widen_ * widen_ * excess;
  return std::isnan(bound) ? -kInfinity : bound;
}

double VerifiedEquations::lower_bound_beyond_limit(const Objective& objective, std::vector<double> y,
                                                   double resting) const {
  double& of_limit = y[static_cast<std::size_t>(structure_.limit_place())];
  const double small = resting * std::abs(of_limit);
  of_limit = 0;
  Transposed along = reduced_costs(objective, y);
  for (std::size_t k = 0; k < is_unlimited_.size(); ++k) {
    if (is_unlimited_[k] && along.value[k] >= -small) stop_motion(k, y);
  }
  for (bool stops = true; stops;) {
    stops = false;
    along = reduced_costs(objective, y);
    for (std::size_t k = 0; k < is_unlimited_.size(); ++k) {
      if (!is_unlimited_[k] || along.value[k] + along.error[k] <= 0) continue;
      if (!stop_motion(k, y)) return -kInfinity;
      stops = true;
    }
  }
  const LoadProduct load = load_product(y);
  double excess = 0;
  for (std::size_t k = 0; k < along.value.size(); ++k) {
    const double h = along.value[k] + along.error[k];
    if (!is_unlimited_[k] && !(h <= 0)) excess += h * strength_[k];
  }
  const double bound = load.value - load.error - widen_ * widen_ * excess;
  return std::isnan(bound) ? -kInfinity : bound;
}

NearestSolution VerifiedEquations::nearest_solution(std::span<const double> x) const {
  const double shift = shift_of(x);
  if (!(shift < kInfinity)) return {kInfinity, 1};
  double share = 0;
  const std::size_t strengths = x.size() - (structure_.has_limit() ? 1 : 0);
  for (std::size_t k = 0; k < strengths; ++k) {
    const double left = x[k] - widen_ * centre_.x[k] * shift;
    if (left < 0) share = std::max(share, -left / (centre_.x[k] * (1 - centre_shift_) - left));
    if (std::isnan(left)) return {kInfinity, 1};
  }
  return {shift, std::min(1.0, widen_ * share)};
}

double VerifiedEquations::upper_bound(const Objective& objective, std::span<const double> x,
                                      const NearestSolution& nearest) const {
  const auto [shift, share] = nearest;
  if (!(shift < kInfinity)) return kInfinity;
  double value = 0, middle = 0, reach = 0, size = 0;
  for (const auto& [column, weight] : objective) {
    const auto k = static_cast<std::size_t>(column);
    value += weight * x[k];
    middle += weight * centre_.x[k];
    reach += std::abs(weight) * centre_.x[k];
    size += std::abs(weight) * (std::abs(x[k]) + centre_.x[k]);
  }
  const double terms = 6 + static_cast<double>(objective.size());
  const double bound = value +
                       widen_ * (share * std::abs(middle - value) + reach * (shift + share * centre_shift_) +
                                 2 * gamma(terms) * size) +
                       kTiny;
  return std::isnan(bound) ? kInfinity : bound;
}

ValueBounds VerifiedEquations::enclose(const Objective& objective, std::span<const double> x,
                                       std::span<const double> y) const {
  return {lower_bound(objective, y), upper_bound(objective, x, nearest_solution(x))};
}

std::vector<double> VerifiedEquations::nearest_multipliers(const Objective& objective) const {
  std::vector<double> x(squares_.size(), 0);
  for (const auto& [column, weight] : objective) {
    const auto k = static_cast<std::size_t>(column);
    x[k] += squares_[k] * weight;
  }
  std::vector<double> y = product(structure_, x);
  cholesky_.solve(y);
  return y;
}

ValueBounds VerifiedEquations::enclose_everywhere(const Objective& objective,
                                                  std::span<const double> y) const {
  Objective opposite = objective;
  for (auto& [column, weight] : opposite) weight = -weight;
  std::vector<double> from_below(y.begin(), y.end()), from_above(y.begin(), y.end());
  multiply_by(from_above, -1);
  if (!structure_.has_limit()) {
    const Transposed along = reduced_costs(objective, y);
    double below = 0, above = 0;
    for (std::size_t k = 0; k < along.value.size(); ++k) {
      below = std::max(below, centre_.x[k] * (along.error[k] + along.value[k]));
      above = std::max(above, centre_.x[k] * (along.error[k] - along.value[k]));
    }
    for (std::size_t i = 0; i < y.size(); ++i) {
      from_below[i] -= kRoomForRounding * below * centre_.y[i];
      from_above[i] -= kRoomForRounding * above * centre_.y[i];
    }
  }
  return {lower_bound(objective, from_below), -lower_bound(opposite, from_above)};
}

}  // namespace indet::barrier
