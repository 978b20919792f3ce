#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "libindet/exact/basis_solver.h"
#include "libindet/exact/contact_problem.h"

namespace indet::exact {

/// What is to be maximised: sign · Σ coefficient · force, of R_α (component 2α) and T_α (component 2α + 1),
/// or Σ weight · strength of edges. Coefficients and weights are taken as they are.
struct Goal {
  std::vector<std::pair<int, double>> terms;  ///< (component, coefficient)
  int sign = 1;
  std::vector<std::pair<int, double>> strengths = {};  ///< (edge, weight), ascending

  Goal(int component, int direction) : terms{{component, 1.0}}, sign(direction) {}
  Goal(std::vector<std::pair<int, double>> sum, int direction) : terms(std::move(sum)), sign(direction) {}
  /// Σ weight · strength.
  static Goal of_strengths(std::vector<std::pair<int, double>> sum) {
    Goal goal(std::vector<std::pair<int, double>>(), 1);
    goal.strengths = std::move(sum);
    return goal;
  }
};

/// A basis of the exact problem: rank() independent edges; all others have strength 0. The forces x_B = B⁻¹
/// b, the multipliers y = B⁻ᵀ c_B and reduced costs c_e − y·A_e, without rounding: rational numbers are found
/// only where enclosures do not decide what is asked (Solution).
class ContactBasis {
 public:
  /// Nothing if the edges are not independent, or not rank() many. `problem` must outlive the basis.
  static std::unique_ptr<ContactBasis> create(const ContactProblem& problem, std::vector<int> edges);

  const std::vector<int>& edges() const { return edges_; }  ///< basic ones, ascending
  bool is_basic(int edge) const { return basic_[static_cast<std::size_t>(edge)]; }

  /// Whether x_B satisfies all equations, those that are left out as dependent included.
  bool is_balanced() const;
  /// If not: what contradicts every solution, if an equation that x_B violates is a combination of the
  /// independent ones with another right-hand side: a motion, one velocity a row, under which every edge
  /// rests and the load does work. Nothing if it is not such a combination. Rounded, largest entry 1.
  std::optional<std::vector<double>> contradiction() const;
  /// The basic edge of smallest number with a negative strength, or −1.
  int first_negative() const;
  /// R_α (component 2α) or T_α (2α + 1), in the scene's own units.
  mpq_class force(int component) const;
  /// All R and T in turn, each rounded to the nearest double.
  std::vector<double> nearest_forces() const;
  /// x of an edge, up to load_scale(), which has no part in its sign.
  int sign_of_strength(int edge) const { return is_basic(edge) ? sign_of(*x_, edge) : 0; }
  /// The sum of a goal, without its sign; and a number that stands for it beside doubles (Solution).
  mpq_class sum(const Goal& goal) const { return x_->value(form_of(goal)); }
  mpq_class stand_in(const Goal& goal) const { return x_->stand_in(form_of(goal)); }
  /// Whether the forces were needed as rational numbers so far.
  bool is_rational() const { return x_->is_rational(); }

  /// y, one an independent row, up to a positive factor that is returned beside it.
  struct Multipliers {
    Solution y;
    mpz_class scale = 1;  ///< true multipliers are y / scale
  };
  Multipliers multipliers(const Goal& goal) const;
  /// y as a motion, one velocity a row. Rounded, largest entry 1.
  std::vector<double> motion(const Multipliers& multipliers) const;
  /// The edge of smallest number with a positive reduced cost, or −1. Here and below, of those of a face:
  /// that is, where `face` is not empty, of edges that are set in it; the others are held at 0.
  int first_improving(const Goal& goal, const Multipliers& multipliers, const std::vector<bool>& face) const;
  /// At an optimum: the face on which the goal is as large, that is without edges of a negative reduced cost.
  std::vector<bool> optimal_face(const Goal& goal, const Multipliers& multipliers,
                                 const std::vector<bool>& face = {}) const;
  /// The edges of a face that are not basic, ascending: where there is none, it has one state.
  std::vector<int> outside(const std::vector<bool>& face) const;
  /// Whether the strength of an edge that is not basic can grow from 0, all basic ones being feasible.
  bool can_grow(int edge) const;

