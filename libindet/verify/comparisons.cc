#include "libindet/verify/comparisons.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libindet/verify/rebuilt_problem.h"

namespace indet {

void Comparisons::contradict(std::string message) {
  constexpr std::size_t kShown = 20;
  ++result_.contradictions;
  if (result_.messages.size() < kShown)
    result_.messages.push_back(place_.empty() ? std::move(message) : place_ + ": " + message);
}

bool Comparisons::equal(double stored, double expected, const std::string& name, double tolerance,
                        double scale) {
  const bool same = stored == expected || (std::isnan(stored) && std::isnan(expected)) ||
                    std::abs(stored - expected) <= tolerance * std::max(scale, std::abs(expected));
  return require(same, "{}: {} is stored, {} is right", name, stored, expected);
}

bool Comparisons::equal_probability(double stored, double expected, const std::string& name) {
  constexpr double kSmallest = std::numeric_limits<double>::min();
  const double tolerance =
      tolerance::kProbabilityAgreement * std::fmax(1, -std::log(std::fmax(expected, kSmallest)));
  return equal(stored, expected, name, tolerance, kSmallest / tolerance);
}

bool Comparisons::equal_count(std::int64_t stored, std::int64_t expected, const std::string& name) {
  return require(stored == expected, "{}: {} is stored, {} is right", name, stored, expected);
}

double Comparisons::add_state(const RebuiltProblem& problem, const Eigen::VectorXd& forces) {
  const double imbalance = problem.imbalance(forces);
  const double violation = problem.violation(forces);
  ++result_.states;
  result_.worst_imbalance = std::fmax(result_.worst_imbalance, imbalance);
  result_.worst_violation = std::fmax(result_.worst_violation, violation);
  return std::max(imbalance, violation);
}

void Comparisons::add_optimum(double gap) {
  ++result_.optima;
  result_.worst_optimality_gap = std::fmax(result_.worst_optimality_gap, gap);
}

}  // namespace indet
