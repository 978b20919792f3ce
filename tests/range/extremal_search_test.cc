#include "libindet/range/extremal_search.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "libindet/base/random.h"
#include "libindet/lp/purification.h"
#include "tests/support/compare.h"
#include "tests/support/oracle.h"
#include "tests/support/sets.h"

namespace indet {
namespace {

using test::random_polytope;

std::vector<Component> components_of(const SlopeView& view) {
  std::vector<Component> components;
  for (int k = 0; k + 1 < view.inequalities(); ++k)
    components.push_back({{{k, 1.0}, {k + 1, k % 2 == 0 ? 1.0 : -1.0}}});
  return components;
}

TEST(ExtremalSearch, FindsTheExtremaOfAllVertices) {
  Random random(31);
  for (int repeat = 0; repeat < 60; ++repeat) {
    const int d = 1 + static_cast<int>(random.below(4));
    const SlopeView view = random_polytope(d, 2 + static_cast<int>(random.below(6)), repeat % 2 == 1, random);
    const std::vector<Component> components = components_of(view);
    const Eigen::VectorXd weight = Eigen::VectorXd::Ones(view.inequalities());
    const auto corners = oracle::enumerate_corners(view.slope, view.offset);
    const Eigen::MatrixXd x = (corners.vertices * view.slope.transpose()).rowwise() + view.offset.transpose();
    const Basis start = purify_to_vertex(view, Eigen::VectorXd::Zero(d), Eigen::VectorXd::Ones(d));
    for (const Formulation formulation : {Formulation::kNullSpace, Formulation::kDual, Formulation::kEdge}) {
      SCOPED_TRACE(std::to_string(repeat) + " " + to_string(formulation));
      SearchOptions options;
      options.formulation = formulation;
      const SearchResult found = search_extrema(view, components, weight, start, options);
      for (std::size_t c = 0; c < components.size(); ++c) {
        Eigen::VectorXd values = Eigen::VectorXd::Zero(x.rows());
        for (const auto& [index, coefficient] : components[c].on_edges) values += coefficient * x.col(index);
        for (const double sign : {-1.0, 1.0}) {
          const Extremum& extremum = sign < 0 ? found.minimum[c] : found.maximum[c];
          ASSERT_EQ(extremum.status, Extremum::Status::kOptimal);
          const double best = (sign * values).maxCoeff();
          EXPECT_NEAR(sign * extremum.value, best, 1e-9);
          int attained = 0;
          double lightest = std::numeric_limits<double>::infinity();
          for (Eigen::Index i = 0; i < values.size(); ++i) {
            if (sign * values[i] < best - 1e-8) continue;
            ++attained;
            lightest = std::min(lightest, x.row(i).sum());
          }
          EXPECT_EQ(extremum.unique, attained == 1);
          EXPECT_NEAR(found.vertices[static_cast<std::size_t>(extremum.vertex)].x.sum(), lightest, 1e-8);
          EXPECT_LE(extremum.dual_residual, 1e-9);
        }
      }
      EXPECT_LE(found.solves, static_cast<std::int64_t>(10 * components.size()));
    }
  }
}

// The search passes the vertices of a search without canonical states before it looks for these.
TEST(ExtremalSearch, TellsWhereTheSolverLands) {
  Random random(33);
  int others = 0;
  for (int repeat = 0; repeat < 40; ++repeat) {
    const int d = 2 + static_cast<int>(random.below(3));
    const SlopeView view = random_polytope(d, 4, repeat % 2 == 1, random);
    const std::vector<Component> components = components_of(view);
    const Eigen::VectorXd weight = Eigen::VectorXd::Ones(view.inequalities());
    const Basis start = purify_to_vertex(view, Eigen::VectorXd::Zero(d), Eigen::VectorXd::Ones(d));
    for (const Method method : {Method::kLp, Method::kPivotingTableau, Method::kPivotingPaper}) {
      SCOPED_TRACE(std::to_string(repeat) + " " + to_string(method));
      SearchOptions options;
      options.method = method;
      options.solver_states = true;
      const SearchResult found = search_extrema(view, components, weight, start, options);
      options.canonical_states = options.solver_states = false;
      const SearchResult plain = search_extrema(view, components, weight, start, options);
      for (std::size_t c = 0; c < components.size(); ++c) {
        for (const auto& [both, one] : {std::pair(&found.minimum[c], &plain.minimum[c]),
                                        std::pair(&found.maximum[c], &plain.maximum[c])}) {
          ASSERT_EQ(both->status, one->status);
          EXPECT_EQ(one->solver_vertex, -1);
          if (one->status != Extremum::Status::kOptimal) continue;
          ASSERT_GE(both->solver_vertex, 0);
          const Vertex& landed = found.vertices[static_cast<std::size_t>(both->solver_vertex)];
          EXPECT_EQ(landed.basis, plain.vertices[static_cast<std::size_t>(one->vertex)].basis);
          others += both->solver_vertex == both->vertex ? 0 : 1;
        }
      }
    }
  }
  EXPECT_GT(others, 100) << "canonical states are others";
}

TEST(ExtremalSearch, LeavesOutWhatIsNotWanted) {
  Random random(32);
  const SlopeView view = random_polytope(3, 4, false, random);
  std::vector<Component> components = components_of(view);
  components[0].minimise = false;
  components[1].maximise = false;
  const Basis start = purify_to_vertex(view, Eigen::VectorXd::Zero(3), Eigen::VectorXd::Ones(3));
  const SearchResult found =
      search_extrema(view, components, Eigen::VectorXd::Ones(view.inequalities()), start, {});
  EXPECT_EQ(found.minimum[0].status, Extremum::Status::kOpen);
  EXPECT_EQ(found.maximum[1].status, Extremum::Status::kOpen);
  EXPECT_EQ(found.maximum[0].status, Extremum::Status::kOptimal);
}

TEST(ExtremalSearch, UnboundedFunctionalsAreTold) {
  SlopeView view;  // the quadrant, and the strip z0 − z1 ≥ −1
  view.slope.resize(3, 2);
  view.slope << 1, 0, 0, 1, 1, -1;
  view.offset.resize(3);
  view.offset << 0, 0, 1;
  view.set = std::make_shared<FeasibleSet>(
      FeasibleSet{Eigen::RowVector3d(1, -1, -1).sparseView(), Eigen::VectorXd::Constant(1, -1)});
  const std::vector<Component> components = {{{{0, 1.0}}}, {{{1, 1.0}}}, {{{0, 1.0}, {2, -1.0}}}};
  for (const Formulation formulation : {Formulation::kNullSpace, Formulation::kDual, Formulation::kEdge}) {
    SearchOptions options;
    options.formulation = formulation;
    const SearchResult found = search_extrema(view, components, Eigen::Vector3d::Ones(), {0, 1}, options);
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(found.maximum[static_cast<std::size_t>(c)].status, Extremum::Status::kUnbounded) << c;
      EXPECT_EQ(found.minimum[static_cast<std::size_t>(c)].status, Extremum::Status::kOptimal) << c;
    }
    EXPECT_EQ(found.minimum[2].value, -1);  // z1 − 1 at z1 = 0
    EXPECT_FALSE(found.minimum[2].unique);
  }
}

}  // namespace
}  // namespace indet
