#include "libindet/exact/contact_basis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace indet::exact {
namespace {

mpz_class entry(const IntegerColumn& column, int row) {
  const auto at = std::lower_bound(column.row.begin(), column.row.end(), row);
  if (at == column.row.end() || *at != row) return 0;
  return column.value[static_cast<std::size_t>(at - column.row.begin())];
}

/// The numbers times the smallest one that makes them whole, which is returned.
mpz_class make_whole(const std::vector<mpq_class>& numbers, std::vector<mpz_class>& whole) {
  mpz_class scale = 1;
  for (const mpq_class& number : numbers) scale = lcm(scale, number.get_den());
  for (const mpq_class& number : numbers) whole.push_back(number.get_num() * (scale / number.get_den()));
  return scale;
}

}  // namespace

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
  basis->solver_ = BasisSolver::create(std::move(pointers));
  if (!basis->solver_) return nullptr;
  std::vector<mpz_class> load;
  for (const int row : problem.independent_rows())
    load.push_back(problem.load()[static_cast<std::size_t>(row)]);
  basis->x_ = basis->solver_->solve(std::move(load));
  return basis;
}

bool ContactBasis::is_balanced() const {
  if (problem_.rank() == problem_.rows() || problem_.is_consistent()) return true;
  const long shift = most_shift();
  for (int row = 0; row < problem_.rows(); ++row) {
    if (problem_.row_number()[static_cast<std::size_t>(row)] < 0 && missing_load(row, shift) != 0)
      return false;
  }
  return true;
}

long ContactBasis::most_shift() const {
  long most = 0;
  for (const IntegerColumn* column : full_) most = std::max(most, column->shift);
  return most;
}

mpz_class ContactBasis::missing_load(int row, long most_shift) const {
  const RationalVector& x = x_->exact();
  mpz_class rest = problem_.load()[static_cast<std::size_t>(row)] * x.denominator;
  rest <<= static_cast<mp_bitcnt_t>(most_shift);
  for (std::size_t v = 0; v < full_.size(); ++v)
    rest -= (entry(*full_[v], row) * x.numerator[v])
            << static_cast<mp_bitcnt_t>(most_shift - full_[v]->shift);
  return rest;
}

