// What changes from one basis to the next: rays, ratios, rows of the tableau.
#include <algorithm>
#include <utility>

#include "libindet/exact/contact_basis.h"

namespace indet::exact {

bool ContactBasis::can_grow(int edge) const {
  const Solution change = change_by(edge);
  return std::all_of(edges_.begin(), edges_.end(),
                     [&](int e) { return sign_of(change, e) <= 0 || sign_of(*x_, e) > 0; });
}

Solution ContactBasis::change_by(int entering) const {
  const IntegerColumn column = problem_.on_independent_rows(problem_.edge(entering));
  std::vector<mpz_class> right(static_cast<std::size_t>(problem_.rank()), 0);
  for (std::size_t k = 0; k < column.row.size(); ++k)
    right[static_cast<std::size_t>(column.row[k])] = column.value[k];
  return solver_->solve(std::move(right));
}

int ContactBasis::first_blocking(int entering) const {
  const Solution change = change_by(entering);
  for (const int e : edges_) {
    if (sign_of(change, e) > 0) return e;
  }
  return -1;
}

int ContactBasis::first_vanishing(int entering) const {
  const Solution change = change_by(entering);
  struct Ratio {
    int edge;
    mpq_class lower, upper;
  };
  const auto exact_ratio = [&](int e) {
    const LinearForm strength = strength_form(e);
    return mpq_class(x_->value(strength) / change.value(strength));
  };
  std::vector<Ratio> ratios;
  for (const int e : edges_) {
    const IntegerColumn strength = strength_form(e).terms;
    if (change.sign(strength) <= 0) continue;
    Ratio& ratio = ratios.emplace_back(Ratio{e, 0, 0});
    if (x_->sign(strength) == 0) continue;
    const Solution::Bounds x = x_->bounds(strength);
    const Solution::Bounds rate = change.bounds(strength);
    ratio.lower = x.lower / rate.upper;
    ratio.upper = rate.lower > 0 ? mpq_class(x.upper / rate.lower) : exact_ratio(e);
  }
  if (ratios.empty()) return -1;
  const auto smallest = std::min_element(ratios.begin(), ratios.end(),
                                         [](const Ratio& a, const Ratio& b) { return a.upper < b.upper; });
  const mpq_class most = smallest->upper;
  std::erase_if(ratios, [&](const Ratio& ratio) { return ratio.lower > most; });
  for (Ratio& ratio : ratios) {
    if (ratios.size() > 1 && ratio.lower < ratio.upper) ratio.lower = ratio.upper = exact_ratio(ratio.edge);
  }
  return std::min_element(ratios.begin(), ratios.end(),
                          [](const Ratio& a, const Ratio& b) { return a.upper < b.upper; })
      ->edge;
}

ContactBasis::Ray ContactBasis::ray(int entering) const {
  const Solution change = change_by(entering);
  // The entering column was multiplied by 2^shift: its strength is that.
  const mpq_class own = scaled(1, problem_.edge(entering).shift);
  std::vector<mpq_class> forces;
  mpq_class largest = 0;
  for (int component = 0; component < 2 * problem_.contacts(); ++component) {
    mpq_class force = -change.value(force_form(component));
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

Solution ContactBasis::row_of(int edge) const {
  const IntegerColumn strength = strength_form(edge).terms;
  std::vector<mpz_class> right(variables_.size(), 0);
  for (std::size_t k = 0; k < strength.row.size(); ++k)
    right[static_cast<std::size_t>(strength.row[k])] = strength.value[k];
  return solver_->solve_transposed(std::move(right));
}

int ContactBasis::first_raising(int leaving, const std::vector<bool>& face) const {
  const Solution row = row_of(leaving);
  for (int e = 0; e < problem_.edges(); ++e) {
    if (is_open(e, face) && row.sign(problem_.on_independent_rows(problem_.edge(e))) < 0) return e;
  }
  return -1;
}

std::vector<double> ContactBasis::falling_motion(int leaving) const {
  return rounded_motion(row_of(leaving).exact(), 1, -1);
}

}  // namespace indet::exact
