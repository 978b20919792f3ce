#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "libindet/lp/feasible_set.h"
#include "libindet/lp/vertex.h"
#include "libindet/range/component.h"
#include "libindet/range/search_options.h"
#include "libindet/range/search_task.h"

namespace indet {

/// How far the search has come with one objective: component c minimised (even number) or maximised (odd
/// number).
struct ObjectiveProgress {
  double best = -std::numeric_limits<double>::infinity();  ///< signed so that larger is better
  double weight = std::numeric_limits<double>::infinity();
  int vertex = -1;      ///< number of the best known vertex
  int settled_at = -1;  ///< number of the vertex that settled the value: the first found optimal
  bool wanted = false;
  bool optimal = false;
  bool canonical = false;  ///< `vertex` is final
  bool unique = false;
  bool unbounded = false;
  bool failed = false;
  bool stateless = false;  ///< the canonical state was looked for and not found
  double dual_residual = 0;
  std::vector<int> held;  ///< inequalities that define the optimal face
  Basis proof;            ///< the basis whose reduced costs prove the value
};

/// What is known about all objectives, and the vertices that it rests on. Changed on the calling thread only,
/// between rounds.
class ObjectiveTable {
 public:
  /// `sink`: SearchOptions::sink.
  ObjectiveTable(const std::vector<Component>& components, bool canonical_states, VertexSink sink = {});

  std::int64_t count() const { return static_cast<std::int64_t>(objectives_.size()); }
  const ObjectiveProgress& operator[](std::int64_t objective) const {
    return objectives_[static_cast<std::size_t>(objective)];
  }
  ObjectiveProgress& operator[](std::int64_t objective) {
    return objectives_[static_cast<std::size_t>(objective)];
  }
  std::span<const ObjectiveProgress> all() const { return objectives_; }

  /// The best known vertex of an objective.
  const Basis& best_basis(std::int64_t objective) const { return vertex((*this)[objective].vertex).basis; }
  /// A vertex by its number, without its factors; where there is a sink, only its basis.
  const Vertex& vertex(int number) const { return vertices_[static_cast<std::size_t>(number)]; }
  int vertex_count() const { return static_cast<int>(vertices_.size()); }

  /// Objectives whose proof is still open and about which the vertex could improve what is known.
  std::vector<std::int64_t> candidates(const CheckedVertex& checked) const;

  /// Takes what tasks found, in their order. Returns the number of the vertex that each brought, −1 if it is
  /// not kept.
  std::vector<int> merge(std::vector<TaskResult> results);

  /// True if nothing more is to be done for the objective.
  bool is_settled(const ObjectiveProgress& known) const;

  const SolverWork& work() const { return work_; }
  const PaperWork& paper_work() const { return paper_work_; }

 private:
  bool is_candidate(const ObjectiveProgress& known, double better, double weight) const;
  bool take(ObjectiveVerdict& verdict, const CheckedVertex& checked, int number);
  void hand_over(const Vertex& vertex, int number, const std::vector<ObjectiveVerdict>& verdicts) const;

  bool canonical_states_;
  VertexSink sink_;
  std::vector<ObjectiveProgress> objectives_;
  std::vector<Vertex> vertices_;
  SolverWork work_;
  PaperWork paper_work_;
};

}  // namespace indet
