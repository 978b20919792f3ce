#pragma once

#include <string>
#include <string_view>

namespace indet {

/// What marks a picture as drawn by indet: a comment of an SVG file, the creator of a PDF file, and the chunk
/// tEXt "Software" of a PNG file. A picture that bears it may be drawn anew over itself (io/replacement.h).
inline constexpr const char* kPdfCreator = "indet";

/// `picture`, an SVG file, with the mark before its first element.
std::string mark_svg(std::string picture);

/// `picture`, a PNG file, with the mark after its first chunk.
std::string mark_png(std::string picture);

/// True if the file begins (its first bytes in `head`) and ends (`tail`) as a picture that bears the mark.
bool is_marked_picture(std::string_view head, std::string_view tail);

}  // namespace indet
