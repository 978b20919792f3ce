#include "tests/support/compare.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "tests/support/oracle.h"

namespace indet::test {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

template <class Matrix>
AssertionResult same_bits(const char* name, const Matrix& a, const Matrix& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) return AssertionFailure() << name << " differs in size";
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    for (Eigen::Index j = 0; j < a.cols(); ++j) {
      bool same = a(i, j) == b(i, j);
      if constexpr (std::is_same_v<typename Matrix::Scalar, double>)
        same = std::bit_cast<std::uint64_t>(a(i, j)) == std::bit_cast<std::uint64_t>(b(i, j));
      if (!same) return AssertionFailure() << name << " differs at (" << i << ", " << j << ")";
    }
  }
  return AssertionSuccess();
}

AssertionResult same_numbers(const char* name, const std::vector<double>& a, const std::vector<double>& b) {
  return same_bits(name, Eigen::VectorXd(Eigen::VectorXd::Map(a.data(), static_cast<Eigen::Index>(a.size()))),
                   Eigen::VectorXd(Eigen::VectorXd::Map(b.data(), static_cast<Eigen::Index>(b.size()))));
}

}  // namespace

bool near(double a, double b, double tolerance) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  if (std::isinf(a) || std::isinf(b)) return a == b;
  return std::abs(a - b) <= tolerance * std::max(1.0, std::abs(a));
}

AssertionResult same_entries(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double tolerance) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) {
    return AssertionFailure() << a.rows() << " × " << a.cols() << " against " << b.rows() << " × "
                              << b.cols();
  }
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    for (Eigen::Index j = 0; j < a.cols(); ++j) {
      if (!near(a(i, j), b(i, j), tolerance)) {
        return AssertionFailure() << "(" << i << ", " << j << "): " << testing::PrintToString(a(i, j))
                                  << " against " << testing::PrintToString(b(i, j)) << ", apart "
                                  << a(i, j) - b(i, j);
      }
    }
  }
  return AssertionSuccess();
}

AssertionResult same_bytes(const ForceRanges& a, const ForceRanges& b) {
  const auto scalars = [](const ForceRanges& r) {
    std::vector<double> all = {r.rank_gap,   r.smallest_accepted,     r.largest_rejected,   r.residual,
                               r.force_unit, r.worst_primal_residual, r.worst_dual_residual};
    for (const std::int64_t count :
         {static_cast<std::int64_t>(r.status), std::int64_t{r.unknowns}, std::int64_t{r.equations},
          std::int64_t{r.rank}, std::int64_t{r.nullity}, std::int64_t{r.dim}, std::int64_t{r.blocks},
          std::int64_t{r.rank_ambiguous}, std::int64_t{r.sliding}, std::int64_t{r.non_transmitting},
          std::int64_t{r.largest_norm}, r.objectives, r.solves, r.pivots, r.determined, r.certified,
          r.imprecise, r.failed, r.unbounded})
      all.push_back(static_cast<double>(count));
    return all;
  };
  if (a.formulation != b.formulation) return AssertionFailure() << "another formulation";
  for (const AssertionResult& result : {same_numbers("a scalar", scalars(a), scalars(b)),
                                        same_bits("value", a.value, b.value),
                                        same_bits("lower", a.lower, b.lower),
                                        same_bits("upper", a.upper, b.upper),
                                        same_bits("outcome", a.outcome, b.outcome),
                                        same_bits("primal_residual", a.primal_residual, b.primal_residual),
                                        same_bits("dual_residual", a.dual_residual, b.dual_residual),
                                        same_bits("sensitivity", a.sensitivity, b.sensitivity),
                                        same_bits("unique", a.unique, b.unique),
                                        same_bits("vertex", a.vertex, b.vertex),
                                        same_bits("delta_R", a.delta_R, b.delta_R),
                                        same_bits("delta_T", a.delta_T, b.delta_T),
                                        same_bits("d_R", a.d_R, b.d_R),
                                        same_bits("d_T", a.d_T, b.d_T),
                                        same_bits("R_star", a.R_star, b.R_star),
                                        same_bits("T_star", a.T_star, b.T_star),
                                        same_bits("states", a.states, b.states),
                                        same_bits("norm", a.norm, b.norm),
                                        same_bits("active", a.active, b.active),
                                        same_bits("ray", a.ray, b.ray),
                                        same_bits("rays", a.rays, b.rays),
                                        same_bits("motion", a.motion, b.motion)}) {
    if (!result) return result;
  }
  return AssertionSuccess();
}

