#include "libindet/verify/steps_check.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "libindet/base/tolerances.h"

namespace indet {
namespace {

/// Whether a number is a size: 0 or more, also infinite; NaN where it is not known.
bool is_size(double number) { return !(number < 0); }

class StepsCheck {
 public:
  StepsCheck(const Packing& packing, const Limit& limit, const LimitEnd& end, const std::string& name,
             Comparisons& compare)
      : packing_(packing), limit_(limit), end_(end), name_(name), compare_(compare) {}

  void check(bool is_concave) {
    if (end_.steps.empty()) return;
    if (!compare_.require(limit_.has_way_to(end_) && end_.steps.size() >= 2,
                          "{}: there are {} steps, and yet no way there", name_, end_.steps.size()))
      return;
    const std::vector<double> values =
        step_values(limit_.present(), end_.value, static_cast<int>(end_.steps.size()) - 1);
    for (std::size_t k = 0; k < values.size(); ++k) {
      compare_.equal(end_.steps[k].value, values[k], place("value", k), tolerance::kAgreement,
                     std::abs(end_.value));
      check_step(k);
    }
    for (std::size_t k = 1; k + 1 < values.size(); ++k) {
      if (!is_concave) break;
      check_between(k, "mean_delta_R", &LimitStep::mean_delta_R);
      check_between(k, "mean_delta_T", &LimitStep::mean_delta_T);
      check_between(k, "inscribed_radius", &LimitStep::inscribed_radius);
    }
  }

 private:
  std::string place(const char* field, std::size_t k) const {
    return fmt::format("{}: steps/{}[{}]", name_, field, k);
  }

  void check_step(std::size_t k) {
    const LimitStep& step = end_.steps[k];
    const int objectives = 4 * packing_.contact_count();
    const auto require = [&](const char* field, bool holds) {
      compare_.require(holds, "{} cannot be", place(field, k));
    };
    require("doubtful", step.is_doubtful == 0 || step.is_doubtful == 1);
    if (step.dim == -1) {
      for (const StepField<double>& field : kStepNumbers) require(field.name, std::isnan(step.*field.member));
      compare_.call_unsolved(place("dim", k));
      return;
    }
    require("dim", step.dim >= end_.dim && step.dim <= 2 * packing_.contact_count());
    require("imprecise", step.imprecise >= 0 && step.imprecise <= objectives);
    require("failed", step.failed >= 0 && step.imprecise + step.failed <= objectives);
    for (const StepField<double>& field : kStepNumbers) require(field.name, is_size(step.*field.member));
    require("mean_delta_R", !(step.mean_delta_R > step.largest_delta_R));
    require("mean_delta_T", !(step.mean_delta_T > step.largest_delta_T));
    require("mean_delta_R", step.failed > 0 || !std::isnan(step.mean_delta_R));
    // A ball is as wide as its diameter, whatever the direction.
    require("inscribed_radius",
            !(2 * step.inscribed_radius > (1 + tolerance::kStepAgreement) * step.mean_width));
    require("most_sliding", std::isnan(step.sliding) == (step.most_sliding < 0) &&
                                step.most_sliding <= 2 * packing_.contact_count());
    require("sliding", !(step.sliding > step.most_sliding));
    const bool is_sampled = step.converged >= 0;
    require("converged", step.converged <= 1 && (step.dim != 0 || !is_sampled));
    const bool is_point = step.dim == 0 && step.is_doubtful == 0;
    require("r", is_sampled || is_point ? std::isfinite(step.r) && std::isfinite(step.inscribed_radius)
                                        : std::isnan(step.r));
    require("dim", (step.dim == 0) == (step.r == 0) || !is_sampled);
  }

  /// (1, λ), (cos θ, sin θ).
  Vector2 load(std::size_t k) const {
    const double value = end_.steps[k].value;
    return limit_.kind == LimitKind::kLoad ? Vector2(1, value) : Vector2(std::cos(value), std::sin(value));
  }

  void check_between(std::size_t k, const char* field, double LimitStep::*member) {
    const Vector2 before = load(k - 1);
    const Vector2 after = load(k + 1);
    const Vector2 here = load(k);
    const double det = before.x() * after.y() - before.y() * after.x();
    const double alpha = (here.x() * after.y() - here.y() * after.x()) / det;
    const double beta = (before.x() * here.y() - before.y() * here.x()) / det;
    if (!(alpha >= 0 && beta >= 0)) return;  // further apart than half a turn
    const double least = alpha * end_.steps[k - 1].*member + beta * end_.steps[k + 1].*member;
    if (!std::isfinite(least)) return;
    compare_.require(!(end_.steps[k].*member < least * (1 - tolerance::kStepAgreement)),
                     "{}: {} is stored, but those beside it tell that it is at least {}", place(field, k),
                     end_.steps[k].*member, least);
  }

  const Packing& packing_;
  const Limit& limit_;
  const LimitEnd& end_;
  const std::string& name_;
  Comparisons& compare_;
};

}  // namespace

void check_steps(const Packing& packing, const Limit& limit, const LimitEnd& end, const std::string& name,
                 bool turns_alone, Comparisons& compare) {
  const bool is_concave = limit.kind == LimitKind::kLoad || (limit.kind == LimitKind::kTilt && turns_alone);
  StepsCheck(packing, limit, end, name, compare).check(is_concave);
}

}  // namespace indet
