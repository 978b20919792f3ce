#include "apps/account_report.h"

#include <fmt/format.h>

#include <numbers>
#include <string>

#include "apps/say.h"
#include "apps/wording.h"

namespace indet::app {
namespace {

void print_radius(const Account& s) {
  print_line("  radius r", fmt::format("{} ± {} mg; distances from the centre vary by {} mg", s.text_of("r"),
                                       s.text_of("r_error", "{:.2g}"), s.text_of("spread")));
}

void print_uniform_sampling(const Account& s) {
  print_line("samples", fmt::format("{} of the uniform distribution, dimension {}, {}",
                                    s.text_of("samples", "{:.0f}"), s.text_of("dim", "{:.0f}"),
                                    s.text_of("converged", "{:.0f}") == "1" ? "converged" : "NOT converged"));
  print_radius(s);
  print_line("  chains",
             fmt::format("{}, R-hat up to {}, at least {} effective samples", s.text_of("chains", "{:.0f}"),
                         s.text_of("rhat", "{:.4f}"), s.text_of("ess", "{:.0f}")));
  print_line("  centre", fmt::format("{} mg away from the packing's forces", s.text_of("start_distance")));
  print_line("  balance", fmt::format("to {} mg", s.text_of("worst_residual", "{:.1e}")));
}

}  // namespace

void print_line(const std::string& name, const std::string& value) { say("{:<20}{}\n", name, value); }

void print_simulation(const Account& s) {
  print_line("simulation", s.texts.at("method"));
  print_line("  ended", s.texts.at("reason"));
  print_line("  steps",
             fmt::format("{} of length {}; in {} the limit of sweeps was reached",
                         s.text_of("steps", "{:.0f}"), s.text_of("dt"), s.text_of("capped_steps", "{:.0f}")));
  print_line("  raw forces", fmt::format("balance to {} mg", s.text_of("raw_residual", "{:.1e}")));
  print_line(
      "  polished forces",
      fmt::format(
          "{} to {} mg, {} mg away from the raw ones",
          s.texts.at("polish") == "balanced" ? "balance" : "do not balance (" + s.texts.at("polish") + "):",
          s.text_of("residual", "{:.1e}"), s.text_of("distance", "{:.1e}")));
  print_line("  mean R, overlap",
             fmt::format("{} mg, {} r_max", s.text_of("mean_R"), s.text_of("mean_overlap", "{:.1e}")));
}

void print_tilt(const Account& t) {
  const auto degrees = [&](const char* name) {
    const auto found = t.numbers.find(name);
    return found == t.numbers.end() ? std::string("unknown")
                                    : fmt::format("{:.4g}°", found->second * 180 / std::numbers::pi);
  };
  print_line("tilt", fmt::format("gravity turned from 0° to {} (by {} a unit of time)", degrees("angle"),
                                 degrees("rate")));
  print_line("  moved", fmt::format("disks that had moved by {} r_max then: {}", t.text_of("distance"),
                                    t.text_of("moved", "{:.0f}")));
  print_line("  this packing", fmt::format("at rest with gravity turned by {}", degrees("rest_angle")));
}

void print_sampling(const Account& s) {
  if (s.texts.at("method") == "uniform") return print_uniform_sampling(s);
  print_line("samples", fmt::format("{}, by perturb-and-resolve, {} accepted; chains: {}",
                                    s.text_of("samples", "{:.0f}"), s.text_of("accepted", "{:.0f}"),
                                    s.text_of("chains", "{:.0f}")));
  print_radius(s);
  print_line("  centre", fmt::format("{} mg away from the packing's forces", s.text_of("start_distance")));
  print_line("  balance", fmt::format("accepted samples to {} mg", s.text_of("worst_residual", "{:.1e}")));
}

}  // namespace indet::app
