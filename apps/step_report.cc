#include "apps/step_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "apps/ranges_json.h"
#include "apps/say.h"
#include "libindet/base/counted.h"

namespace indet::app {
namespace {

std::string number_text(double number, int digits = 4) {
  if (std::isnan(number)) return "–";
  if (std::isinf(number)) return "∞";
  return fmt::format("{:.{}g}", number, digits);
}

std::string value_text(const Limit& limit, double value) {
  if (limit.kind == LimitKind::kTilt) return fmt::format("{:.5g}°", value * 180 / std::numbers::pi);
  return fmt::format("{:.6g}", value);
}

const char* value_name(LimitKind kind) {
  switch (kind) {
    case LimitKind::kTilt:
      return "angle";
    case LimitKind::kLoad:
      return "multiple";
    case LimitKind::kFriction:
      return "factor";
  }
  return "?";
}

constexpr std::size_t kColumns = 10;

void print_row(const std::array<std::string, kColumns>& cells) {
  say("    {:>11}  {:>5}", cells[0], cells[1]);
  for (std::size_t k = 2; k < kColumns; ++k) say(" {:>8}", cells[k]);
  say("\n");
}

/// What is wrong with steps.
void print_doubts(const std::vector<LimitStep>& steps) {
  const auto print = [&](const char* what, auto is_so) {
    const auto count = std::count_if(steps.begin(), steps.end(), is_so);
    if (count > 0) say("    at {} {}\n", counted(count, "step"), what);
  };
  print("there is no state within rounding", [](const LimitStep& s) { return s.dim < 0; });
  print("rounding decides what F is, so that nothing is certain",
        [](const LimitStep& s) { return s.dim >= 0 && s.is_doubtful != 0; });
  print("some forces are imprecise", [](const LimitStep& s) { return s.imprecise > 0; });
  print("the range of some force was not found", [](const LimitStep& s) { return s.failed > 0; });
  print("the uniform sample did not converge", [](const LimitStep& s) { return s.converged == 0; });
  print("the mean width was not found",
        [](const LimitStep& s) { return s.converged >= 0 && std::isnan(s.mean_width); });
}

/// The largest of the standard errors, relative.
template <class Error, class Number>
double largest_error(const std::vector<LimitStep>& steps, Error error, Number number) {
  double largest = 0;
  for (const LimitStep& step : steps) largest = std::fmax(largest, step.*error / step.*number);
  return largest;
}

}  // namespace

void print_steps(const Limit& limit, const LimitEnd& end) {
  if (end.steps.empty()) return;
  say("    on the way there (mg; r: radius of the uniform distribution, ball: radius of the largest ball in "
      "F,\n"
      "    width: mean width of F, M_s: mean over a uniform sample)\n");
  print_row({value_name(limit.kind), "dim F", "mean δR", "max δR", "mean δT", "max δT", "r", "ball", "width",
             "M_s"});
  for (const LimitStep& step : end.steps) {
    const bool is_last = &step == &end.steps.back();
    print_row({is_last ? "just before" : value_text(limit, step.value),
               step.dim < 0 ? "–" : fmt::format("{}", step.dim), number_text(step.mean_delta_R),
               number_text(step.largest_delta_R), number_text(step.mean_delta_T),
               number_text(step.largest_delta_T), number_text(step.r, 3), number_text(step.inscribed_radius),
               number_text(step.mean_width, 3), number_text(step.sliding, 2)});
  }
  const double r_error = largest_error(end.steps, &LimitStep::r_error, &LimitStep::r);
  const double width_error = largest_error(end.steps, &LimitStep::mean_width_error, &LimitStep::mean_width);
  if (r_error > 0) say("    standard errors: r {:.1f} %, width {:.1f} %\n", 100 * r_error, 100 * width_error);
  print_doubts(end.steps);
}

nlohmann::json steps_to_json(const std::vector<LimitStep>& steps) {
  nlohmann::json list = nlohmann::json::array();
  for (const LimitStep& step : steps) {
    nlohmann::json json = {{"value", json_number(step.value)}};
    for (const StepField<double>& field : kStepNumbers) json[field.name] = json_number(step.*field.member);
    for (const StepField<int>& field : kStepCounts) json[field.name] = step.*field.member;
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace indet::app
