#include "libindet/range/pivot_preference.h"

#include <cstddef>

#include "libindet/dense/qr.h"

namespace indet {
namespace {

/// Some seconds.
constexpr std::size_t kMostEdges = 2000;

}  // namespace

std::vector<double> pivot_preference(const exact::ContactProblem& problem, std::span<const int> edges) {
  std::vector<double> preference(static_cast<std::size_t>(problem.edges()), 0.0);
  if (edges.size() > kMostEdges) return preference;
  std::vector<Eigen::Index> number(static_cast<std::size_t>(problem.rows()), -1);
  Eigen::Index rows = 0;
  for (const int e : edges) {
    for (const int row : problem.edge(e).row) {
      Eigen::Index& place = number[static_cast<std::size_t>(row)];
      if (place < 0) place = rows++;
    }
  }
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(rows, std::ssize(edges));
  for (std::size_t j = 0; j < edges.size(); ++j) {
    const exact::IntegerColumn& column = problem.edge(edges[j]);
    for (std::size_t k = 0; k < column.row.size(); ++k)
      columns(number[static_cast<std::size_t>(column.row[k])], static_cast<Eigen::Index>(j)) =
          exact::scaled(mpq_class(column.value[k]), -column.shift).get_d();
  }
  const std::vector<Eigen::Index> order = pivot_order(columns);
  for (std::size_t place = 0; place < order.size(); ++place)
    preference[static_cast<std::size_t>(edges[static_cast<std::size_t>(order[place])])] =
        static_cast<double>(order.size() - place);
  return preference;
}

}  // namespace indet
