#include "apps/condition.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "apps/analysis_arguments.h"
#include "apps/command.h"
#include "libindet/base/counted.h"
#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"

namespace indet::app {
namespace {

struct Condition {
  bool tangential = false;
  double error = 0;
  bool is_share = false;  ///< of the force, not mg
  std::vector<int> contacts;
};

[[noreturn]] void refuse(const std::string& text) {
  throw UsageError(
      fmt::format("--condition {}: expected R=known±ERROR or T=known±ERROR, with ERROR ≥ 0 in mg "
                  "or in %, and @LIST where not all contacts are meant, as in R=known±1e-6@3,7,12-20",
                  text));
}

Condition parse(const std::string& text, int contacts) {
  Condition condition;
  std::string rest = text;
  const auto take = [&](const std::string& token) {
    if (!rest.starts_with(token)) return false;
    rest.erase(0, token.size());
    return true;
  };
  condition.tangential = rest.starts_with("T");
  if (!take("R") && !take("T")) refuse(text);
  if (!take("=known") || (!take("±") && !take("+-") && !take("+/-"))) refuse(text);
  const std::size_t at = rest.find('@');
  if (at == std::string::npos) {
    for (int i = 0; i < contacts; ++i) condition.contacts.push_back(i);
  } else {
    condition.contacts = parse_contact_list("--condition", text, rest.substr(at + 1), contacts);
    rest.erase(at);
  }
  condition.is_share = rest.ends_with("%");
  if (condition.is_share) rest.pop_back();
  const char* const end = rest.data() + rest.size();
  const auto [stop, error] = std::from_chars(rest.data(), end, condition.error);
  if (error != std::errc() || stop != end || !(condition.error >= 0) || std::isinf(condition.error))
    refuse(text);
  if (condition.is_share) condition.error /= 100;
  return condition;
}

void apply(const std::string& text, const Condition& condition, Packing& packing, const std::string& source) {
  const double mg = packing.force_unit();
  int known = 0;
  for (const int i : condition.contacts) {
    Contact& contact = packing.contacts[static_cast<std::size_t>(i)];
    const double force = condition.tangential ? contact.T : contact.R;
    if (std::isnan(force)) continue;
    ++known;
    const double error = condition.is_share
                             ? std::max(condition.error * std::abs(force), tolerance::kLeastError * mg)
                             : condition.error * mg;
    double& lo = condition.tangential ? contact.T_lo : contact.R_lo;
    double& hi = condition.tangential ? contact.T_hi : contact.R_hi;
    const double below = force - error;
    const double above = force + error;
    if (below > hi || above < lo || (!condition.tangential && above < 0)) {
      throw InputError(
          fmt::format("{}: --condition {}: {} of contact {} ({}) is {:.6g} mg there, and its bounds "
                      "are {:.6g} to {:.6g} mg: nothing is left between",
                      source, text, condition.tangential ? "T" : "R", i, contact_name(packing, ContactId(i)),
                      force / mg, condition.tangential ? lo / mg : std::max(0.0, lo / mg), hi / mg));
    }
    lo = std::max(lo, below);
    hi = std::min(hi, above);
  }
  if (known == 0) {
    throw InputError(fmt::format("{}: --condition {}: none of the {} that it names has a known {}", source,
                                 text,
                                 counted(static_cast<std::int64_t>(condition.contacts.size()), "contact"),
                                 condition.tangential ? "T" : "R"));
  }
}

}  // namespace

void add_condition_option(CLI::App& command, std::vector<std::string>& conditions) {
  command
      .add_option(
          "--condition", conditions,
          "Keep to known (simulated, measured) forces: R=known±ERROR or T=known±ERROR, ERROR in mg, or "
          "in % of the force (at least 1e-9 mg); @3,7,12-20 after it names the contacts (default: all whose "
          "force "
          "is known). May be given several times; +- may stand for ±")
      ->type_name("FORCE=known±ERROR[@LIST]")
      ->allow_extra_args(false);
}

void apply_conditions(const std::vector<std::string>& conditions, Packing& packing,
                      const std::string& source) {
  for (const std::string& text : conditions)
    apply(text, parse(text, packing.contact_count()), packing, source);
}

}  // namespace indet::app
