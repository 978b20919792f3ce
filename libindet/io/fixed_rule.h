#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace indet {

/// Which disks are glued or frozen: they carry forces, and no equation says what balances them. A rule is a
/// list of items: "type=2", an id "17", or ids "29-34".
class FixedRule {
 public:
  FixedRule() = default;
  /// Throws InputError if an item has none of these forms.
  static FixedRule parse(const std::vector<std::string>& items);

  bool empty() const { return items_.empty(); }
  /// The items that name this disk.
  bool names(std::int32_t id, int type) const;
  /// The first item that names none of these disks; "" if each names one.
  std::string idle_item(const std::vector<std::pair<std::int32_t, int>>& ids_and_types) const;

 private:
  struct Item {
    std::string text;
    bool is_type = false;
    std::int64_t first = 0, last = 0;  ///< ids or types
    bool names(std::int32_t id, int type) const;
  };
  std::vector<Item> items_;
};

}  // namespace indet
