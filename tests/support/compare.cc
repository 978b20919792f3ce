#include "tests/support/compare.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "libindet/base/tolerances.h"
#include "libindet/range/result_fields.h"
#include "tests/support/oracle.h"

namespace indet::test {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

/// One field as bytes.
struct FieldBytes {
  std::string name;
  Eigen::Index rows = 1, columns = 1;
  std::string bytes;
};

std::vector<FieldBytes> bytes_of(const ForceRanges& ranges) {
  std::vector<FieldBytes> all;
  const auto add = [](FieldBytes& field, const auto* data, Eigen::Index count) {
    field.bytes.append(reinterpret_cast<const char*>(data), sizeof(*data) * static_cast<std::size_t>(count));
  };
  visit_fields(ranges, [&]<class Value>(const Field& field, const Value& value) {
    FieldBytes& bytes = all.emplace_back(std::string(field.group) + "/" + field.name);
    if constexpr (requires { value.rows(); }) {
      bytes.rows = value.rows();
      bytes.columns = value.cols();
      const auto& plain = value.eval();
      add(bytes, plain.data(), plain.size());
    } else if constexpr (requires { value.data(); }) {
      add(bytes, value.data(), static_cast<Eigen::Index>(value.size()));
    } else if constexpr (requires { std::get<2>(value); }) {
      std::apply([&](const auto&... numbers) { (add(bytes, &numbers, 1), ...); }, value);
    } else {
      add(bytes, &value, 1);
    }
  });
  return all;
}

/// How entries of a field read where they are compared within a tolerance: forces in units of mg.
Eigen::MatrixXd numbers_of(const Field& field, const auto& value, double force_unit) {
  const double unit = std::string_view(field.unit).starts_with("force") ? force_unit : 1;
  if constexpr (requires { value.rows(); }) {
    return value.template cast<double>().matrix() / unit;
  } else if constexpr (requires { value.data(); }) {
    return {};  // text: only of how a result was found
  } else if constexpr (requires { std::get<2>(value); }) {
    return std::apply([](const auto&... numbers) -> Eigen::MatrixXd { return Eigen::Vector3d(numbers...); },
                      value);
  } else {
    return Eigen::MatrixXd::Constant(1, 1, static_cast<double>(value) / unit);
  }
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

namespace {

bool same_solver_states(const std::optional<SolverStates>& a, const std::optional<SolverStates>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  const auto same = [](const auto& first, const auto& second) {
    return first.rows() == second.rows() && first.cols() == second.cols() &&
           (first.array() == second.array()).all();
  };
  return same(a->states, b->states) && same(a->vertex, b->vertex);
}

}  // namespace

AssertionResult same_bytes(const ForceRanges& a, const ForceRanges& b) {
  const std::vector<FieldBytes> first = bytes_of(a);
  const std::vector<FieldBytes> second = bytes_of(b);
  for (std::size_t k = 0; k < first.size(); ++k) {
    const FieldBytes& x = first[k];
    const FieldBytes& y = second[k];
    if (x.rows != y.rows || x.columns != y.columns || x.bytes.size() != y.bytes.size())
      return AssertionFailure() << x.name << " differs in size";
    const auto [here, there] = std::mismatch(x.bytes.begin(), x.bytes.end(), y.bytes.begin());
    if (here != x.bytes.end())
      return AssertionFailure() << x.name << " (" << x.rows << " × " << x.columns << ") differs at byte "
                                << here - x.bytes.begin() << " of " << x.bytes.size();
  }
  if (!same_solver_states(a.solver_states, b.solver_states))
    return AssertionFailure() << "the solver's states differ";
  return AssertionSuccess();
}

namespace {

/// Fields that are the same whatever state is taken.
AssertionResult same_answers(const ForceRanges& a, const ForceRanges& b, double tolerance) {
  std::vector<Eigen::MatrixXd> expected;
  const auto is_compared = [](const Field& field) {
    return field.source == FieldSource::kProblem || field.source == FieldSource::kAnswer;
  };
  visit_fields(a, [&](const Field& field, const auto& value) {
    if (is_compared(field)) expected.push_back(numbers_of(field, value, a.force_unit));
  });
  AssertionResult result = AssertionSuccess();
  std::size_t next = 0;
  visit_fields(b, [&](const Field& field, const auto& value) {
    if (!is_compared(field)) return;
    const Eigen::MatrixXd found = numbers_of(field, value, b.force_unit);
    const auto same = same_entries(expected[next++], found, tolerance);
    if (result && !same) result = AssertionFailure() << same.message() << " in " << field.name;
  });
  return result;
}

/// Enclosures of the same value overlap, whatever their widths.
AssertionResult overlapping_enclosures(const ForceRanges& a, const ForceRanges& b, double tolerance) {
  for (Eigen::Index i = 0; i < a.lower.rows(); ++i) {
    for (Eigen::Index j = 0; j < 4; ++j) {
      const double low = std::max(a.lower(i, j) / a.force_unit, b.lower(i, j) / b.force_unit);
      const double high = std::min(a.upper(i, j) / a.force_unit, b.upper(i, j) / b.force_unit);
      if (std::isnan(a.lower(i, j)) != std::isnan(b.lower(i, j)) ||
          low > high + tolerance * std::max(1.0, std::abs(high)))
        return AssertionFailure() << "the enclosures of contact " << i << ", "
                                  << to_string(static_cast<Column>(j)) << " do not overlap: " << low
                                  << " above " << high;
    }
  }
  const auto scaled = [](const auto& table, const ForceRanges& r) { return (table / r.force_unit).eval(); };
  const auto low = scaled(a.reactions.lower, a).max(scaled(b.reactions.lower, b)).eval();
  const auto high = scaled(a.reactions.upper, a).min(scaled(b.reactions.upper, b)).eval();
  for (Eigen::Index k = 0; k < low.size(); ++k) {
    if (low.data()[k] > high.data()[k] + tolerance * std::max(1.0, std::abs(high.data()[k])))
      return AssertionFailure() << "the enclosures of reaction " << k / 2 << " do not overlap";
  }
  for (Eigen::Index i = 0; i < std::min(a.smallest.lower.rows(), b.smallest.lower.rows()); ++i) {
    for (const int component : {0, 1}) {
      const double least = std::max(a.smallest.lower(i, component), b.smallest.lower(i, component));
      const double most = std::min(a.smallest.of(component)[i], b.smallest.of(component)[i]);
      // Distances are those of states that are a little off the extremes.
      if (least > most + indet::tolerance::kDistanceGap * std::max(1.0, most))
        return AssertionFailure() << "the smallest distances of contact " << i << " do not overlap";
    }
  }
  return AssertionSuccess();
}

/// The states that attain the values; `view` makes of a state what is compared.
template <class View>
AssertionResult same_states(const ForceRanges& a, const ForceRanges& b, double tolerance, View view) {
  for (Eigen::Index i = 0; i < a.vertex.rows(); ++i) {
    for (Eigen::Index j = 0; j < 4; ++j) {
      const auto where = [&] {
        return " of contact " + std::to_string(i) + ", " + to_string(static_cast<Column>(j));
      };
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

/// What is measured on the states.
AssertionResult same_state_measures(const ForceRanges& a, const ForceRanges& b, double tolerance) {
  if (auto same = same_entries(a.d_R, b.d_R, tolerance); !same) return same << " in d_R";
  if (auto same = same_entries(a.d_T, b.d_T, tolerance); !same) return same << " in d_T";
  const auto norms = [](const ForceRanges& r) {  // by objective, as the order of the states is arbitrary
    Eigen::MatrixXd norm = Eigen::MatrixXd::Constant(r.vertex.rows() + 1, 4, -1);
    for (Eigen::Index i = 0; i < r.vertex.rows(); ++i) {
      for (Eigen::Index j = 0; j < 4; ++j) {
        if (r.vertex(i, j) >= 0) norm(i, j) = r.norm[r.vertex(i, j)] / r.force_unit;
      }
    }
    if (r.largest_norm >= 0) norm(r.vertex.rows(), 0) = r.norm[r.largest_norm] / r.force_unit;
    return norm;
  };
  if (auto same = same_entries(norms(a), norms(b), tolerance); !same) return same << " in norm";
  return AssertionSuccess();
}

}  // namespace

AssertionResult same_ranges(const ForceRanges& a, const ForceRanges& b, double tolerance) {
  if (auto same = same_answers(a, b, tolerance); !same) return same;
  if (auto same = overlapping_enclosures(a, b, tolerance); !same) return same;
  return same_extremal_states(a, b, tolerance);
}

AssertionResult same_extremal_states(const ForceRanges& a, const ForceRanges& b, double tolerance) {
  const auto whole = [](const Eigen::RowVectorXd& state) { return state; };
  if (auto same = same_states(a, b, tolerance, whole); !same) return same;
  return same_state_measures(a, b, tolerance);
}

AssertionResult same_ranges_and_weights(const ForceRanges& a, const ForceRanges& b, double tolerance) {
  if (auto same = same_answers(a, b, tolerance); !same) return same;
  if (auto same = overlapping_enclosures(a, b, tolerance); !same) return same;
  return same_states(a, b, tolerance, [](const Eigen::RowVectorXd& state) {
    return Eigen::RowVectorXd::Constant(1, state(Eigen::seq(0, Eigen::last, 2)).sum());
  });
}

ForceRanges permuted(const ForceRanges& ranges, const std::vector<int>& contacts) {
  ForceRanges result = ranges;
  visit_fields(result, [&]<class Value>(const Field& field, Value&& value) {
    if constexpr (requires { value.rows(); }) {
      const typename std::decay_t<Value>::PlainObject before = value;
      for (std::size_t k = 0; k < contacts.size() && before.size() > 0; ++k) {
        const auto to = static_cast<Eigen::Index>(k);
        const Eigen::Index from = contacts[k];
        if (field.rows == Extent::kContacts) value.row(to) = before.row(from);
        if (field.columns == Extent::kForces) value.middleCols(2 * to, 2) = before.middleCols(2 * from, 2);
      }
    }
  });
  return result;
}

namespace {

/// A real number or a table of them.
template <class Value>
constexpr bool has_reals() {
  using Plain = std::decay_t<Value>;
  if constexpr (requires { typename Plain::PlainObject; })
    return std::is_same_v<typename Plain::Scalar, double>;
  return std::is_same_v<Plain, double>;
}

}  // namespace

ForceRanges rescaled(const ForceRanges& ranges, double force) {
  ForceRanges result = ranges;
  visit_fields(result, [&]<class Value>(const Field& field, Value&& value) {
    if constexpr (has_reals<Value>()) {
      if (std::string_view(field.unit).starts_with("force")) value *= force;
    }
  });
  return result;
}

ForceRanges mirrored(const ForceRanges& ranges) {
  ForceRanges result = ranges;
  visit_fields(result, [&]<class Value>(const Field& field, Value&& value) {
    if constexpr (requires { value.cols(); }) {
      if (field.columns == Extent::kColumns) value.col(kMinT).swap(value.col(kMaxT));
      if constexpr (has_reals<Value>()) {
        for (Eigen::Index k = 1; k < value.cols() && field.columns == Extent::kForces; k += 2)
          value.col(k) *= -1;
      }
    }
  });
  if (result.centre.rows() > 0) result.centre.col(1) *= -1;
  result.value.col(kMinT).swap(result.value.col(kMaxT));
  result.lower.rightCols<2>().swap(result.upper.rightCols<2>());
  for (auto* table : {&result.value, &result.lower, &result.upper}) table->rightCols<2>() *= -1;
  result.T_star = 1 - result.T_star.array();
  // ΣT of a wall, and x and torque of a disk.
  Reactions& r = result.reactions;
  for (Eigen::Index k = 0; k < r.count(); ++k) {
    if ((r.component[k] == 1) != (r.body[k] < 0)) continue;
    for (auto* table : {&r.value, &r.lower, &r.upper}) {
      table->row(k).reverseInPlace();
      table->row(k) *= -1;
    }
    r.lower.row(k).swap(r.upper.row(k));
    r.outcome.row(k).reverseInPlace();
    r.vertex.row(k).reverseInPlace();
    r.ray.row(k).reverseInPlace();
  }
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
