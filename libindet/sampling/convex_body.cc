#include "libindet/sampling/convex_body.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/dense/qr.h"
#include "libindet/polytope/interior.h"

namespace indet {

double ConvexBody::slack(const Eigen::Ref<const Eigen::VectorXd>& z) const {
  return (view.offset + view.slope * z).minCoeff();
}

InternalStates ConvexBody::states(const Eigen::Ref<const Eigen::MatrixXd>& z) const {
  Eigen::MatrixXd result = frame * z;
  result.colwise() += origin;
  return InternalStates(std::move(result));
}

ConvexBody make_body(const SlopeView& view) {
  const Eigen::Index n = view.dim();
  ConvexBody body;
  body.view.slope = view.slope;
  body.view.offset = view.offset;
  body.blocks = {{0, view.inequalities(), 0, n}};
  body.origin = Eigen::VectorXd::Zero(n);
  body.frame = Eigen::MatrixXd::Identity(n, n);
  return body;
}

ConvexBody make_body(const ForcePolytope& polytope) {
  Eigen::Index rows = 0;
  for (const PolytopeBlock& block : polytope.blocks) rows += block.view.inequalities();
  const Eigen::SparseMatrix<double>& to_forces = polytope.problem.edge_forces;
  ConvexBody body;
  body.view.slope = Eigen::MatrixXd::Zero(rows, polytope.dim);
  body.view.offset.resize(rows);
  body.frame = Eigen::MatrixXd::Zero(to_forces.rows(), polytope.dim);
  Eigen::VectorXd x = polytope.lightest;
  BodyBlock place;
  for (const PolytopeBlock& block : polytope.blocks) {
    place.rows = block.view.inequalities();
    place.columns = block.view.dim();
    Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(to_forces.cols(), place.columns);
    for (std::size_t k = 0; k < block.edges.size(); ++k) {
      spread.row(block.edges[k]) = block.view.slope.row(static_cast<Eigen::Index>(k));
      x[block.edges[k]] = block.view.offset[static_cast<Eigen::Index>(k)];
    }
    // F = … + J ζ = … + Q (U ζ): z = U ζ are orthonormal coordinates.
    const Eigen::MatrixXd jacobian = to_forces * spread;
    const ThinQr qr = factorise_qr(jacobian);
    body.frame.middleCols(place.first_column, place.columns) = qr.Q;
    const Eigen::MatrixXd turned =
        qr.R.triangularView<Eigen::Upper>().transpose().solve(block.view.slope.transpose());
    body.view.slope.block(place.first_row, place.first_column, place.rows, place.columns) =
        turned.transpose();
    body.view.offset.segment(place.first_row, place.rows) = block.view.offset;
    body.blocks.push_back(place);
    place.first_row += place.rows;
    place.first_column += place.columns;
  }
  body.origin = to_forces * x;
  body.units = polytope.problem.units;
  return body;
}

InscribedBall find_inscribed_ball(const ConvexBody& body) {
  InscribedBall ball{Eigen::VectorXd::Zero(body.dim()), std::numeric_limits<double>::infinity()};
  for (const BodyBlock& block : body.blocks) {
    SlopeView view;
    view.slope = body.view.slope.block(block.first_row, block.first_column, block.rows, block.columns);
    const Eigen::VectorXd lengths = view.slope.rowwise().norm();
    view.slope = lengths.cwiseInverse().asDiagonal() * view.slope;
    const Eigen::VectorXd distances =
        body.view.offset.segment(block.first_row, block.rows).cwiseQuotient(lengths);
    // The linear program stops at slack 1: larger bodies are made smaller for it.
    InteriorPoint point;
    double unit = 1;
    for (;; unit *= 16) {
      view.offset = distances / unit;
      point = find_interior_point(view, {});
      if (point.slack < 0.99) break;
      if (unit > 1e12) throw LibraryError("no largest ball in a body that should be bounded");
    }
    if (!(point.slack > 0)) throw LibraryError("the body to be sampled has no interior");
    ball.center.segment(block.first_column, block.columns) = unit * point.z;
    ball.radius = std::min(ball.radius, unit * point.slack);
  }
  return ball;
}

AnalyticCenter find_analytic_center(const ConvexBody& body, const Eigen::VectorXd& interior) {
  constexpr int kMostSteps = 200;
  AnalyticCenter center{interior, Eigen::MatrixXd::Zero(body.dim(), body.dim())};
  for (const BodyBlock& block : body.blocks) {
    const Eigen::MatrixXd slope =
        body.view.slope.block(block.first_row, block.first_column, block.rows, block.columns);
    const Eigen::VectorXd offset = body.view.offset.segment(block.first_row, block.rows);
    auto z = center.z.segment(block.first_column, block.columns);
    // Columns in reverse order, so that the triangular factor of the QR decomposition is a lower one.
    Eigen::MatrixXd scaled;
    for (int step = 0; step < kMostSteps; ++step) {
      const Eigen::VectorXd slacks = offset + slope * z;
      scaled = slacks.cwiseInverse().asDiagonal() * slope.rowwise().reverse();
      // The Newton direction (Sᵀ S)⁻¹ Sᵀ 1 is a least-squares solution.
      const Eigen::VectorXd reversed = solve_least_squares(scaled, Eigen::VectorXd::Ones(block.rows));
      const double decrement = (scaled * reversed).norm();
      // The damped step 1/(1 + λ) stays inside the Dikin ellipsoid, and so inside the body.
      z += reversed.reverse() * (decrement < 0.25 ? 1.0 : 1 / (1 + decrement));
      if (!(decrement > tolerance::kNewtonDecrement)) break;
    }
    const Eigen::MatrixXd lower = upper_factor(scaled).reverse();
    const Eigen::VectorXd signs = lower.diagonal().cwiseSign();
    center.root.block(block.first_column, block.first_column, block.columns, block.columns) =
        signs.asDiagonal() * lower;
  }
  return center;
}

}  // namespace indet
