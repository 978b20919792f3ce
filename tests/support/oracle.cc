#include "tests/support/oracle.h"

#include <lapacke.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace indet::oracle {
namespace {

constexpr double kFeasible = 1e-9;
constexpr double kSame = 1e-7;

class RowSet {
 public:
  explicit RowSet(Eigen::Index columns) : columns_(columns) {}
  void add(const Eigen::VectorXd& row) {
    for (const Eigen::VectorXd& known : rows_)
      if ((known - row).lpNorm<Eigen::Infinity>() <= kSame * std::max(1.0, row.lpNorm<Eigen::Infinity>()))
        return;
    rows_.push_back(row);
  }
  Eigen::MatrixXd matrix() const {
    Eigen::MatrixXd result(static_cast<Eigen::Index>(rows_.size()), columns_);
    for (std::size_t i = 0; i < rows_.size(); ++i)
      result.row(static_cast<Eigen::Index>(i)) = rows_[i].transpose();
    return result;
  }

 private:
  Eigen::Index columns_;
  std::vector<Eigen::VectorXd> rows_;
};

struct Decomposition {
  Eigen::MatrixXd U;
  Eigen::VectorXd sigma;
  Eigen::MatrixXd V;
};

/// By the iteration of QR (dgesvd), where the program divides and conquers (dgesdd); Eigen's own takes a
/// minute to compile under sanitizers.
Decomposition decompose(Eigen::MatrixXd a) {
  const auto m = static_cast<lapack_int>(a.rows());
  const auto n = static_cast<lapack_int>(a.cols());
  Decomposition result{Eigen::MatrixXd(m, m), Eigen::VectorXd(std::min(m, n)), Eigen::MatrixXd(n, n)};
  Eigen::VectorXd unconverged(std::min(m, n));
  if (LAPACKE_dgesvd(LAPACK_COL_MAJOR, 'A', 'A', m, n, a.data(), m, result.sigma.data(), result.U.data(), m,
                     result.V.data(), n, unconverged.data()) != 0)
    throw std::runtime_error("oracle: LAPACK's dgesvd failed");
  result.V.transposeInPlace();  // LAPACK gives Vᵀ
  return result;
}

}  // namespace

Eigen::MatrixXd paper_matrix(const Packing& packing) {
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(3 * packing.disk_count(), 2 * packing.contact_count());
  for (int k = 0; k < packing.contact_count(); ++k) {
    const Contact& contact = packing[ContactId(k)];
    const double nx = contact.normal.x();
    const double ny = contact.normal.y();
    const auto act_on = [&](DiskId disk, double sign, double lever) {
      if (packing[disk].fixed) return;
      const int row = 3 * disk.value();
      c(row, 2 * k) += sign * nx;
      c(row + 1, 2 * k) += sign * ny;
      c(row, 2 * k + 1) += sign * ny;
      c(row + 1, 2 * k + 1) += sign * -nx;
      c(row + 2, 2 * k + 1) += std::isnan(lever) ? packing[disk].radius : lever;
    };
    act_on(contact.a, 1, contact.lever_a);
    if (!contact.b.is_wall()) act_on(contact.b.disk_id(), -1, contact.lever_b);
  }
  return c;
}

Eigen::VectorXd paper_wrench(const Packing& packing) {
  double weight = 0;
  int free = 0;
  for (const Disk& disk : packing.disks) {
    if (disk.fixed) continue;
    weight += disk.mass;
    ++free;
  }
  const double unit =
      packing.named_force_unit > 0 ? packing.named_force_unit : packing.gravity.norm() * weight / free;
  Eigen::VectorXd w = Eigen::VectorXd::Zero(3 * packing.disk_count());
  for (int i = 0; i < packing.disk_count(); ++i) {
    const Disk& disk = packing[DiskId(i)];
    if (disk.fixed) continue;
    w[3 * i] = (disk.mass * packing.gravity.x() + disk.load.x()) / unit;
    w[3 * i + 1] = (disk.mass * packing.gravity.y() + disk.load.y()) / unit;
    w[3 * i + 2] = disk.load.z() / unit;
  }
  return w;
}

Eigen::VectorXd singular_values(const Eigen::MatrixXd& a) { return decompose(a).sigma; }

DenseSolution solve_dense(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  DenseSolution result;
  if (a.rows() == 0 || a.cols() == 0) {
    result.kernel = Eigen::MatrixXd::Identity(a.cols(), a.cols());
    result.particular = Eigen::VectorXd::Zero(a.cols());
    result.residual = b.size() > 0 ? b.lpNorm<Eigen::Infinity>() : 0;
    return result;
  }
  const auto [U, sigma, V] = decompose(a);
  while (result.rank < sigma.size() && sigma[result.rank] > 1e-11 * std::max(1e-300, sigma[0])) ++result.rank;
  result.kernel = V.rightCols(a.cols() - result.rank);
  const Eigen::VectorXd projected = U.leftCols(result.rank).transpose() * b;
  result.particular = V.leftCols(result.rank) * projected.cwiseQuotient(sigma.head(result.rank));
  result.residual = (a * result.particular - b).lpNorm<Eigen::Infinity>();
  return result;
}

