#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace indet::fuzz {

/// A folder in memory or on disk that lives as long as the process.
const std::filesystem::path& folder();

/// Writes a file into it, over what was there.
std::filesystem::path write(const std::string& name, std::string_view bytes);

/// The parts of the input between lines of the form "=====".
std::vector<std::string_view> parts(std::string_view bytes);

/// Writes the first two parts of the input as files of these names.
std::pair<std::filesystem::path, std::filesystem::path> write_two(std::string_view bytes,
                                                                  const std::string& first,
                                                                  const std::string& second);

/// Calls the reader; input errors are what it is there for, anything else ends the process.
template <class Reader>
void expect_input_error_or_success(Reader reader);

}  // namespace indet::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

#include "libindet/base/error.h"

template <class Reader>
void indet::fuzz::expect_input_error_or_success(Reader reader) {
  try {
    reader();
  } catch (const InputError&) {  // NOLINT: refused, as it should be
  }
}
