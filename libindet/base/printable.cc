#include "libindet/base/printable.h"

#include <cstdint>

namespace indet {
namespace {

constexpr std::size_t kMostBytes = 200;

/// U+0080 … U+009F, which are control characters too, are C2 80 … C2 9F in UTF-8.
bool is_control(std::string_view text, std::size_t i) {
  const auto byte = static_cast<std::uint8_t>(text[i]);
  if (byte < 0x20 || byte == 0x7F) return byte != '\n' && byte != '\t';
  return byte >= 0x80 && byte < 0xA0 && i > 0 && static_cast<std::uint8_t>(text[i - 1]) == 0xC2;
}

}  // namespace

std::string printable(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_control(text, i)) {
      result += text[i];
      continue;
    }
    const auto byte = static_cast<std::uint8_t>(text[i]);
    if (byte >= 0x80) result.pop_back();  // its first byte
    result += "\\x";
    result += kDigits[byte >> 4U];
    result += kDigits[byte & 15U];
  }
  return result;
}

std::string excerpt(std::string_view text) {
  if (text.size() <= kMostBytes) return printable(text);
  std::size_t end = kMostBytes;
  while (end > 0 && (static_cast<std::uint8_t>(text[end]) & 0xC0U) == 0x80) --end;  // no half character
  return printable(text.substr(0, end)) + "…";
}

}  // namespace indet
