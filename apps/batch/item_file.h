#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "libindet/io/hdf5_file.h"

namespace indet {

/// How the file of an item stands.
enum class ItemStatus : std::uint8_t {
  kAbsent,
  kOther,       ///< It is of other work, or of none.
  kUnreadable,  ///< It cannot be opened, or is not complete.
  kDone         ///< It is complete and belongs to the work.
};

struct ItemState {
  ItemStatus status = ItemStatus::kAbsent;
  std::string reason = {};  ///< Why it does not count, with the path; of kOther and kUnreadable.
};

/// `belongs`: whether a file that opens is of this work. Uses HDF5: one thread at a time.
ItemState examine_item(const std::filesystem::path& path,
                       const std::function<bool(const Hdf5File& file)>& belongs);

}  // namespace indet
