#pragma once

#include <array>
#include <cstdint>

namespace indet {

/// How the vertex that attains an extremum is found. Everything after that vertex (its recomputation,
/// certificates, measures) is shared, and so are all results but the work done.
enum class Method : std::uint8_t {
  kLp,               ///< linear programs by GLPK, in one of its formulations
  kPivotingPaper,    ///< the walk of Sec. II G of the paper, as it is written there
                     ///< (pivoting/neighbour_search.h)
  kPivotingTableau,  ///< the same walk on a dense tableau (pivoting/tableau_solver.h)
  kBarrier  ///< no vertex: an interval of the value, by the interior point method (barrier/lock_step.h)
};

inline constexpr std::array kMethods = {Method::kLp, Method::kPivotingPaper, Method::kPivotingTableau,
                                        Method::kBarrier};

/// Those that find vertices, the same ones but for chance.
inline constexpr std::array kVertexMethods = {Method::kLp, Method::kPivotingPaper, Method::kPivotingTableau};

/// "lp", "pivoting-paper", "pivoting-tableau", "barrier".
const char* to_string(Method method);

}  // namespace indet
