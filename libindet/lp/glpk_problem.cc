#include "libindet/lp/glpk_problem.h"

#include <glpk.h>

#include <algorithm>
#include <csetjmp>
#include <limits>

namespace indet {
namespace {

/// GLPK's memory of this thread, freed when the thread ends.
struct Environment {
  /// Counts how often it was freed; problems of an earlier generation no longer exist.
  std::int64_t generation = 0;

  void free() {
    glp_free_env();
    ++generation;
  }
  ~Environment() { free(); }
};
thread_local Environment environment;

// longjmp must not skip a destructor, so the functions between setjmp and GLPK hold trivial objects only.
void jump_back(void* where) { std::longjmp(*static_cast<std::jmp_buf*>(where), 1); }  // NOLINT

template <class Call>
bool guarded(Call call) {
  std::jmp_buf where;
  if (setjmp(where) != 0) {  // NOLINT
    environment.free();
    return false;
  }
  glp_error_hook(jump_back, &where);
  call();
  glp_error_hook(nullptr, nullptr);
  return true;
}

template <class Call>
void call_glpk(Call call) {
  if (!guarded(call)) throw GlpkAborted();
}

int to_glpk(GlpkProblem::Bound bound) {
  switch (bound) {
    case GlpkProblem::Bound::kFree:
      return GLP_FR;
    case GlpkProblem::Bound::kLower:
      return GLP_LO;
    case GlpkProblem::Bound::kFixed:
      return GLP_FX;
  }
  return GLP_FR;
}

int nonbasic_status(int type) {
  if (type == GLP_FR) return GLP_NF;
  return type == GLP_FX ? GLP_NS : GLP_NL;
}

}  // namespace

GlpkProblem::GlpkProblem(int rows, int columns, bool maximise) {
  call_glpk([&] {
    glp_term_out(GLP_OFF);
    problem_ = glp_create_prob();
    if (rows > 0) glp_add_rows(problem_, rows);
    if (columns > 0) glp_add_cols(problem_, columns);
    glp_set_obj_dir(problem_, maximise ? GLP_MAX : GLP_MIN);
  });
  generation_ = environment.generation;
}

GlpkProblem::~GlpkProblem() {
  if (is_alive()) static_cast<void>(guarded([this] { glp_delete_prob(problem_); }));
}

bool GlpkProblem::is_alive() const { return problem_ != nullptr && generation_ == environment.generation; }

void GlpkProblem::load(std::span<const Entry> entries) {
  const std::size_t count = entries.size();
  std::vector<int> rows(count + 1);
  std::vector<int> columns(count + 1);
  std::vector<double> values(count + 1);
  for (std::size_t i = 0; i < count; ++i) {
    rows[i + 1] = entries[i].row + 1;
    columns[i + 1] = entries[i].column + 1;
    values[i + 1] = entries[i].value;
  }
  call_glpk([&] {
    glp_load_matrix(problem_, static_cast<int>(count), rows.data(), columns.data(), values.data());
  });
}

void GlpkProblem::bound_row(int row, Bound bound, double value) {
  glp_set_row_bnds(problem_, row + 1, to_glpk(bound), value, value);
}

void GlpkProblem::bound_column(int column, Bound bound, double value) {
  glp_set_col_bnds(problem_, column + 1, to_glpk(bound), value, value);
}

void GlpkProblem::set_cost(int column, double value) { glp_set_obj_coef(problem_, column + 1, value); }

void GlpkProblem::set_row_status(int row, Status status) {
  const int type = glp_get_row_type(problem_, row + 1);
  glp_set_row_stat(problem_, row + 1, status == Status::kBasic ? GLP_BS : nonbasic_status(type));
}

void GlpkProblem::set_column_status(int column, Status status) {
  const int type = glp_get_col_type(problem_, column + 1);
  glp_set_col_stat(problem_, column + 1, status == Status::kBasic ? GLP_BS : nonbasic_status(type));
}

bool GlpkProblem::is_row_basic(int row) const { return glp_get_row_stat(problem_, row + 1) == GLP_BS; }

bool GlpkProblem::is_column_basic(int column) const {
  return glp_get_col_stat(problem_, column + 1) == GLP_BS;
}

void GlpkProblem::advanced_basis() {
  call_glpk([this] { glp_adv_basis(problem_, 0); });
}

void GlpkProblem::scale(bool on) {
  call_glpk([&] { on ? glp_scale_prob(problem_, GLP_SF_AUTO) : glp_unscale_prob(problem_); });
}

GlpkProblem::Result GlpkProblem::solve(const Settings& settings) {
  glp_smcp parameters;
  glp_init_smcp(&parameters);
  parameters.msg_lev = GLP_MSG_OFF;
  parameters.meth = settings.simplex == Simplex::kPrimal ? GLP_PRIMAL : GLP_DUAL;
  parameters.pricing = GLP_PT_PSE;
  parameters.r_test = GLP_RT_FLIP;
  parameters.tol_bnd = settings.feasibility;
  parameters.tol_dj = settings.optimality;
  parameters.presolve = settings.presolve ? GLP_ON : GLP_OFF;
  if (settings.iteration_limit > 0) parameters.it_lim = settings.iteration_limit;
  if (settings.time_limit > 0) {
    parameters.tm_lim =
        static_cast<int>(std::min(settings.time_limit * 1000, 1.0 * std::numeric_limits<int>::max()));
  }
  pivots_ = 0;
  const int before = glp_get_it_cnt(problem_);
  int code = 0;
  call_glpk([&] {
    if (!settings.presolve && !settings.keep_factors) code = glp_factorize(problem_);
    if (code == 0) code = glp_simplex(problem_, &parameters);
  });
  pivots_ = glp_get_it_cnt(problem_) - before;
  if (code == GLP_EITLIM || code == GLP_ETMLIM) return Result::kLimit;
  if (code == GLP_ENOPFS) return Result::kInfeasible;
  if (code != 0) return Result::kFailed;
  switch (glp_get_status(problem_)) {
    case GLP_OPT:
      return Result::kOptimal;
    case GLP_NOFEAS:
      return Result::kInfeasible;
    case GLP_UNBND:
      return Result::kUnbounded;
    default:
      return Result::kFailed;
  }
}

std::int64_t GlpkProblem::pivots() const { return pivots_; }

double GlpkProblem::column_value(int column) const { return glp_get_col_prim(problem_, column + 1); }

double GlpkProblem::objective_value() const { return glp_get_obj_val(problem_); }

const char* glpk_version() { return glp_version(); }

}  // namespace indet
