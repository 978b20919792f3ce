#pragma once

#include <cstdint>
#include <string>

namespace indet {

/// "1 disk", "2 disks"; with `plural`, "2 extrema".
inline std::string counted(std::int64_t number, const std::string& noun, const std::string& plural = "") {
  return std::to_string(number) + " " + (number == 1 ? noun : plural.empty() ? noun + "s" : plural);
}

}  // namespace indet
