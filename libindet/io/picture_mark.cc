#include "libindet/io/picture_mark.h"

#include <fmt/format.h>

namespace indet {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kSvgMark = "<!-- drawn by indet -->\n";
constexpr std::string_view kPngBegin = "\x89PNG\r\n\x1a\n";
constexpr std::size_t kHeaderChunk = 25;  // IHDR
/// Length, type, text, and the CRC-32 of type and text.
constexpr std::string_view kPngMark = "\0\0\0\x0etEXtSoftware\0indet\xe7\xb5\xc6\xb5"sv;

}  // namespace

std::string mark_svg(std::string picture) { return picture.insert(picture.find("<svg"), kSvgMark); }

std::string mark_png(std::string picture) {
  return picture.insert(kPngBegin.size() + kHeaderChunk, kPngMark);
}

bool is_marked_picture(std::string_view head, std::string_view tail) {
  if (head.starts_with("<?xml") || head.starts_with("<!--"))
    return head.find(kSvgMark) != std::string_view::npos;
  if (head.starts_with("%PDF-"))
    return tail.find(fmt::format("/Creator ({})", kPdfCreator)) != std::string_view::npos;
  return head.starts_with(kPngBegin) && head.substr(kPngBegin.size() + kHeaderChunk).starts_with(kPngMark);
}

}  // namespace indet
