#include "apps/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "libindet/base/printable.h"

namespace indet::app {
namespace {

/// All of the text as a number: std::errc() if it is one.
template <class Number>
std::errc parse_all(std::string_view text, Number& value) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return end == text.data() + text.size() ? error : std::errc::invalid_argument;
}

std::string complaint(const std::string& text, const char* condition) {
  return fmt::format("\"{}\" is not a number{}", excerpt(text), condition);
}

/// A number that is as `accept` says; `condition` says it to people. (CLI11 prints the largest double
/// with all its digits.)
CLI::Validator number_that(bool (*accept)(double), const char* condition, const char* name) {
  return {[accept, condition](const std::string& text) -> std::string {
            double value = 0;
            const bool is_number = parse_all(text, value) == std::errc() && std::isfinite(value);
            return is_number && accept(value) ? "" : complaint(text, condition);
          },
          name};
}

std::string check_real(const std::string& text) {
  double value = 0;
  const std::errc error = parse_all(text, value);
  if (error == std::errc::result_out_of_range) return complaint(text, " that a double can hold");
  if (error != std::errc()) return complaint(text, "");
  return std::isfinite(value) ? "" : complaint(text, " that is finite");
}

std::string check_whole(std::string& text, std::int64_t least) {
  std::int64_t value = 0;
  const std::errc error = parse_all(text, value);
  if (error == std::errc::result_out_of_range || (error == std::errc() && value < least)) {
    return fmt::format("\"{}\" is not from {} to {}", excerpt(text), least,
                       std::numeric_limits<std::int64_t>::max());
  }
  if (error != std::errc()) return fmt::format("\"{}\" is not a whole number", excerpt(text));
  text = fmt::format("{}", value);
  return "";
}

bool takes_reals(const CLI::Option& option) { return option.get_type_name().starts_with("FLOAT"); }

}  // namespace

bool takes_numbers(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.starts_with("INT") || type.starts_with("UINT") || takes_reals(option);
}

CLI::Validator not_negative() {
  return number_that([](double value) { return value >= 0; }, " ≥ 0", "NONNEGATIVE");
}

CLI::Validator positive() {
  return number_that([](double value) { return value > 0; }, " > 0", "POSITIVE");
}

void require_numbers(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    if (takes_reals(*option)) {
      option->check(CLI::Validator(check_real, ""));
    } else if (takes_numbers(*option)) {
      const bool has_sign = !option->get_type_name().starts_with("UINT");
      const std::int64_t least = has_sign ? std::numeric_limits<std::int64_t>::min() : 0;
      option->transform(CLI::Validator([least](std::string& text) { return check_whole(text, least); }, ""));
    }
  }
}

void parse_numbers(CLI::App& root, std::vector<std::string> arguments) {
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them last first
  try {
    root.parse(arguments);
  } catch (const CLI::ConversionError& error) {
    // "Could not convert: --disks = 4294967301": a whole number, as check_whole() has let it pass; or the
    // value of a flag in a configuration.
    const std::string text = error.what();
    const std::size_t name = text.find("--");
    const std::size_t value = text.find(" = ", name);
    if (name == std::string::npos || value == std::string::npos) throw;
    const std::string given = text.substr(value + 3);
    std::int64_t number = 0;
    const bool is_whole = parse_all(given, number) != std::errc::invalid_argument;
    throw CLI::ValidationError(text.substr(name, value - name),
                               is_whole ? excerpt(given) + " does not fit into 32 bits"
                                        : fmt::format("\"{}\" is neither true nor false", excerpt(given)));
  }
}

}  // namespace indet::app
