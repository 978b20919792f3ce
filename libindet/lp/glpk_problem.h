#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "libindet/base/tolerances.h"
struct glp_prob;

namespace indet {

/// GLPK aborted (a failed assertion or out of memory inside it). All its problems on this thread are gone;
/// rebuild them.
class GlpkAborted : public std::runtime_error {
 public:
  GlpkAborted() : std::runtime_error("GLPK aborted") {}
};

/// One linear program in GLPK, indices from 0. The only file pair that includes glpk.h. To be created, used
/// and destroyed on one thread.
///
/// GLPK ends the process when one of its assertions fails. A hook turns that into GlpkAborted; the library's
/// environment on this thread, with all problems in it, is then freed, and is_alive() is false for each of
/// them.
class GlpkProblem {
 public:
  enum class Bound : std::uint8_t { kFree, kLower, kFixed };
  enum class Status : std::uint8_t { kBasic, kNonbasic };
  enum class Simplex : std::uint8_t { kPrimal, kDual };
  enum class Result : std::uint8_t { kOptimal, kInfeasible, kUnbounded, kLimit, kFailed };

  struct Settings {
    Simplex simplex = Simplex::kPrimal;
    double feasibility = tolerance::kLpFeasibility;
    double optimality = tolerance::kLpOptimality;
    int iteration_limit = 0;
    double time_limit = 0;
    bool presolve = false;
    bool keep_factors = false;  ///< start from the factors of the last solve where they are valid
  };
  struct Entry {
    int row, column;
    double value;
  };

  GlpkProblem(int rows, int columns, bool maximise);
  ~GlpkProblem();
  GlpkProblem(const GlpkProblem&) = delete;
  GlpkProblem& operator=(const GlpkProblem&) = delete;

  bool is_alive() const;

  void load(std::span<const Entry> entries);
  void bound_row(int row, Bound bound, double value);
  void bound_column(int column, Bound bound, double value);
  void set_cost(int column, double value);

  void set_row_status(int row, Status status);
  void set_column_status(int column, Status status);
  bool is_row_basic(int row) const;
  bool is_column_basic(int column) const;

  /// GLPK's heuristic start basis, nearly triangular.
  void advanced_basis();
  /// Geometric scaling (skipped if the problem is well scaled), or none.
  void scale(bool on);

  /// Runs the simplex method from the present basis, freshly factorised unless keep_factors is set: the
  /// result then depends on problem and basis alone. Throws GlpkAborted.
  Result solve(const Settings& settings);
  std::int64_t pivots() const;            ///< of the last solve
  double column_value(int column) const;  ///< GLPK's own number, at the basis: a hint
  double objective_value() const;  ///< GLPK's own number, which benchmarks compare with what is recomputed

 private:
  glp_prob* problem_ = nullptr;
  std::int64_t generation_ = 0;
  std::int64_t pivots_ = 0;
};

/// The version of the GLPK that runs, e.g. "5.0".
const char* glpk_version();

}  // namespace indet
