#include "libindet/io/file_ids.h"

#include <set>

namespace indet {
namespace {

template <class Item>
std::vector<std::int32_t> ids_of(const std::vector<Item>& items) {
  std::vector<std::int32_t> ids;
  std::set<std::int32_t> seen;
  for (const Item& item : items) {
    ids.push_back(item.id);
    if (item.id >= 0) seen.insert(item.id);
  }
  if (seen.size() == items.size()) return ids;
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<std::int32_t>(i);
  return ids;
}

}  // namespace

FileIds::FileIds(const Packing& packing) : disks(ids_of(packing.disks)), walls(ids_of(packing.walls)) {}

}  // namespace indet
