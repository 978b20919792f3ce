#include "libindet/range/state_table.h"

#include <algorithm>

namespace indet {

InternalForces state_at(const ForcePolytope& polytope, std::size_t block, const Vertex& vertex) {
  Eigen::VectorXd x = polytope.lightest;
  if (vertex.basis != polytope.blocks[block].lightest) x(polytope.blocks[block].edges) = vertex.x;
  return polytope.problem.state(x);
}

int StateTable::add(std::size_t block, const Vertex& vertex) {
  if (vertex.basis == polytope_.blocks[block].lightest) return lightest();
  const auto [entry, is_new] =
      numbers_.emplace(std::make_pair(static_cast<int>(block), vertex.basis), count());
  if (is_new) append(state_at(polytope_, block, vertex), static_cast<int>(block), vertex.basis);
  return entry->second;
}

int StateTable::lightest() {
  const auto [entry, is_new] = numbers_.emplace(std::make_pair(-1, Basis{}), count());
  if (is_new) append(polytope_.problem.state(polytope_.lightest), -1, {});
  return entry->second;
}

int StateTable::add_ray(std::size_t block, const Eigen::VectorXd& x) {
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(polytope_.problem.unknowns());
  whole(polytope_.blocks[block].edges) = x;
  Eigen::VectorXd ray = polytope_.problem.state(whole).value();
  ray /= ray.lpNorm<Eigen::Infinity>();
  const auto known = std::find(rays_.begin(), rays_.end(), ray);
  if (known != rays_.end()) return static_cast<int>(known - rays_.begin());
  rays_.push_back(std::move(ray));
  return static_cast<int>(rays_.size()) - 1;
}

Rows<double> StateTable::states() const {
  Rows<double> rows(count(), polytope_.problem.edge_forces.rows());
  for (int i = 0; i < count(); ++i)
    rows.row(i) = polytope_.problem.units.scene(states_[static_cast<std::size_t>(i)]).value();
  return rows;
}

Eigen::Array<std::int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> StateTable::active() const {
  Eigen::Array<std::int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows(count(), polytope_.dim);
  for (int i = 0; i < count(); ++i) {
    const auto& active = active_[static_cast<std::size_t>(i)];
    rows.row(i) =
        Eigen::Map<const Eigen::Array<std::int32_t, 1, Eigen::Dynamic>>(active.data(), polytope_.dim);
  }
  return rows;
}

Rows<double> StateTable::rays() const {
  Rows<double> rows(static_cast<Eigen::Index>(rays_.size()), polytope_.problem.edge_forces.rows());
  for (std::size_t i = 0; i < rays_.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = rays_[i].transpose();
  return rows;
}

void StateTable::append(const InternalForces& state, int block, const Basis& basis) {
  states_.push_back(state);
  std::vector<std::int32_t> active;
  for (int b = 0; b < static_cast<int>(polytope_.blocks.size()); ++b) {
    const PolytopeBlock& other = polytope_.blocks[static_cast<std::size_t>(b)];
    for (const int local : b == block ? basis : other.lightest) {
      const Edge& edge =
          polytope_.problem.edges[static_cast<std::size_t>(other.edges[static_cast<std::size_t>(local)])];
      active.push_back(polytope_.problem.half_plane(edge));
    }
  }
  std::sort(active.begin(), active.end());
  active_.push_back(std::move(active));
}

}  // namespace indet