namespace {

/// `view` makes of a state what is compared.
template <class View>
AssertionResult same_ranges_by(const ForceRanges& a, const ForceRanges& b, double tolerance, View view) {
  if (a.status != b.status)
    return AssertionFailure() << to_string(a.status) << " against " << to_string(b.status);
  if (a.dim != b.dim) return AssertionFailure() << "dim " << a.dim << " against " << b.dim;
  if (a.nullity != b.nullity)
    return AssertionFailure() << "nullity " << a.nullity << " against " << b.nullity;
  if (a.outcome.rows() != b.outcome.rows()) return AssertionFailure() << "other numbers of contacts";
  const auto in_units = [](const ForceRanges& r) { return Eigen::MatrixXd(r.value.matrix() / r.force_unit); };
  if (auto result = same_entries(in_units(a), in_units(b), tolerance); !result) return result << " in value";
  for (Eigen::Index i = 0; i < a.outcome.rows(); ++i) {
    for (Eigen::Index j = 0; j < 4; ++j) {
      const auto where = [&] {
        return " of contact " + std::to_string(i) + ", " + to_string(static_cast<Column>(j));
      };
      if (a.outcome(i, j) != b.outcome(i, j)) return AssertionFailure() << "outcome" << where();
      if (a.unique(i, j) != b.unique(i, j)) return AssertionFailure() << "unique" << where();
      const int first = a.vertex(i, j);
      const int second = b.vertex(i, j);
      if ((first < 0) != (second < 0)) return AssertionFailure() << "a state is missing" << where();
      if (first < 0) continue;
      const auto result = same_entries(view(a.states.row(first) / a.force_unit),
                                       view(b.states.row(second) / b.force_unit), tolerance);
      if (!result) return AssertionFailure() << result.message() << " in the state" << where();
    }
  }
  return AssertionSuccess();
}

}  // namespace

AssertionResult same_ranges(const ForceRanges& a, const ForceRanges& b, double tolerance) {
  return same_ranges_by(a, b, tolerance, [](const Eigen::RowVectorXd& state) { return state; });
}

AssertionResult same_ranges_and_weights(const ForceRanges& a, const ForceRanges& b, double tolerance) {
  return same_ranges_by(a, b, tolerance, [](const Eigen::RowVectorXd& state) {
    return Eigen::RowVectorXd::Constant(1, state(Eigen::seq(0, Eigen::last, 2)).sum());
  });
}

ForceRanges permuted(const ForceRanges& ranges, const std::vector<int>& contacts) {
  ForceRanges result = ranges;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto to = static_cast<Eigen::Index>(k);
    const Eigen::Index from = contacts[k];
    result.value.row(to) = ranges.value.row(from);
    result.outcome.row(to) = ranges.outcome.row(from);
    result.unique.row(to) = ranges.unique.row(from);
    result.vertex.row(to) = ranges.vertex.row(from);
    if (ranges.states.size() > 0) result.states.middleCols(2 * to, 2) = ranges.states.middleCols(2 * from, 2);
  }
  return result;
}

ForceRanges rescaled(const ForceRanges& ranges, double force) {
  ForceRanges result = ranges;
  result.force_unit *= force;
  result.residual = ranges.residual;
  for (auto* table : {&result.value, &result.lower, &result.upper, &result.sensitivity}) *table *= force;
  result.states *= force;
  result.norm *= force;
  return result;
}

