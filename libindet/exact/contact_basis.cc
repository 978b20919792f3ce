#include "libindet/exact/contact_basis.h"

#include <algorithm>

namespace indet::exact {
namespace {

IntegerColumn on_rows(const IntegerColumn& column, const std::vector<int>& row_number) {
  IntegerColumn result;
  result.shift = column.shift;
  for (std::size_t k = 0; k < column.row.size(); ++k) {
    const int row = row_number[static_cast<std::size_t>(column.row[k])];
    if (row < 0) continue;
    result.row.push_back(row);
    result.value.push_back(column.value[k]);
  }
  return result;
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
  for (const IntegerColumn* column : basis->full_)
    basis->columns_.push_back(on_rows(*column, problem.row_number()));
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

bool ContactBasis::proves_contradiction() const {
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
    if (dependent) return true;
  }
  return false;
}

mpq_class ContactBasis::value(const RationalVector& x, std::size_t v) const {
  return scaled(x[v], full_[v]->shift);
}

int ContactBasis::sign_of(const RationalVector& x, int edge) const {
  const int contact = edge / 2;
  const auto v = static_cast<std::size_t>(first_variable_[static_cast<std::size_t>(contact)]);
  if (variables_[v].kind == 2) return sgn(x.numerator[v]);
  // 2μx± = μR ± T
  const mpq_class R = scaled(mpq_class(x.numerator[v]), full_[v]->shift);
  const mpq_class T = scaled(mpq_class(x.numerator[v + 1]), full_[v + 1]->shift);
  const mpq_class limit = problem_.mu(contact) * R;
  return edge % 2 == 0 ? sgn(mpq_class(limit + T)) : sgn(mpq_class(limit - T));
}

int ContactBasis::first_negative() const {
  for (const int e : edges_) {
    if (sign_of(x_, e) < 0) return e;
  }
  return -1;
}

mpq_class ContactBasis::force(int component) const {
  const int contact = component / 2;
  const int first = first_variable_[static_cast<std::size_t>(contact)];
  if (first < 0) return 0;
  const auto v = static_cast<std::size_t>(first);
  mpq_class force;
  if (variables_[v].kind == 2) {
    force = value(x_, v);
    if (component % 2 == 1)
      force *= variables_[v].edge % 2 == 0 ? problem_.mu(contact) : -problem_.mu(contact);
  } else {
    force = value(x_, component % 2 == 0 ? v : v + 1);
  }
  return force / problem_.load_scale();
}

mpq_class ContactBasis::sum(const Goal& goal) const {
  mpq_class sum = 0;
  for (const auto& [component, coefficient] : goal.terms) sum += mpq_class(coefficient) * force(component);
  return sum;
}

mpq_class ContactBasis::edge_cost(int edge, const Goal& goal) const {
  mpq_class cost = 0;
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

int ContactBasis::first_improving(const Goal& goal, const Multipliers& multipliers) const {
  const mpz_class scale = multipliers.scale * multipliers.y.denominator;
  for (int e = 0; e < problem_.edges(); ++e) {
    if (is_basic(e) || !problem_.has_edge(e)) continue;
    const mpz_class priced = product(multipliers.y, e);
    const mpq_class own = edge_cost(e, goal);
    const int sign =
        own == 0 ? -sgn(priced) : sgn(mpq_class(scaled(own, problem_.edge(e).shift) * scale - priced));
    if (sign > 0) return e;
  }
  return -1;
}

int ContactBasis::first_blocking(int entering) const {
  const IntegerColumn column = on_rows(problem_.edge(entering), problem_.row_number());
  std::vector<mpz_class> right(static_cast<std::size_t>(problem_.rank()), 0);
  for (std::size_t k = 0; k < column.row.size(); ++k)
    right[static_cast<std::size_t>(column.row[k])] = column.value[k];
  const RationalVector change = solver_->solve(right);
  for (const int e : edges_) {
    if (sign_of(change, e) > 0) return e;
  }
  return -1;
}

int ContactBasis::first_raising(int leaving) const {
  // The strength of the leaving edge as a functional of the variables: μR ± T (a positive multiple), or x
  // itself.
  const int contact = leaving / 2;
  const auto v = static_cast<std::size_t>(first_variable_[static_cast<std::size_t>(contact)]);
  std::vector<mpq_class> functional(variables_.size(), 0);
  if (variables_[v].kind == 2) {
    functional[v] = 1;
  } else {
    functional[v] = scaled(problem_.mu(contact), full_[v]->shift);
    functional[v + 1] = scaled(mpq_class(leaving % 2 == 0 ? 1 : -1), full_[v + 1]->shift);
  }
  mpz_class scale = 1;
  for (const mpq_class& f : functional) scale = lcm(scale, f.get_den());
  std::vector<mpz_class> right;
  for (const mpq_class& f : functional) right.push_back(f.get_num() * (scale / f.get_den()));
  const RationalVector row = solver_->solve_transposed(right);
  for (int e = 0; e < problem_.edges(); ++e) {
    if (!is_basic(e) && problem_.has_edge(e) && product(row, e) < 0) return e;
  }
  return -1;
}

}  // namespace indet::exact
