#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

#include "libindet/base/printable.h"

namespace indet::app {

/// As fmt::print to the standard output, of text that may hold names from files: what is not printable in it
/// is made so.
template <class... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  const std::string text = printable(fmt::format(format, std::forward<Arguments>(arguments)...));
  std::fwrite(text.data(), 1, text.size(), stdout);
}

}  // namespace indet::app
