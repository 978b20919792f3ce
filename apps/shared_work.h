#pragma once

#include <filesystem>
#include <string>

#include "apps/batch/work_status.h"

namespace indet::app {

/// A folder in which processes work together, and what it is to hold.
struct SharedWork {
  std::filesystem::path folder;
  std::string kind;         ///< "ensemble", "analysis"
  std::string item, items;  ///< "packing", "packings"; "part", "parts"
  ExpectedWork expected;
  std::filesystem::path result;  ///< What is made of the items once all are done.
  bool is_collected = false;     ///< It is there, and of no older items.
  std::string collector;         ///< What makes it.
};

/// Throws InputError if it is no such folder.
SharedWork shared_work_of(const std::filesystem::path& folder);

}  // namespace indet::app
