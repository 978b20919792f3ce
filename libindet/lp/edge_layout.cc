#include <vector>

#include "libindet/lp/layout.h"

namespace indet {
namespace {

/// max e·x over equations · x = right_hand_side, x ≥ 0: a sparse row an independent equilibrium equation, a
/// column an edge of a contact cone. At a vertex the d active columns are nonbasic at 0, and all rows are
/// nonbasic.
class EdgeLayout : public Layout {
 public:
  explicit EdgeLayout(const FeasibleSet& set) : set_(set) {}

  std::unique_ptr<GlpkProblem> build() const override {
    const auto& equations = set_.equations;
    auto problem =
        std::make_unique<GlpkProblem>(static_cast<int>(equations.rows()), set_.inequalities(), true);
    std::vector<GlpkProblem::Entry> entries;
    for (int k = 0; k < set_.inequalities(); ++k) {
      problem->bound_column(k, GlpkProblem::Bound::kLower, 0);
      for (Eigen::SparseMatrix<double>::InnerIterator it(equations, k); it; ++it) {
        if (it.value() != 0) entries.push_back({static_cast<int>(it.row()), k, it.value()});
      }
    }
    for (int i = 0; i < equations.rows(); ++i) {
      problem->bound_row(i, GlpkProblem::Bound::kFixed, set_.right_hand_side[i]);
    }
    problem->load(entries);
    return problem;
  }

  void set_objective(GlpkProblem& problem, const Objective& objective) override {
    for (const int k : costs_) problem.set_cost(k, 0);
    costs_.clear();
    for (const auto& [k, coefficient] : objective.on_edges) {
      problem.set_cost(k, coefficient);
      costs_.push_back(k);
    }
  }

  void set_start(GlpkProblem& problem, std::span<const int> basis) const override {
    for (int i = 0; i < set_.equations.rows(); ++i) problem.set_row_status(i, GlpkProblem::Status::kNonbasic);
    for (int k = 0; k < set_.inequalities(); ++k) problem.set_column_status(k, GlpkProblem::Status::kBasic);
    for (const int k : basis) problem.set_column_status(k, GlpkProblem::Status::kNonbasic);
  }

  void hold(GlpkProblem& problem, std::span<const int> held, bool on) const override {
    const auto bound = on ? GlpkProblem::Bound::kFixed : GlpkProblem::Bound::kLower;
    for (const int k : held) problem.bound_column(k, bound, 0);
  }

  Basis read_basis(const GlpkProblem& problem) const override {
    Basis basis;
    for (int k = 0; k < set_.inequalities(); ++k) {
      if (!problem.is_column_basic(k)) basis.push_back(k);
    }
    return basis;
  }

  GlpkProblem::Simplex warm_simplex() const override { return GlpkProblem::Simplex::kPrimal; }

  LpStatus interpret(GlpkProblem::Result result) const override { return status_of(result); }

 private:
  const FeasibleSet& set_;
  std::vector<int> costs_;
};

}  // namespace

std::unique_ptr<Layout> make_edge_layout(const FeasibleSet& set) { return std::make_unique<EdgeLayout>(set); }

}  // namespace indet
