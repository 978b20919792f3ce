#include "libindet/base/toml_text.h"

#include <toml++/toml.h>

#include <sstream>

namespace indet {

std::string toml_text(const std::string& text) {
  const toml::value<std::string> value(text);
  std::ostringstream stream;
  auto flags = toml::format_flags::allow_unicode_strings;
  // A line end right behind the opening marks would be taken for a part of them.
  if (text.ends_with('\n') && !text.starts_with('\n')) flags |= toml::format_flags::allow_multi_line_strings;
  stream << toml::toml_formatter(value, flags);
  return stream.str();
}

}  // namespace indet
