#include "libindet/exact/certificate.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace indet::exact {
namespace {

/// Entries of several columns, by row: columns of the transposed matrix.
std::vector<IntegerColumn> transposed(const std::vector<const IntegerColumn*>& columns, int rows) {
  std::vector<IntegerColumn> result(static_cast<std::size_t>(rows));
  for (std::size_t j = 0; j < columns.size(); ++j) {
    for (std::size_t k = 0; k < columns[j]->row.size(); ++k) {
      IntegerColumn& row = result[static_cast<std::size_t>(columns[j]->row[k])];
      row.row.push_back(static_cast<int>(j));
      row.value.push_back(columns[j]->value[k]);
    }
  }
  return result;
}

IntegerColumn load_column(const ContactProblem& problem) {
  IntegerColumn column;
  for (int row = 0; row < problem.rows(); ++row) {
    if (problem.load()[static_cast<std::size_t>(row)] == 0) continue;
    column.row.push_back(row);
    column.value.push_back(problem.load()[static_cast<std::size_t>(row)]);
  }
  return column;
}

mpz_class dot(const IntegerColumn& column, const std::vector<mpz_class>& vector) {
  mpz_class sum = 0;
  for (std::size_t k = 0; k < column.row.size(); ++k)
    sum += column.value[k] * vector[static_cast<std::size_t>(column.row[k])];
  return sum;
}

std::vector<int> numbers_of(const std::vector<int>& chosen, int size) {
  std::vector<int> number(static_cast<std::size_t>(size), -1);
  for (std::size_t k = 0; k < chosen.size(); ++k)
    number[static_cast<std::size_t>(chosen[k])] = static_cast<int>(k);
  return number;
}

std::vector<const IntegerColumn*> pointers_to(const std::vector<IntegerColumn>& columns) {
  std::vector<const IntegerColumn*> pointers;
  for (const IntegerColumn& column : columns) pointers.push_back(&column);
  return pointers;
}

/// The chosen columns on the rows that have a number.
std::vector<IntegerColumn> part_of(const std::vector<const IntegerColumn*>& columns,
                                   const std::vector<int>& chosen, const std::vector<int>& row_number) {
  std::vector<IntegerColumn> part;
  for (const int j : chosen) {
    const IntegerColumn& column = *columns[static_cast<std::size_t>(j)];
    IntegerColumn kept;
    for (std::size_t k = 0; k < column.row.size(); ++k) {
      const int row = row_number[static_cast<std::size_t>(column.row[k])];
      if (row < 0) continue;
      kept.row.push_back(row);
      kept.value.push_back(column.value[k]);
    }
    part.push_back(std::move(kept));
  }
  return part;
}

/// x with A x = 0 exactly, for the sparse A with these columns, that agrees with the guess in as many entries
/// as A leaves free. Nothing if A leaves none, or if the rank modulo a prime was an accident (the result is
/// multiplied back).
std::optional<RationalVector> kernel_vector(const std::vector<const IntegerColumn*>& columns, int rows,
                                            const std::vector<mpq_class>& guess) {
  const PrimeField field(large_prime(0));
  const ModularLu lu(field, rows, columns);
  const std::vector<int> independent = lu.pivot_columns();
  const std::vector<int> row_number = numbers_of(lu.pivot_rows(), rows);
  const std::vector<int> number = numbers_of(independent, static_cast<int>(columns.size()));
  if (independent.size() == columns.size()) return {};

  mpz_class scale = 1;
  for (std::size_t j = 0; j < columns.size(); ++j) {
    if (number[j] < 0) scale = lcm(scale, guess[j].get_den());
  }
  std::vector<mpz_class> free(columns.size(), 0);
  std::vector<mpz_class> right(independent.size(), 0);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    if (number[j] >= 0) continue;
    free[j] = guess[j].get_num() * (scale / guess[j].get_den());
    for (std::size_t k = 0; k < columns[j]->row.size(); ++k) {
      const int row = row_number[static_cast<std::size_t>(columns[j]->row[k])];
      if (row >= 0) right[static_cast<std::size_t>(row)] -= columns[j]->value[k] * free[j];
    }
  }
  const std::vector<IntegerColumn> square = part_of(columns, independent, row_number);
  const auto solver = RationalSolver::create(pointers_to(square));
  if (!solver) return {};
  const RationalVector solved = solver->solve(right);
  RationalVector x;
  x.denominator = solved.denominator * scale;
  for (std::size_t j = 0; j < columns.size(); ++j) {
    x.numerator.push_back(number[j] >= 0 ? solved.numerator[static_cast<std::size_t>(number[j])]
                                         : mpz_class(free[j] * solved.denominator));
  }
  std::vector<mpz_class> residual(static_cast<std::size_t>(rows), 0);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    for (std::size_t k = 0; k < columns[j]->row.size(); ++k)
      residual[static_cast<std::size_t>(columns[j]->row[k])] += columns[j]->value[k] * x.numerator[j];
  }
  const bool holds = std::all_of(residual.begin(), residual.end(), [](const mpz_class& r) { return r == 0; });
  return holds ? std::optional(std::move(x)) : std::nullopt;
}