std::optional<std::vector<double>> ContactBasis::contradiction() const {
  const long shift = most_shift();
  for (int row = 0; row < problem_.rows(); ++row) {
    if (problem_.row_number()[static_cast<std::size_t>(row)] >= 0) continue;
    const mpz_class rest = missing_load(row, shift);
    if (rest == 0) continue;
    std::vector<mpz_class> right;
    for (const IntegerColumn* column : full_)
      right.push_back(entry(*column, row) << static_cast<mp_bitcnt_t>(shift - column->shift));
    const Solution combination = solver_->solve_transposed(std::move(right));
    bool dependent = true;
    for (int e = 0; dependent && e < problem_.edges(); ++e) {
      const IntegerColumn& column = problem_.edge(e);
      dependent = !problem_.has_edge(e) ||
                  combination.compare(problem_.on_independent_rows(column),
                                      scaled(mpq_class(entry(column, row)), shift - column.shift)) == 0;
    }
    if (!dependent) continue;
    RationalVector y = combination.exact();
    y.denominator <<= static_cast<mp_bitcnt_t>(shift);
    // With the row's own load b_i and that of the combination, y · b = −rest / denominator.
    return rounded_motion(y, sgn(rest), row);
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

std::size_t ContactBasis::first_variable(int edge) const {
  if (!problem_.is_slack(edge))
    return static_cast<std::size_t>(first_variable_[static_cast<std::size_t>(edge / 2)]);
  // Slacks are the last variables, in the order of their edges.
  const auto after = edges_.end() - std::lower_bound(edges_.begin(), edges_.end(), edge);
  return variables_.size() - static_cast<std::size_t>(after);
}

LinearForm ContactBasis::strength_form(int edge) const {
  const std::size_t v = first_variable(edge);
  const int first = static_cast<int>(v);
  if (variables_[v].kind == 2) return {{{first}, {1}, 0}, 1};
  // (R ± T/μ)/2
  const mpq_class& mu = problem_.mu(edge / 2);
  const mpz_class T = edge % 2 == 0 ? mu.get_den() : mpz_class(-mu.get_den());
  return {{{first, first + 1}, {mu.get_num(), T}, 0}, 2 * mu.get_num()};
}

LinearForm ContactBasis::force_form(int component) const {
  const int contact = component / 2;
  const int first = first_variable_[static_cast<std::size_t>(contact)];
  if (first < 0) return {};
  const Variable& variable = variables_[static_cast<std::size_t>(first)];
  if (variable.kind != 2) return {{{first + component % 2}, {1}, 0}, 1};
  if (component % 2 == 0) return {{{first}, {1}, 0}, 1};
  const mpq_class& mu = problem_.mu(contact);
  return {{{first}, {variable.edge % 2 == 0 ? mu.get_num() : mpz_class(-mu.get_num())}, 0}, mu.get_den()};
}

LinearForm ContactBasis::form_of(const Goal& goal) const {
  std::map<int, mpq_class> shares;
  const auto add = [&](const LinearForm& form, double factor) {
    for (std::size_t k = 0; k < form.terms.row.size(); ++k)
      shares[form.terms.row[k]] += mpq_class(factor) * form.terms.value[k] / form.divisor;
  };
  for (const auto& [component, coefficient] : goal.terms) add(force_form(component), coefficient);
  for (const auto& [edge, weight] : goal.strengths) {
    if (is_basic(edge)) add(strength_form(edge), weight);
  }
  LinearForm form;
  std::vector<mpq_class> values;
  for (auto& [variable, share] : shares) {
    form.terms.row.push_back(variable);
    values.push_back(std::move(share));
  }
  form.divisor = make_whole(values, form.terms.value) * problem_.load_scale();
  return form;
}

int ContactBasis::first_negative() const {
  for (const int e : edges_) {
    if (sign_of(*x_, e) < 0) return e;
  }
  return -1;
}

mpq_class ContactBasis::force(int component) const {
  return x_->value(force_form(component)) / problem_.load_scale();
}

std::vector<double> ContactBasis::nearest_forces() const {
  std::vector<double> forces;
  for (int component = 0; component < 2 * problem_.contacts(); ++component) {
    LinearForm form = force_form(component);
    form.divisor *= problem_.load_scale();
    forces.push_back(x_->nearest(form));
  }
  return forces;
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
  for (const Variable& variable : variables_) costs.push_back(cost(variable, goal));
  std::vector<mpz_class> right;
  const mpz_class scale = make_whole(costs, right);
  return {solver_->solve_transposed(std::move(right)), scale};
}

std::vector<double> ContactBasis::motion(const Multipliers& multipliers) const {
  std::vector<double> motion(static_cast<std::size_t>(problem_.rows()), 0);
  double largest = 0;
  for (std::size_t row = 0; row < motion.size(); ++row) {
    const int number = problem_.row_number()[row];
    if (number >= 0) motion[row] = multipliers.y.nearest({{{number}, {1}, 0}, 1});
    largest = std::max(largest, std::abs(motion[row]));
  }
  for (double& velocity : motion) velocity /= largest;
  return motion;
}

int ContactBasis::sign_of_cost(int edge, const Goal& goal, const Multipliers& multipliers) const {
  return -multipliers.y.compare(problem_.on_independent_rows(problem_.edge(edge)),
                                edge_cost(edge, goal) * multipliers.scale);
}

int ContactBasis::first_improving(const Goal& goal, const Multipliers& multipliers,
                                  const std::vector<bool>& face) const {
  for (int e = 0; e < problem_.edges(); ++e) {
    if (is_open(e, face) && sign_of_cost(e, goal, multipliers) > 0) return e;
  }
  return -1;
}

std::vector<bool> ContactBasis::optimal_face(const Goal& goal, const Multipliers& multipliers,
                                             const std::vector<bool>& face) const {
  std::vector<bool> result(static_cast<std::size_t>(problem_.edges()), false);
  for (int e = 0; e < problem_.edges(); ++e) {
    result[static_cast<std::size_t>(e)] =
        is_basic(e) || (is_open(e, face) && sign_of_cost(e, goal, multipliers) == 0);
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
