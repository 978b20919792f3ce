#pragma once

#include <compare>
#include <cstdint>

namespace indet {

/// An index that does not mix with the indices of other things: a DiskId is not a ContactId.
/// Counts from 0 in the order of the packing.
template <class Tag>
class Index {
 public:
  constexpr Index() = default;
  constexpr explicit Index(std::int64_t value) : value_(static_cast<std::int32_t>(value)) {}
  constexpr std::int32_t value() const { return value_; }
  constexpr auto operator<=>(const Index&) const = default;

 private:
  std::int32_t value_ = -1;
};

using DiskId = Index<struct DiskTag>;
using WallId = Index<struct WallTag>;
using ContactId = Index<struct ContactTag>;

}  // namespace indet