Corners enumerate_corners(const Eigen::MatrixXd& slope, const Eigen::VectorXd& offset) {
  const int d = static_cast<int>(slope.cols());
  const auto feasible = [](const Eigen::VectorXd& x) {
    return x.size() == 0 || x.minCoeff() >= -kFeasible * std::max(1.0, x.lpNorm<Eigen::Infinity>());
  };
  // Rows without slope decide nothing but whether there is anything at all.
  std::vector<int> rows;
  for (int k = 0; k < slope.rows(); ++k)
    if (d > 0 && slope.row(k).norm() > 1e-10) rows.push_back(k);
  const int count = static_cast<int>(rows.size());
  const auto chosen = [&](std::vector<int> choice) {
    for (int& k : choice) k = rows[static_cast<std::size_t>(k)];
    return choice;
  };
  RowSet vertices(d);
  RowSet rays(d);
  if (d == 0) {
    if (feasible(offset)) vertices.add(Eigen::VectorXd(0));
    return {vertices.matrix(), rays.matrix()};
  }
  for_each_choice(count, d, [&](const std::vector<int>& choice) {
    const std::vector<int> active = chosen(choice);
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(slope(active, Eigen::all));
    if (std::abs(lu.maxPivot()) == 0 || std::abs(lu.matrixLU()(d - 1, d - 1)) < 1e-10 * lu.maxPivot()) return;
    const Eigen::VectorXd z = lu.solve(-offset(active));
    if (feasible(offset + slope * z)) vertices.add(z);
  });
  for_each_choice(count, d - 1, [&](const std::vector<int>& choice) {
    Eigen::VectorXd ray = Eigen::VectorXd::Ones(1);
    if (d > 1) {
      Eigen::FullPivLU<Eigen::MatrixXd> lu(slope(chosen(choice), Eigen::all));
      lu.setThreshold(1e-10);
      if (lu.rank() != d - 1) return;
      ray = lu.kernel().col(0);
    }
    ray /= ray.lpNorm<Eigen::Infinity>();
    for (const double sign : {1.0, -1.0})
      if (feasible(slope * (sign * ray))) rays.add(sign * ray);
  });
  return {vertices.matrix(), rays.matrix()};
}

States enumerate_states(const Packing& packing) {
  const Eigen::MatrixXd c = paper_matrix(packing);
  std::vector<int> frictionless;
  for (int k = 0; k < packing.contact_count(); ++k)
    if (packing[ContactId(k)].mu == 0) frictionless.push_back(k);
  const auto extra = static_cast<Eigen::Index>(frictionless.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(c.rows() + extra, c.cols());
  a.topRows(c.rows()) = c;
  for (Eigen::Index i = 0; i < extra; ++i)
    a(c.rows() + i, 2 * frictionless[static_cast<std::size_t>(i)] + 1) = 1;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(a.rows());
  b.head(c.rows()) = -paper_wrench(packing);

  States result;
  const DenseSolution linear = solve_dense(a, b);
  const auto d = linear.kernel.cols();
  result.nullity = static_cast<int>(d);
  result.vertices.resize(0, c.cols());
  result.rays.resize(0, c.cols());
  if (linear.residual > 1e-9) return result;

  Eigen::MatrixXd half_planes = Eigen::MatrixXd::Zero(2 * packing.contact_count(), c.cols());
  for (int k = 0; k < packing.contact_count(); ++k) {
    const double mu = packing[ContactId(k)].mu;
    for (const int side : {0, 1}) {
      half_planes(2 * k + side, 2 * k) = mu > 0 ? mu : 1;
      if (mu > 0) half_planes(2 * k + side, 2 * k + 1) = side == 0 ? 1 : -1;
    }
  }
  const Corners corners = enumerate_corners(half_planes * linear.kernel, half_planes * linear.particular);
  result.vertices = (corners.vertices * linear.kernel.transpose()).rowwise() + linear.particular.transpose();
  result.rays = corners.rays * linear.kernel.transpose();
  const Eigen::Index count = corners.vertices.rows();
  if (count == 0) return result;
  Eigen::MatrixXd spread(count - 1 + corners.rays.rows(), d);
  spread << corners.vertices.bottomRows(count - 1).rowwise() - corners.vertices.row(0), corners.rays;
  result.dim = 0;
  if (spread.size() == 0) return result;  // Eigen asserts that what it decomposes has entries
  Eigen::FullPivLU<Eigen::MatrixXd> lu(spread);
  lu.setThreshold(1e-7);
  result.dim = static_cast<int>(lu.rank());
  return result;
}

Answer extremum(const States& states, int component, int sign) {
  Answer answer;
  const Eigen::VectorXd growth = sign * states.rays.col(component);
  if (growth.size() > 0 && growth.maxCoeff() > 1e-9) {
    answer.value = sign * std::numeric_limits<double>::infinity();
    return answer;
  }
  const Eigen::VectorXd values = sign * states.vertices.col(component);
  const double best = values.maxCoeff();
  answer.value = sign * best;
  answer.unique = growth.size() == 0 || growth.maxCoeff() < -1e-9;
  answer.smallest_weight = std::numeric_limits<double>::infinity();
  int attained = 0;
  int lightest = 0;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (values[i] < best - 1e-8 * std::max(1.0, std::abs(best))) continue;
    ++attained;
    double weight = 0;
    for (Eigen::Index k = 0; k < states.vertices.cols(); k += 2) weight += states.vertices(i, k);
    const double margin = 1e-8 * std::max(1.0, std::abs(weight));
    if (weight > answer.smallest_weight + margin) continue;
    lightest = weight < answer.smallest_weight - margin ? 1 : lightest + 1;
    answer.smallest_weight = std::min(weight, answer.smallest_weight);
    answer.lightest = states.vertices.row(i).transpose();
  }
  answer.unique = answer.unique && attained == 1;
  if (lightest != 1) answer.lightest.resize(0);
  return answer;
}

}  // namespace indet::oracle
