#pragma once

#include <string>

namespace indet {

/// The version of this library, e.g. "0.1.0".
std::string version();

/// The commit that it was built from, or "unknown".
std::string git_revision();

/// The compiler that built it, e.g. "GNU 12.2.0".
std::string compiler();

}  // namespace indet