/// True if a row is the combination of others whose coefficients are these, modulo the prime, taken for small
/// whole numbers: of two forces that cancel, in a cell, all are 1 or −1.
bool is_whole_combination(const IntegerColumn& row, const std::vector<const IntegerColumn*>& others,
                          const std::vector<std::uint64_t>& coefficients, std::uint64_t prime) {
  constexpr std::uint64_t kSmall = 1U << 20U;
  std::vector<std::pair<int, mpz_class>> left;
  for (std::size_t k = 0; k < row.row.size(); ++k) left.emplace_back(row.row[k], row.value[k]);
  for (std::size_t i = 0; i < others.size(); ++i) {
    const std::uint64_t c = coefficients[i];
    if (c == 0) continue;
    if (c > kSmall && prime - c > kSmall) return false;
    const mpz_class whole = c <= kSmall ? mpz_class(c) : -mpz_class(prime - c);
    for (std::size_t k = 0; k < others[i]->row.size(); ++k)
      left.emplace_back(others[i]->row[k], -whole * others[i]->value[k]);
  }
  std::sort(left.begin(), left.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  mpz_class sum = 0;
  for (std::size_t k = 0; k < left.size(); ++k) {
    sum += left[k].second;
    const bool is_last = k + 1 == left.size() || left[k + 1].first != left[k].first;
    if (is_last && sum != 0) return false;
  }
  return true;
}

/// True if every row that is not among the pivots' is a combination of these, load included if it is given: a
/// motion with this row and independent ones alone, under which every column rests and the load does no work.
/// Which rows take part is found modulo the prime; they are usually few (of a lone disk on a floor, its own).
bool follow_from(const ContactProblem& problem, const std::vector<const IntegerColumn*>& columns,
                 const IntegerColumn* load, const PrimeField& field, const ModularLu& lu,
                 std::size_t most_rows) {
  const std::vector<int> independent = lu.pivot_rows();
  const std::vector<int> number = numbers_of(independent, problem.rows());
  const std::vector<int> pivot_columns = lu.pivot_columns();
  const std::vector<IntegerColumn> square = part_of(columns, pivot_columns, number);
  const ModularLu square_lu(field, lu.rank(), pointers_to(square));
  if (square_lu.rank() != lu.rank()) return false;

  std::vector<const IntegerColumn*> conditions = columns;
  if (load) conditions.push_back(load);
  const std::vector<IntegerColumn> by_row = transposed(conditions, problem.rows());
  std::vector<const IntegerColumn*> others;
  for (const int k : independent) others.push_back(&by_row[static_cast<std::size_t>(k)]);
  const std::vector<int> pivot_number = numbers_of(pivot_columns, static_cast<int>(conditions.size()));
  for (int row = 0; row < problem.rows(); ++row) {
    if (number[static_cast<std::size_t>(row)] >= 0) continue;
    const IntegerColumn& dependent = by_row[static_cast<std::size_t>(row)];
    std::vector<std::uint64_t> right(pivot_columns.size(), 0);
    for (std::size_t k = 0; k < dependent.row.size(); ++k) {
      const int at = pivot_number[static_cast<std::size_t>(dependent.row[k])];
      if (at >= 0) right[static_cast<std::size_t>(at)] = field.reduce(dependent.value[k]);
    }
    const std::vector<std::uint64_t> combination = square_lu.solve_transposed(std::move(right));
    if (is_whole_combination(dependent, others, combination, field.prime())) continue;
    std::vector<const IntegerColumn*> chosen{&dependent};
    for (std::size_t k = 0; k < combination.size(); ++k) {
      if (combination[k] != 0) chosen.push_back(others[k]);
    }
    if (chosen.size() > most_rows) return false;
    // Independent rows alone have a trivial kernel, so any kernel vector has a part in this row.
    const std::vector<mpq_class> one(chosen.size(), 1);
    if (!kernel_vector(chosen, static_cast<int>(conditions.size()), one)) return false;
  }
  return true;
}

/// True if the columns have exactly this rank, and, if the load is given, do not contradict it.
bool has_rank(const ContactProblem& problem, const std::vector<const IntegerColumn*>& columns,
              const IntegerColumn* load, int rank, std::size_t most_rows) {
  const PrimeField field(large_prime(0));
  const ModularLu lu(field, problem.rows(), columns);
  if (lu.rank() != rank) return false;
  return rank == problem.rows() || follow_from(problem, columns, load, field, lu, most_rows);
}

std::vector<bool> open_after(const ContactProblem& problem, std::span<const Closing> closings) {
  std::vector<bool> open(static_cast<std::size_t>(problem.edges()), false);
  for (int e = 0; e < problem.edges(); ++e) open[static_cast<std::size_t>(e)] = problem.has_edge(e);
  for (const Closing& closing : closings) {
    for (const int e : closing.edges) open[static_cast<std::size_t>(e)] = false;
  }
  return open;
}

}  // namespace

