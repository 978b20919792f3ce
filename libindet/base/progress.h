#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

namespace indet {

/// One report of work under way. Libraries emit these and never print; the application owns the terminal.
struct Progress {
  std::string_view stage;    ///< What is being done, in a word or two ("ranges").
  std::int64_t done = 0;     ///< Units finished so far.
  std::int64_t total = 0;    ///< Units in all; 0 when unknown.
  std::string_view details;  ///< Free text for the end of the line (residual, kinetic energy, …).
};

/// Called from time to time, always by the thread that called the library. Returning false asks the library
/// to stop; it then throws Interrupted. An empty function means that nobody is interested.
using ProgressCallback = std::function<bool(const Progress&)>;

/// The same within one stage: how much of how much work is done.
using StageProgress = std::function<bool(std::int64_t done, std::int64_t total)>;

}  // namespace indet
