#include "apps/batch/item_file.h"

#include <fmt/format.h>

#include <system_error>

#include "libindet/base/error.h"
#include "libindet/io/indet_file.h"

namespace indet {

ItemState examine_item(const std::filesystem::path& path,
                       const std::function<bool(const Hdf5File& file)>& belongs) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    if (!error) return {ItemStatus::kAbsent};
    return {ItemStatus::kUnreadable, fmt::format("{}: {}", path.string(), error.message())};
  }
  try {
    if (belongs(open_indet_file(path))) return {ItemStatus::kDone};
    return {ItemStatus::kOther, fmt::format("{}: is of another configuration", path.string())};
  } catch (const InputError& unreadable) {
    return {ItemStatus::kUnreadable, unreadable.what()};
  }
}

}  // namespace indet
