#pragma once

#include <filesystem>
#include <string_view>

namespace indet {

/// The number of bytes at the beginning of `text` that are well-formed UTF-8 (Unicode 15, table 3-7: no
/// overlong forms, no surrogates, nothing above U+10FFFF): text.size() if all are.
std::size_t valid_utf8_length(std::string_view text);

/// Throws InputError with file, line and the first offending byte unless `text` is UTF-8 without zero bytes.
/// Names that are stored in HDF5 files are declared to be UTF-8; other bytes there would be unreadable.
void require_utf8(const std::filesystem::path& path, std::string_view text);

}  // namespace indet