std::optional<Motion> Motion::repair(const ContactProblem& problem, std::span<const int> still,
                                     bool against_load, std::span<const double> guess) {
  const IntegerColumn load = load_column(problem);
  std::vector<const IntegerColumn*> conditions;
  for (const int e : still) conditions.push_back(&problem.edge(e));
  if (!against_load) conditions.push_back(&load);
  const std::vector<IntegerColumn> by_row = transposed(conditions, problem.rows());
  std::vector<const IntegerColumn*> columns;
  for (const IntegerColumn& column : by_row) columns.push_back(&column);
  std::vector<mpq_class> exact_guess;
  for (const double value : guess) exact_guess.emplace_back(value);
  auto velocity = kernel_vector(columns, static_cast<int>(conditions.size()), exact_guess);
  if (!velocity) return {};
  return Motion(problem, std::move(*velocity));
}

int Motion::edge_power(int edge) const { return sgn(dot(problem_->edge(edge), velocity_.numerator)); }

int Motion::load_power() const { return -sgn(dot(load_column(*problem_), velocity_.numerator)); }

void Motion::open(std::span<const int> edges, const Motion& other) {
  mpq_class most = 0;
  for (const int e : edges) {
    const mpq_class resisted(-dot(problem_->edge(e), velocity_.numerator), velocity_.denominator);
    const mpq_class opened(dot(problem_->edge(e), other.velocity_.numerator), other.velocity_.denominator);
    most = std::max(most, mpq_class(resisted / opened));
  }
  if (most == 0) return;
  most.canonicalize();
  // v + most u over the product of all denominators
  const mpz_class own = other.velocity_.denominator * most.get_den();
  const mpz_class added = velocity_.denominator * most.get_num();
  for (std::size_t i = 0; i < velocity_.numerator.size(); ++i)
    velocity_.numerator[i] = own * velocity_.numerator[i] + added * other.velocity_.numerator[i];
  velocity_.denominator *= own;
}

std::vector<double> Motion::rounded() const {
  mpz_class largest = 1;
  for (const mpz_class& velocity : velocity_.numerator) largest = std::max(largest, mpz_class(abs(velocity)));
  std::vector<double> result;
  for (const mpz_class& velocity : velocity_.numerator) {
    mpq_class share(velocity, largest);
    share.canonicalize();
    result.push_back(share.get_d());
  }
  return result;
}

