#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "libindet/io/balance.h"
#include "libindet/io/packing_file.h"
#include "libindet/limit/limit.h"
#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet::app {

/// Attributes of /simulation, /tilt or /sampling, which describe how the forces came about.
struct Account {
  std::map<std::string, std::string> texts;
  std::map<std::string, double> numbers;

  /// A number as text, or "unknown" where a file does not have it.
  std::string text_of(const std::string& name, const char* format = "{:.4g}") const {
    const auto found = numbers.find(name);
    return found == numbers.end() ? "unknown" : fmt::format(fmt::runtime(format), found->second);
  }
};

struct TrajectoryExtent {
  std::size_t frames = 0;
  double start = 0, end = 0;  ///< Times, in the scene's unit.
};

/// What `inspect` shows of a file of one packing.
struct FileContents {
  Packing packing;
  BalanceReport balance;
  std::optional<ForceRanges> ranges;
  std::vector<Limit> limits;
  std::optional<Account> simulation, tilt, sampling;
  std::optional<TrajectoryExtent> trajectory;
  Digests digests;
  std::map<std::string, std::string> provenance;
};

/// Throws Hdf5ReadError, InputError.
FileContents read_contents(const Hdf5File& file);

}  // namespace indet::app
