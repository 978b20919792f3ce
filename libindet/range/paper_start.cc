#include "libindet/range/paper_start.h"

#include "libindet/base/tolerances.h"
#include "libindet/lp/purification.h"
#include "libindet/pivoting/interior_start.h"
#include "libindet/polytope/interior.h"

namespace indet {
namespace {

/// x of the simulated state, in force units; NaN where it is unknown.
Eigen::VectorXd simulated_strengths(const Packing& packing, const ContactMatrix& contacts) {
  Eigen::VectorXd x(contacts.unknowns());
  for (std::size_t k = 0; k < contacts.edges.size(); ++k) {
    const Edge& edge = contacts.edges[k];
    const Contact& contact = packing[edge.contact];
    const bool has_both =
        contacts.modes[static_cast<std::size_t>(edge.contact.value())] == ContactMode::kStick;
    const double R = contact.R / contacts.force_unit / edge.R;
    x[static_cast<Eigen::Index>(k)] = has_both ? (R + contact.T / contacts.force_unit / edge.T) / 2 : R;
  }
  return x;
}

}  // namespace

Basis first_extremal_point(const Packing& packing, const ForcePolytope& polytope, const PolytopeBlock& block,
                           const LpOptions& options, PaperWork& work) {
  const Eigen::VectorXd simulated = simulated_strengths(packing, polytope.contacts)(block.edges);
  const InteriorStart start = leave_sliding_contacts(block.set, simulated, tolerance::kSliding);
  ++work.starts[static_cast<std::size_t>(start.end)];
  work.sliding_left += start.left;
  const Eigen::VectorXd interior =
      start.end == InteriorEnd::kFound ? start.z : find_interior_point(block.set, options).z;
  return purify_to_vertex(block.set, interior, Eigen::VectorXd::Zero(block.set.dim()));
}

}  // namespace indet