  /// Entering edge e: the basic edge of smallest number whose strength falls as x_e grows, or −1: then
  /// x_e = 1, x_B = −B⁻¹ A_e is a recession ray.
  int first_blocking(int entering) const;
  /// The same of those whose strength vanishes first. Precondition: none is negative.
  int first_vanishing(int entering) const;
  /// That ray: R and T of each contact, and the strength of each edge, up to one positive factor (forces:
  /// largest entry 1). Rounded; what is 0 exactly is 0.
  struct Ray {
    std::vector<double> forces;  ///< 2M
    std::vector<bool> grows;     ///< of each edge: its strength grows
  };
  Ray ray(int entering) const;
  /// Leaving edge e of negative strength: the nonbasic edge of smallest number that can raise it, or −1: then
  /// the problem has no solution (Farkas).
  int first_raising(int leaving, const std::vector<bool>& face) const;
  /// That proof: a motion, one velocity a row, that no edge resists and under which the load does work.
  /// Rounded, largest entry 1.
  std::vector<double> falling_motion(int leaving) const;

 private:
  explicit ContactBasis(const ContactProblem& problem) : problem_(problem) {}
  struct Variable {
    int contact = 0;
    int kind = 0;  ///< 0: R of a contact with both edges, 1: its T; 2: an edge, or a slack (contact −1)
    int edge = -1;
  };
  bool is_open(int edge, const std::vector<bool>& face) const {
    return !is_basic(edge) && problem_.has_edge(edge) &&
           (face.empty() || face[static_cast<std::size_t>(edge)]);
  }
  mpq_class cost(const Variable& variable, const Goal& goal) const;
  mpq_class edge_cost(int edge, const Goal& goal) const;
  /// Sign of the reduced cost of an edge that is not basic.
  int sign_of_cost(int edge, const Goal& goal, const Multipliers& multipliers) const;
  /// How x_B falls as the strength of this edge grows.
  Solution change_by(int entering) const;
  /// Strength of this edge as a functional of the basic variables, solved with Bᵀ, up to a positive factor.
  Solution row_of(int edge) const;
  /// As functionals of the variables: R or T; the strength of a basic edge; a goal's sum, without its sign.
  /// Of x_, the load's scale is undone.
  LinearForm force_form(int component) const;
  LinearForm strength_form(int edge) const;
  LinearForm form_of(const Goal& goal) const;
  /// Sign of the strength of a basic edge in a solution.
  int sign_of(const Solution& x, int edge) const { return x.sign(strength_form(edge).terms); }
  /// A motion of the independent rows, times a sign, on all rows; in addition that of one more.
  std::vector<double> rounded_motion(const RationalVector& y, int sign, int more_row) const;
  /// The variable of a basic edge, or of R where both of its contact's edges are basic.
  std::size_t first_variable(int edge) const;
  /// What a row misses of its load, times a positive number. Precondition: the most shift of all variables.
  mpz_class missing_load(int row, long most_shift) const;
  long most_shift() const;

  const ContactProblem& problem_;
  std::vector<int> edges_;
  std::vector<bool> basic_;
  std::vector<Variable> variables_;
  std::vector<int> first_variable_;  ///< of each contact, −1 if it has none
  std::vector<const IntegerColumn*> full_;
  std::vector<IntegerColumn> columns_;  ///< on the independent rows
  std::unique_ptr<BasisSolver> solver_;
  std::optional<Solution> x_;  ///< times load_scale()
};

/// The basis next to a state in double precision (2M forces): its strongest edges, and of those named as zero
/// (−1: none) no more than are needed. Nothing if that is singular.
std::shared_ptr<const ContactBasis> basis_at(const Packing& packing, const ContactProblem& problem,
                                             std::span<const double> forces,
                                             std::span<const std::int32_t> zero_edges);

}  // namespace indet::exact
