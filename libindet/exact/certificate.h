#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "libindet/exact/contact_problem.h"
#include "libindet/exact/rational_solver.h"

namespace indet::exact {

/// A virtual motion, one velocity a row (x, y, and rω times its spin_scale of each disk;
/// a rate of compression times compression_scale), over the rational
/// numbers.
class Motion {
 public:
  /// The motion with no power at any of `still` edges, and none of the load if `against_load` is not set,
  /// whose other velocities are those of `guess` (one a row): the degrees of freedom that the conditions
  /// leave are taken from the guess, the rest follows exactly. So a motion that satisfies the conditions up
  /// to rounding becomes one that satisfies them. Nothing if the conditions leave no motion but rest.
  static std::optional<Motion> repair(const ContactProblem& problem, std::span<const int> still,
                                      bool against_load, std::span<const double> guess);

  /// Sign of the power of a force along this edge.
  int edge_power(int edge) const;
  /// Sign of the power of the load.
  int load_power() const;
  /// Adds the smallest multiple of the other motion with which no force along these edges has a negative
  /// power. Precondition: the other opens at each of them.
  void open(std::span<const int> edges, const Motion& other);
  /// In double precision, largest entry 1.
  std::vector<double> rounded() const;

 private:
  Motion(const ContactProblem& problem, RationalVector velocity)
      : problem_(&problem), velocity_(std::move(velocity)) {}
  const ContactProblem* problem_;
  RationalVector velocity_;
};

/// A step in which edges were closed, that is found to be 0 in every state, with the motion that proves it.
struct Closing {
  std::vector<int> edges;      ///< closed in this step
  std::vector<double> motion;  ///< one a row
};

/// True if the motion nearest to the guess that opens or rests at every edge and lets the load do work
/// exists, so that the packing cannot stand (Farkas). Edges whose power in the guess is below `zero` are held
/// at exactly 0.
bool proves_emptiness(const ContactProblem& problem, std::span<const double> guess, double zero);

/// A motion, one velocity a row and largest entry 1, of which proves_emptiness() holds. The guess may be
/// resisted by edges of `closings`: multiples of the motions that close them are added. Entries of the guess
/// up to `zero`, relative to the largest, are taken for rounding where the proof does without them. Nothing
/// if a closing or the motion cannot be proven.
std::optional<std::vector<double>> find_falling_motion(const ContactProblem& problem,
                                                       std::span<const double> guess,
                                                       std::span<const Closing> closings, double zero);

/// True if the rank of the equations is ContactProblem::rank(), which is a lower bound by itself.
bool proves_rank(const ContactProblem& problem);

/// True if each step's edges are 0 in every state (a motion exists under which they open, the load does no
/// work, and every edge that stays open rests), and the equations of the edges that stay open in the end have
/// exactly the given rank and do not contradict each other (not asked if no rank is given). Of a row
/// that is not independent the cost grows with the cube of the number of rows from which it follows, unless
/// it is their sum with small whole numbers (all forces of a cell along x add up to 0): with more than
/// `most_rows` of them nothing is proven.
bool proves_structure(const ContactProblem& problem, std::span<const Closing> closings,
                      std::optional<int> final_rank,
                      std::size_t most_rows = std::numeric_limits<std::size_t>::max());

}  // namespace indet::exact
