#include "libindet/polytope/recession_cone.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>

#include "libindet/base/tolerances.h"
#include "libindet/lp/independent_equations.h"
#include "libindet/lp/purification.h"
#include "libindet/lp/vertex.h"
#include "libindet/nullspace/null_space.h"
#include "libindet/polytope/interior.h"

namespace indet {
namespace {

/// The edges that rays load; nothing if the linear programs fail.
std::optional<std::vector<int>> loaded_edges(const SlopeView& view, const Eigen::VectorXd& guess,
                                             const LpOptions& options) {
  const SlopeView cone = truncated_recession_cone(view);
  const Eigen::VectorXd apex = Eigen::VectorXd::Zero(cone.dim());
  LpSolver solver(cone, choose_formulation_of_one(cone), options);
  Basis start = purify_to_vertex(cone, apex, apex);
  std::vector<int> loaded;
  for (int k = 0; k < view.inequalities(); ++k) {
    if (guess[k] > tolerance::kRay) loaded.push_back(k);
  }
  for (;;) {
    std::vector<std::pair<int, double>> others;
    for (int k = 0; k < view.inequalities(); ++k) {
      if (!std::binary_search(loaded.begin(), loaded.end(), k)) others.emplace_back(k, 1.0);
    }
    if (others.empty()) return loaded;
    LpAnswer answer = solver.maximise(make_objective(cone, others), start);
    if (answer.status != LpStatus::kOptimal) return {};
    const Vertex vertex = locate_vertex(cone, answer.basis);
    double sum = 0;
    for (const auto& [k, one] : others) sum += vertex.x[k];
    if (sum <= tolerance::kRay) return loaded;
    const double least = tolerance::kRay / static_cast<double>(others.size());
    for (const auto& [k, one] : others) {
      if (vertex.x[k] > least) loaded.push_back(k);
    }
    std::sort(loaded.begin(), loaded.end());
    start = std::move(answer.basis);
  }
}

/// The cone on the given edges; nothing if rounding decides its dimension.
std::optional<SlopeView> truncated_cone(const FeasibleSet& set, std::span<const int> edges) {
  Eigen::SparseMatrix<double> columns(set.equations.rows(), std::ssize(edges));
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(set.equations, edges[k]); it; ++it)
      entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(k), it.value());
  }
  columns.setFromTriplets(entries.begin(), entries.end());
  const NullSpace rays = compute_null_space(columns, Eigen::VectorXd::Zero(columns.rows()));
  if (rays.ambiguous || rays.nullity == 0) return {};
  SlopeView view;
  view.slope = rays.basis;
  view.offset.setZero(columns.cols());
  view.set =
      std::make_shared<const FeasibleSet>(independent_equations(columns, rays.independent_rows, view.offset));
  return truncated_recession_cone(view);
}

}  // namespace

std::vector<std::pair<int, double>> RecessionCone::restricted(
    const std::vector<std::pair<int, double>>& on_edges) const {
  std::vector<std::pair<int, double>> result;
  for (const auto& [edge, coefficient] : on_edges) {
    const auto at = std::lower_bound(edges.begin(), edges.end(), edge);
    if (at != edges.end() && *at == edge)
      result.emplace_back(static_cast<int>(at - edges.begin()), coefficient);
  }
  return result;
}

Eigen::VectorXd RecessionCone::ray(const Eigen::VectorXd& point, int inequalities) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(inequalities);
  result(edges) = point.head(std::ssize(edges));
  return result;
}

std::shared_ptr<const RecessionCone> find_recession_cone(const SlopeView& view, const Eigen::VectorXd& guess,
                                                         const LpOptions& options) {
  auto cone = std::make_shared<RecessionCone>();
  if (auto loaded = loaded_edges(view, guess, options)) cone->loaded = std::move(*loaded);
  if (choose_formulation_of_one(view) == Formulation::kEdge && !cone->loaded.empty()) {
    if (auto truncated = truncated_cone(*view.set, cone->loaded)) {
      cone->edges = cone->loaded;
      cone->truncated = std::move(*truncated);
      return cone;
    }
  }
  cone->edges.resize(static_cast<std::size_t>(view.inequalities()));
  std::iota(cone->edges.begin(), cone->edges.end(), 0);
  cone->truncated = truncated_recession_cone(view);
  return cone;
}

}  // namespace indet