ForceRanges mirrored(const ForceRanges& ranges) {
  ForceRanges result = ranges;
  const auto swap = [](auto& table) { table.col(kMinT).swap(table.col(kMaxT)); };
  swap(result.value);
  swap(result.outcome);
  swap(result.unique);
  swap(result.vertex);
  result.value.rightCols<2>() *= -1;
  for (Eigen::Index k = 1; k < result.states.cols(); k += 2) result.states.col(k) *= -1;
  return result;
}

AssertionResult is_falling_motion(const Packing& packing, const Eigen::MatrixXd& motion, double tolerance) {
  if (motion.rows() != packing.disk_count() || motion.cols() != 3) return AssertionFailure() << "no motion";
  const double largest = motion.cwiseAbs().maxCoeff();
  if (std::abs(largest - 1) > 1e-12) return AssertionFailure() << "the largest entry is " << largest;
  // Stored as (x, y, rω): divide by r for the torque rows of the paper's matrix.
  Eigen::VectorXd velocity(3 * packing.disk_count());
  for (int i = 0; i < packing.disk_count(); ++i) {
    velocity.segment<3>(3 * i) = motion.row(i).transpose();
    velocity[3 * i + 2] /= packing[DiskId(i)].radius;
  }
  const double work = velocity.dot(oracle::paper_wrench(packing));
  if (!(work > tolerance)) return AssertionFailure() << "the load does work " << work;
  const Eigen::VectorXd rates = oracle::paper_matrix(packing).transpose() * velocity;
  for (int k = 0; k < packing.contact_count(); ++k) {
    const double resisted = rates[2 * k] - packing[ContactId(k)].mu * std::abs(rates[2 * k + 1]);
    if (resisted < -tolerance) return AssertionFailure() << "contact " << k << " resists by " << -resisted;
  }
  return AssertionSuccess();
}

AssertionResult is_recession_ray(const Packing& packing, const Eigen::VectorXd& ray, double tolerance) {
  if (ray.size() != 2 * packing.contact_count()) return AssertionFailure() << "no ray";
  const double size = ray.size() > 0 ? ray.lpNorm<Eigen::Infinity>() : 0;
  if (!(size > 0)) return AssertionFailure() << "the ray is zero";
  const double balance = (oracle::paper_matrix(packing) * ray).lpNorm<Eigen::Infinity>() / size;
  if (balance > tolerance) return AssertionFailure() << "not in the kernel: " << balance;
  for (int k = 0; k < packing.contact_count(); ++k) {
    const double margin = packing[ContactId(k)].mu * ray[2 * k] - std::abs(ray[2 * k + 1]);
    if (std::min(ray[2 * k], margin) < -tolerance * size)
      return AssertionFailure() << "contact " << k << " leaves its cone by " << -std::min(ray[2 * k], margin);
  }
  return AssertionSuccess();
}

AssertionResult has_rays_where_infinite(const Packing& packing, const ForceRanges& ranges, double tolerance) {
  for (Eigen::Index i = 0; i < ranges.value.rows(); ++i) {
    for (Eigen::Index j = 0; j < 4; ++j) {
      const int row = ranges.ray(i, j);
      const bool infinite = std::isinf(ranges.value(i, j));
      if (infinite != (row >= 0) || row >= ranges.rays.rows())
        return AssertionFailure() << "contact " << i << ", column " << j << ": value " << ranges.value(i, j)
                                  << ", ray " << row;
      if (!infinite) continue;
      const Eigen::VectorXd ray = ranges.rays.row(row).transpose();
      if (auto result = is_recession_ray(packing, ray, tolerance); !result) return result;
      if (!(ray[2 * i + (j >= kMinT ? 1 : 0)] * ranges.value(i, j) > 0))
        return AssertionFailure() << "contact " << i << ", column " << j << " does not grow along its ray";
    }
  }
  return AssertionSuccess();
}

}  // namespace indet::test
