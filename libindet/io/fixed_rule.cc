#include "libindet/io/fixed_rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/io/table.h"

namespace indet {

FixedRule FixedRule::parse(const std::vector<std::string>& items) {
  FixedRule rule;
  for (const std::string& text : items) {
    Item item{.text = text};
    std::string_view rest = text;
    item.is_type = rest.starts_with("type=");
    if (item.is_type) rest.remove_prefix(5);
    const std::size_t dash = rest.find('-');
    const std::string_view first = rest.substr(0, dash);
    const std::string_view last = dash == std::string_view::npos ? first : rest.substr(dash + 1);
    if (!parse_number(first, &item.first) || !parse_number(last, &item.last) || item.first > item.last ||
        item.first < 0) {
      throw InputError(
          fmt::format("fixed \"{}\": the forms are type=2, an id as 17, or ids as 29-34", excerpt(text)));
    }
    rule.items_.push_back(std::move(item));
  }
  return rule;
}

bool FixedRule::Item::names(std::int32_t id, int type) const {
  const std::int64_t number = is_type ? type : id;
  return first <= number && number <= last;
}

bool FixedRule::names(std::int32_t id, int type) const {
  return std::any_of(items_.begin(), items_.end(), [&](const Item& item) { return item.names(id, type); });
}

std::string FixedRule::idle_item(const std::vector<std::pair<std::int32_t, int>>& ids_and_types) const {
  for (const Item& item : items_) {
    const bool used = std::any_of(ids_and_types.begin(), ids_and_types.end(),
                                  [&](const auto& disk) { return item.names(disk.first, disk.second); });
    if (!used) return item.text;
  }
  return "";
}

}  // namespace indet
