#pragma once

#include <array>

namespace indet {

/// Which of the states that attain an optimum dR and dT are the distances of.
struct WhichStates {
  const char* name;
  const char* which;       ///< For captions.
  const char* normal;      ///< Column of /table/contacts.
  const char* tangential;  ///< The same.
};

constexpr WhichStates kWalkChoice = {
    "the paper's walk",
    "where many states attain an optimum, the state in which the walk of Sec. II G ends: each starts from "
    "the first extremal point of the packing, and goes to the first neighbour found that is better",
    "paper_d_R", "paper_d_T"};
constexpr WhichStates kSolverChoice = {
    "solver's vertices", "where many states attain an optimum, the state that the solver happens to find",
    "solver_d_R", "solver_d_T"};
constexpr WhichStates kCanonicalChoice = {
    "canonical states", "where many states attain an optimum, the one of smallest total normal force", "d_R",
    "d_T"};
constexpr WhichStates kNearestChoice = {
    "smallest distance",
    "that of the nearest two of all states of smallest and of largest force, so that there is no choice",
    "d_R_min", "d_T_min"};
constexpr std::array<WhichStates, 4> kChoicesOfStates = {kWalkChoice, kSolverChoice, kCanonicalChoice,
                                                         kNearestChoice};

}  // namespace indet
