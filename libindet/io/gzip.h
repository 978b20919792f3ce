#pragma once

#include <string>
#include <string_view>

namespace indet {

/// True if `bytes` begin like a gzip file (RFC 1952).
bool is_gzip(std::string_view bytes);

/// What a gzip file holds; several that were appended to each other give one text. `source` is its name, for
/// messages. Throws InputError if the file is damaged or ends too early.
std::string unpack_gzip(std::string_view bytes, const std::string& source);

}  // namespace indet
