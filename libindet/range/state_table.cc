#include "libindet/range/state_table.h"

#include <algorithm>

namespace indet {

int StateTable::add(std::size_t block, const Vertex& vertex) {
  if (vertex.basis == polytope_.blocks[block].lightest) return lightest();
  const auto [entry, is_new] =
      numbers_.emplace(std::make_pair(static_cast<int>(block), vertex.basis), count());
  if (is_new) {
    Eigen::VectorXd x = polytope_.lightest;
    x(polytope_.blocks[block].edges) = vertex.x;
    append(x, static_cast<int>(block), vertex.basis);
  }
  return entry->second;
}

int StateTable::lightest() {
  const auto [entry, is_new] = numbers_.emplace(std::make_pair(-1, Basis{}), count());
  if (is_new) append(polytope_.lightest, -1, {});
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

void StateTable::write(ForceRanges& ranges) const {
  const Eigen::Index components = polytope_.problem.edge_forces.rows();
  ranges.states.resize(count(), components);
  ranges.active.resize(count(), polytope_.dim);
  for (int i = 0; i < count(); ++i) {
    ranges.states.row(i) = polytope_.problem.units.scene(states_[static_cast<std::size_t>(i)]).value();
    const auto& active = active_[static_cast<std::size_t>(i)];
    ranges.active.row(i) =
        Eigen::Map<const Eigen::Array<std::int32_t, 1, Eigen::Dynamic>>(active.data(), polytope_.dim);
  }
  ranges.rays.resize(static_cast<Eigen::Index>(rays_.size()), components);
  for (std::size_t i = 0; i < rays_.size(); ++i)
    ranges.rays.row(static_cast<Eigen::Index>(i)) = rays_[i].transpose();
}

void StateTable::append(const Eigen::VectorXd& x, int block, const Basis& basis) {
  states_.push_back(polytope_.problem.state(x));
  std::vector<std::int32_t> active;
  for (int b = 0; b < static_cast<int>(polytope_.blocks.size()); ++b) {
    const PolytopeBlock& other = polytope_.blocks[static_cast<std::size_t>(b)];
    for (const int local : b == block ? basis : other.lightest) {
      const Edge& edge =
          polytope_.problem.edges[static_cast<std::size_t>(other.edges[static_cast<std::size_t>(local)])];
      active.push_back(2 * edge.contact.value() + (edge.sign < 0 ? 1 : 0));
    }
  }
  std::sort(active.begin(), active.end());
  active_.push_back(std::move(active));
}

}  // namespace indet