namespace {

/// The motion nearest to the guess in which these edges rest, if the load does work under it and no open edge
/// resists.
std::optional<Motion> held_motion(const ContactProblem& problem, std::span<const double> guess,
                                  const std::vector<bool>& open, std::span<const int> still) {
  auto motion = Motion::repair(problem, still, true, guess);
  if (!motion || motion->load_power() <= 0) return {};
  for (int e = 0; e < problem.edges(); ++e) {
    if (open[static_cast<std::size_t>(e)] && motion->edge_power(e) < 0) return {};
  }
  return motion;
}

/// The same with edges held still whose power in the guess is up to `zero`: all of them, or, where velocities
/// and friction coefficients are so far apart that some of these powers are none of rounding, those below a
/// gap.
std::optional<Motion> falling_motion(const ContactProblem& problem, std::span<const double> guess,
                                     const std::vector<bool>& open, double zero) {
  constexpr double kGap = 4;
  constexpr int kMostGaps = 16;
  std::vector<std::pair<double, int>> small;
  for (int e = 0; e < problem.edges(); ++e) {
    if (!open[static_cast<std::size_t>(e)]) continue;
    const IntegerColumn& column = problem.edge(e);
    double power = 0;
    for (std::size_t k = 0; k < column.row.size(); ++k)
      power += std::ldexp(column.value[k].get_d(), static_cast<int>(-column.shift)) *
               guess[static_cast<std::size_t>(column.row[k])];
    const double mu = problem.is_slack(e) ? 0 : problem.mu(e / 2).get_d();
    const double size = std::abs(power) / std::max(1.0, mu);
    if (size <= zero) small.emplace_back(size, e);
  }
  std::sort(small.begin(), small.end());
  std::vector<int> still;
  for (const auto& [size, e] : small) still.push_back(e);
  if (auto motion = held_motion(problem, guess, open, still)) return motion;
  int gaps = 0;
  for (std::size_t held = small.size(); held-- > 0 && gaps < kMostGaps;) {
    if (held > 0 && small[held].first <= kGap * small[held - 1].first) continue;
    ++gaps;
    if (auto motion = held_motion(problem, guess, open, std::span(still).first(held))) return motion;
  }
  return {};
}

std::vector<int> numbers_of_true(const std::vector<bool>& chosen) {
  std::vector<int> numbers;
  for (std::size_t e = 0; e < chosen.size(); ++e) {
    if (chosen[e]) numbers.push_back(static_cast<int>(e));
  }
  return numbers;
}

/// Under which the edges of the closing open, the load does no work, and all that stay open rest.
std::optional<Motion> closing_motion(const ContactProblem& problem, const Closing& closing,
                                     const std::vector<bool>& open_after_it) {
  auto motion = Motion::repair(problem, numbers_of_true(open_after_it), false, closing.motion);
  const bool opens = motion && std::all_of(closing.edges.begin(), closing.edges.end(),
                                           [&](int e) { return motion->edge_power(e) > 0; });
  return opens ? std::move(motion) : std::nullopt;
}

}  // namespace

bool proves_emptiness(const ContactProblem& problem, std::span<const double> guess, double zero) {
  return falling_motion(problem, guess, open_after(problem, {}), zero).has_value();
}

std::optional<std::vector<double>> find_falling_motion(const ContactProblem& problem,
                                                       std::span<const double> guess,
                                                       std::span<const Closing> closings, double zero) {
  double largest = 0;
  for (const double velocity : guess) largest = std::max(largest, std::abs(velocity));
  std::vector<double> clean(guess.begin(), guess.end());
  for (double& velocity : clean) {
    if (std::abs(velocity) <= zero * largest) velocity = 0;
  }
  const std::vector<bool> open = open_after(problem, closings);
  std::optional<Motion> motion = falling_motion(problem, clean, open, zero);
  if (!motion) motion = falling_motion(problem, guess, open, zero);
  for (std::size_t left = closings.size(); motion && left > 0; --left) {
    const Closing& closing = closings[left - 1];
    const auto opening = closing_motion(problem, closing, open_after(problem, closings.first(left)));
    if (!opening) return {};
    motion->open(closing.edges, *opening);
  }
  if (!motion) return {};
  std::vector<double> rounded = motion->rounded();
  return proves_emptiness(problem, rounded, zero) ? std::optional(std::move(rounded)) : std::nullopt;
}

bool proves_structure(const ContactProblem& problem, std::span<const Closing> closings,
                      std::optional<int> final_rank, std::size_t most_rows) {
  for (std::size_t n = 1; n <= closings.size(); ++n) {
    if (!closing_motion(problem, closings[n - 1], open_after(problem, closings.first(n)))) return false;
  }
  if (!final_rank) return true;
  // Rank: `final_rank` rows are independent modulo a prime, hence independent; each of the others needs a
  // motion, with this row and independent ones alone, under which every open edge rests and the load does no
  // work.
  std::vector<const IntegerColumn*> columns;
  for (const int e : numbers_of_true(open_after(problem, closings))) columns.push_back(&problem.edge(e));
  const IntegerColumn load = load_column(problem);
  return has_rank(problem, columns, &load, *final_rank, most_rows);
}

bool proves_rank(const ContactProblem& problem) {
  std::vector<const IntegerColumn*> columns;
  for (const int e : problem.open_edges()) columns.push_back(&problem.edge(e));
  return has_rank(problem, columns, nullptr, problem.rank(), std::numeric_limits<std::size_t>::max());
}

}  // namespace indet::exact
