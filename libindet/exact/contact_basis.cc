#include "libindet/exact/contact_basis.h"

#include <algorithm>
#include <limits>

namespace indet::exact {
std::unique_ptr<ContactBasis> ContactBasis::create(const ContactProblem& problem, std::vector<int> edges) {
  if (static_cast<int>(edges.size()) != problem.rank()) return nullptr;
  std::unique_ptr<ContactBasis> basis(new ContactBasis(problem));
  std::sort(edges.begin(), edges.end());
  basis->edges_ = std::move(edges);
  basis->basic_.assign(static_cast<std::size_t>(problem.edges()), false);
  for (const int e : basis->edges_) basis->basic_[static_cast<std::size_t>(e)] = true;
  basis->first_variable_.assign(static_cast<std::size_t>(problem.contacts()), -1);
  for (int contact = 0; contact < problem.contacts(); ++contact) {
    const bool plus = basis->is_basic(2 * contact);
    const bool minus = basis->is_basic(2 * contact + 1);
    if (!plus && !minus) continue;
    basis->first_variable_[static_cast<std::size_t>(contact)] = static_cast<int>(basis->variables_.size());
    if (plus && minus) {
      basis->variables_.push_back({contact, 0, -1});
      basis->full_.push_back(&problem.normal(contact));
      basis->variables_.push_back({contact, 1, -1});
      basis->full_.push_back(&problem.tangential(contact));
    } else {
      const int edge = plus ? 2 * contact : 2 * contact + 1;
      basis->variables_.push_back({contact, 2, edge});
      basis->full_.push_back(&problem.edge(edge));
    }
  }
  for (const int e : basis->edges_) {
    if (!problem.is_slack(e)) continue;
    basis->variables_.push_back({-1, 2, e});
    basis->full_.push_back(&problem.edge(e));
  }
  for (const IntegerColumn* column : basis->full_)
    basis->columns_.push_back(problem.on_independent_rows(*column));
  std::vector<const IntegerColumn*> pointers;
  for (const IntegerColumn& column : basis->columns_) pointers.push_back(&column);
  basis->solver_ = RationalSolver::create(std::move(pointers));
  if (!basis->solver_) return nullptr;
  std::vector<mpz_class> load;
  for (const int row : problem.independent_rows())
    load.push_back(problem.load()[static_cast<std::size_t>(row)]);
  basis->x_ = basis->solver_->solve(load);
  basis->balanced_ = basis->satisfies_all_rows();
  return basis;
}

bool ContactBasis::satisfies_all_rows() const {
  if (problem_.rank() == problem_.rows()) return true;  // the solver has multiplied back
  std::vector<mpz_class> rest;
  for (const mpz_class& load : problem_.load()) rest.push_back(load * x_.denominator);
  for (std::size_t v = 0; v < full_.size(); ++v) {
    for (std::size_t k = 0; k < full_[v]->row.size(); ++k)
      rest[static_cast<std::size_t>(full_[v]->row[k])] -= full_[v]->value[k] * x_.numerator[v];
  }
  return std::all_of(rest.begin(), rest.end(), [](const mpz_class& value) { return value == 0; });
}

std::optional<std::vector<double>> ContactBasis::contradiction() const {
  for (int row = 0; row < problem_.rows(); ++row) {
    if (problem_.row_number()[static_cast<std::size_t>(row)] >= 0) continue;
    const auto entry = [row](const IntegerColumn& column) {
      const auto at = std::lower_bound(column.row.begin(), column.row.end(), row);
      if (at == column.row.end() || *at != row) return mpz_class(0);
      return column.value[static_cast<std::size_t>(at - column.row.begin())];
    };
    mpz_class rest = problem_.load()[static_cast<std::size_t>(row)] * x_.denominator;
    std::vector<mpz_class> right;
    for (std::size_t v = 0; v < full_.size(); ++v) {
      right.push_back(entry(*full_[v]));
      rest -= right.back() * x_.numerator[v];
    }
    if (rest == 0) continue;
    const RationalVector combination = solver_->solve_transposed(right);
    bool dependent = true;
    for (int e = 0; dependent && e < problem_.edges(); ++e) {
      dependent = !problem_.has_edge(e) ||
                  product(combination, e) == entry(problem_.edge(e)) * combination.denominator;
    }
    // With the row's own load b_i and that of the combination, y · b = −rest / denominator.
    if (dependent) return rounded_motion(combination, sgn(rest), row);
  }
  return {};
}

std::vector<double> ContactBasis::rounded_motion(const RationalVector& y, int sign, int more_row) const {
  mpz_class largest = more_row >= 0 ? y.denominator : mpz_class(0);
  for (const mpz_class& entry : y.numerator) largest = std::max(largest, mpz_class(abs(entry)));
  const auto share = [&](const mpz_class& entry) {
    mpq_class quotient(entry, largest);
    quotient.canonicalize();
    return sign * quotient.get_d();
  };
  std::vector<double> motion(static_cast<std::size_t>(problem_.rows()), 0);
  for (int row = 0; row < problem_.rows(); ++row) {
    const int number = problem_.row_number()[static_cast<std::size_t>(row)];
    if (number >= 0)
      motion[static_cast<std::size_t>(row)] = share(y.numerator[static_cast<std::size_t>(number)]);
  }
  if (more_row >= 0) motion[static_cast<std::size_t>(more_row)] = share(-y.denominator);
  return motion;
}

mpq_class ContactBasis::value(const RationalVector& x, std::size_t v) const {
  return scaled(x[v], full_[v]->shift);
}

std::size_t ContactBasis::first_variable(int edge) const {
  if (!problem_.is_slack(edge))
    return static_cast<std::size_t>(first_variable_[static_cast<std::size_t>(edge / 2)]);
  // Slacks are the last variables, in the order of their edges.
  const auto after = edges_.end() - std::lower_bound(edges_.begin(), edges_.end(), edge);
  return variables_.size() - static_cast<std::size_t>(after);
}

mpq_class ContactBasis::strength_in(const RationalVector& x, int edge) const {
  const std::size_t v = first_variable(edge);
  if (variables_[v].kind == 2) return value(x, v);
  const mpq_class over_mu = value(x, v + 1) / problem_.mu(edge / 2);
  return (edge % 2 == 0 ? mpq_class(value(x, v) + over_mu) : mpq_class(value(x, v) - over_mu)) / 2;
}

int ContactBasis::sign_of(const RationalVector& x, int edge) const {
  const std::size_t v = first_variable(edge);
  return variables_[v].kind == 2 ? sgn(x.numerator[v]) : sgn(strength_in(x, edge));
}

int ContactBasis::first_negative() const {
  for (const int e : edges_) {
    if (sign_of(x_, e) < 0) return e;
  }
  return -1;
}

mpq_class ContactBasis::force_in(const RationalVector& x, int component) const {
  const int contact = component / 2;
  const int first = first_variable_[static_cast<std::size_t>(contact)];
  if (first < 0) return 0;
  const auto v = static_cast<std::size_t>(first);
  if (variables_[v].kind != 2) return value(x, component % 2 == 0 ? v : v + 1);
  mpq_class force = value(x, v);
  if (component % 2 == 1) force *= variables_[v].edge % 2 == 0 ? problem_.mu(contact) : -problem_.mu(contact);
  return force;
}

mpq_class ContactBasis::force(int component) const { return force_in(x_, component) / problem_.load_scale(); }

mpq_class ContactBasis::sum(const Goal& goal) const {
  mpq_class sum = 0;
  for (const auto& [component, coefficient] : goal.terms) sum += mpq_class(coefficient) * force(component);
  for (const auto& [edge, weight] : goal.strengths) {
    if (is_basic(edge)) sum += mpq_class(weight) * strength_in(x_, edge) / problem_.load_scale();
  }
  return sum;
}

mpq_class ContactBasis::edge_cost(int edge, const Goal& goal) const {
  mpq_class cost = 0;
  const auto own = std::lower_bound(goal.strengths.begin(), goal.strengths.end(), edge,
                                    [](const auto& entry, int e) { return entry.first < e; });
  if (own != goal.strengths.end() && own->first == edge) cost += mpq_class(own->second);
  if (problem_.is_slack(edge)) return cost;
  for (const auto& [component, coefficient] : goal.terms) {
    if (component / 2 != edge / 2) continue;
    const mpq_class part = goal.sign * mpq_class(coefficient);
    if (component % 2 == 0) {
      cost += part;
    } else {
      cost +=
          edge % 2 == 0 ? mpq_class(part * problem_.mu(edge / 2)) : mpq_class(-part * problem_.mu(edge / 2));
    }
  }
  return cost;
}

mpq_class ContactBasis::cost(const Variable& variable, const Goal& goal) const {
  if (variable.kind == 2) return edge_cost(variable.edge, goal);
  mpq_class cost = 0;
  if (!goal.strengths.empty()) {  // x± = (R ± T/μ)/2
    const mpq_class plus = edge_cost(2 * variable.contact, goal);
    const mpq_class minus = edge_cost(2 * variable.contact + 1, goal);
    if (variable.kind == 0) return (plus + minus) / 2;
    return (plus - minus) / (2 * problem_.mu(variable.contact));
  }
  for (const auto& [component, coefficient] : goal.terms) {
    if (component == 2 * variable.contact + variable.kind) cost += goal.sign * mpq_class(coefficient);
  }
  return cost;
}

ContactBasis::Multipliers ContactBasis::multipliers(const Goal& goal) const {
  std::vector<mpq_class> costs;
  Multipliers result;
  for (std::size_t v = 0; v < variables_.size(); ++v) {
    costs.push_back(scaled(cost(variables_[v], goal), full_[v]->shift));
    result.scale = lcm(result.scale, costs.back().get_den());
  }
  std::vector<mpz_class> right;
  for (const mpq_class& c : costs) right.push_back(c.get_num() * (result.scale / c.get_den()));
  result.y = solver_->solve_transposed(right);
  return result;
}

mpz_class ContactBasis::product(const RationalVector& y, int edge) const {
  const IntegerColumn& column = problem_.edge(edge);
  mpz_class sum = 0;
  for (std::size_t k = 0; k < column.row.size(); ++k) {
    const int row = problem_.row_number()[static_cast<std::size_t>(column.row[k])];
    if (row >= 0) sum += column.value[k] * y.numerator[static_cast<std::size_t>(row)];
  }
  return sum;
}

int ContactBasis::sign_of_cost(int edge, const Goal& goal, const Multipliers& multipliers,
                               const mpz_class& scale) const {
  const mpz_class priced = product(multipliers.y, edge);
  const mpq_class own = edge_cost(edge, goal);
  return own == 0 ? -sgn(priced) : sgn(mpq_class(scaled(own, problem_.edge(edge).shift) * scale - priced));
}

int ContactBasis::first_improving(const Goal& goal, const Multipliers& multipliers,
                                  const std::vector<bool>& face) const {
  const mpz_class scale = multipliers.scale * multipliers.y.denominator;
  for (int e = 0; e < problem_.edges(); ++e) {
    if (is_open(e, face) && sign_of_cost(e, goal, multipliers, scale) > 0) return e;
  }
  return -1;
}

std::vector<bool> ContactBasis::optimal_face(const Goal& goal, const Multipliers& multipliers,
                                             const std::vector<bool>& face) const {
  const mpz_class scale = multipliers.scale * multipliers.y.denominator;
  std::vector<bool> result(static_cast<std::size_t>(problem_.edges()), false);
  for (int e = 0; e < problem_.edges(); ++e) {
    result[static_cast<std::size_t>(e)] =
        is_basic(e) || (is_open(e, face) && sign_of_cost(e, goal, multipliers, scale) == 0);
  }
  return result;
}

std::vector<int> ContactBasis::outside(const std::vector<bool>& face) const {
  std::vector<int> edges;
  for (int e = 0; e < problem_.edges(); ++e) {
    if (is_open(e, face)) edges.push_back(e);
  }
  return edges;
}

bool ContactBasis::can_grow(int edge) const {
  const RationalVector change = change_by(edge);
  return std::all_of(edges_.begin(), edges_.end(),
                     [&](int e) { return sign_of(change, e) <= 0 || sign_of(x_, e) > 0; });
}

RationalVector ContactBasis::change_by(int entering) const {
  const IntegerColumn column = problem_.on_independent_rows(problem_.edge(entering));
  std::vector<mpz_class> right(static_cast<std::size_t>(problem_.rank()), 0);
  for (std::size_t k = 0; k < column.row.size(); ++k)
    right[static_cast<std::size_t>(column.row[k])] = column.value[k];
  return solver_->solve(right);
}

int ContactBasis::first_blocking(int entering) const {
  const RationalVector change = change_by(entering);
  for (const int e : edges_) {
    if (sign_of(change, e) > 0) return e;
  }
  return -1;
}

ContactBasis::Ray ContactBasis::ray(int entering) const {
  const RationalVector change = change_by(entering);
  // The entering column was multiplied by 2^shift: its strength is that.
  const mpq_class own = scaled(1, problem_.edge(entering).shift);
  std::vector<mpq_class> forces;
  mpq_class largest = 0;
  for (int component = 0; component < 2 * problem_.contacts(); ++component) {
    mpq_class force = -force_in(change, component);
    if (!problem_.is_slack(entering) && component / 2 == entering / 2) {
      mpq_class share = own;
      if (component % 2 == 1)
        share *= entering % 2 == 0 ? problem_.mu(entering / 2) : -problem_.mu(entering / 2);
      force += share;
    }
    largest = std::max(largest, mpq_class(abs(force)));
    forces.push_back(std::move(force));
  }
  Ray ray;
  for (const mpq_class& force : forces) ray.forces.push_back(mpq_class(force / largest).get_d());
  ray.grows.assign(static_cast<std::size_t>(problem_.edges()), false);
  for (const int e : edges_) ray.grows[static_cast<std::size_t>(e)] = sign_of(change, e) < 0;
  ray.grows[static_cast<std::size_t>(entering)] = true;
  return ray;
}

RationalVector ContactBasis::row_of(int edge) const {
  // μR ± T (a positive multiple of x±), or x itself.
  const std::size_t v = first_variable(edge);
  std::vector<mpq_class> functional(variables_.size(), 0);
  if (variables_[v].kind == 2) {
    functional[v] = 1;
  } else {
    functional[v] = scaled(problem_.mu(edge / 2), full_[v]->shift);
    functional[v + 1] = scaled(mpq_class(edge % 2 == 0 ? 1 : -1), full_[v + 1]->shift);
  }
  mpz_class scale = 1;
  for (const mpq_class& f : functional) scale = lcm(scale, f.get_den());
  std::vector<mpz_class> right;
  for (const mpq_class& f : functional) right.push_back(f.get_num() * (scale / f.get_den()));
  return solver_->solve_transposed(right);
}

int ContactBasis::first_raising(int leaving, const std::vector<bool>& face) const {
  const RationalVector row = row_of(leaving);
  for (int e = 0; e < problem_.edges(); ++e) {
    if (is_open(e, face) && product(row, e) < 0) return e;
  }
  return -1;
}

std::vector<double> ContactBasis::falling_motion(int leaving) const {
  return rounded_motion(row_of(leaving), 1, -1);
}

std::shared_ptr<const ContactBasis> basis_at(const Packing& packing, const ContactProblem& problem,
                                             std::span<const double> forces,
                                             std::span<const std::int32_t> zero_edges) {
  std::vector<double> preference = edge_strengths(packing, forces);
  for (const std::int32_t e : zero_edges) {
    if (e >= 0) preference[static_cast<std::size_t>(e)] = -std::numeric_limits<double>::infinity();
  }
  return ContactBasis::create(problem, problem.choose_basis(preference));
}

}  // namespace indet::exact
