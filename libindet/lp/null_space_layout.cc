#include <vector>

#include "libindet/lp/layout.h"

namespace indet {
namespace {

/// max g·z over slope · z ≥ −offset: a row an inequality, a free column a dimension.
/// At a vertex the d active rows are nonbasic at their bound, and all columns are basic.
class NullSpaceLayout : public Layout {
 public:
  explicit NullSpaceLayout(const SlopeView& view) : view_(view) {}

  std::unique_ptr<GlpkProblem> build() const override {
    auto problem = std::make_unique<GlpkProblem>(view_.inequalities(), view_.dim(), true);
    std::vector<GlpkProblem::Entry> entries;
    for (int k = 0; k < view_.inequalities(); ++k) {
      problem->bound_row(k, GlpkProblem::Bound::kLower, -view_.offset[k]);
      for (int j = 0; j < view_.dim(); ++j) {
        if (view_.slope(k, j) != 0) entries.push_back({k, j, view_.slope(k, j)});
      }
    }
    for (int j = 0; j < view_.dim(); ++j) problem->bound_column(j, GlpkProblem::Bound::kFree, 0);
    problem->load(entries);
    return problem;
  }

  void set_objective(GlpkProblem& problem, const Objective& objective) override {
    for (int j = 0; j < view_.dim(); ++j) problem.set_cost(j, objective.along_z[j]);
  }

  void set_start(GlpkProblem& problem, std::span<const int> basis) const override {
    for (int j = 0; j < view_.dim(); ++j) problem.set_column_status(j, GlpkProblem::Status::kBasic);
    for (int k = 0; k < view_.inequalities(); ++k) problem.set_row_status(k, GlpkProblem::Status::kBasic);
    for (const int k : basis) problem.set_row_status(k, GlpkProblem::Status::kNonbasic);
  }

  void hold(GlpkProblem& problem, std::span<const int> held, bool on) const override {
    const auto bound = on ? GlpkProblem::Bound::kFixed : GlpkProblem::Bound::kLower;
    for (const int k : held) problem.bound_row(k, bound, -view_.offset[k]);
  }

  Basis read_basis(const GlpkProblem& problem) const override {
    Basis basis;
    for (int k = 0; k < view_.inequalities(); ++k) {
      if (!problem.is_row_basic(k)) basis.push_back(k);
    }
    return basis;
  }

  GlpkProblem::Simplex warm_simplex() const override { return GlpkProblem::Simplex::kPrimal; }

  LpStatus interpret(GlpkProblem::Result result) const override { return status_of(result); }

 private:
  const SlopeView& view_;
};

}  // namespace

std::unique_ptr<Layout> make_null_space_layout(const SlopeView& view) {
  return std::make_unique<NullSpaceLayout>(view);
}

}  // namespace indet
