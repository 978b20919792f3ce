#include "libindet/io/utf8.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "libindet/base/error.h"

namespace indet {
namespace {

/// The length of a sequence by its first byte, and the range of the second; 0 where no sequence begins so.
struct Sequence {
  std::size_t length;
  std::uint8_t low, high;
};

Sequence sequence_of(std::uint8_t first) {
  if (first < 0x80) return {1, 0, 0};
  if (first < 0xC2) return {0, 0, 0};  // a continuation, or an overlong form
  if (first < 0xE0) return {2, 0x80, 0xBF};
  if (first == 0xE0) return {3, 0xA0, 0xBF};  // below: overlong
  if (first == 0xED) return {3, 0x80, 0x9F};  // above: surrogates
  if (first < 0xF0) return {3, 0x80, 0xBF};
  if (first == 0xF0) return {4, 0x90, 0xBF};  // below: overlong
  if (first < 0xF4) return {4, 0x80, 0xBF};
  if (first == 0xF4) return {4, 0x80, 0x8F};  // above: beyond U+10FFFF
  return {0, 0, 0};
}

}  // namespace

std::size_t valid_utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  std::size_t i = 0;
  while (i < text.size()) {
    const Sequence sequence = sequence_of(byte(i));
    if (sequence.length == 0 || text.size() - i < sequence.length) return i;
    for (std::size_t k = 1; k < sequence.length; ++k) {
      const std::uint8_t low = k == 1 ? sequence.low : 0x80;
      const std::uint8_t high = k == 1 ? sequence.high : 0xBF;
      if (byte(i + k) < low || byte(i + k) > high) return i;
    }
    i += sequence.length;
  }
  return i;
}

void require_utf8(const std::filesystem::path& path, std::string_view text) {
  const std::size_t valid = valid_utf8_length(text);
  const std::size_t offset = std::min(valid, text.find('\0'));
  if (offset >= text.size()) return;
  const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(offset), '\n') + 1;
  throw InputError(fmt::format("{}:{}: the byte 0x{:02X} is not UTF-8 text{}: save the file as UTF-8",
                               path.string(), line, static_cast<std::uint8_t>(text[offset]),
                               text[offset] == '\0' ? "" : " (it may be Latin-1)"));
}

}  // namespace indet
