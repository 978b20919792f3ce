#include "libindet/barrier/independent_parts.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace indet::barrier {
namespace {

/// Columns of one group each, in rows of one node each.
class System {
 public:
  explicit System(int rows) {
    for (int i = 0; i < rows; ++i) system_.nodes.push_back({{i}, false, false});
    system_.load.assign(static_cast<std::size_t>(rows), 1.0);
  }
  struct Entry {
    int row = 0;
    double value = 0;
  };
  void add_column(const std::vector<Entry>& entries) {
    BlockSystem::Group& group = system_.groups.emplace_back();
    group.columns = 1;
    for (const auto& [row, value] : entries) group.parts.push_back({row, {value}});
  }
  IndependentParts parts() const {
    return find_independent_parts(BlockStructure(system_), std::vector<double>(system_.groups.size(), 0.5));
  }

 private:
  BlockSystem system_;
};

/// x_0 + x_1 + ε x_2 = 1, x_2 + x_3 = 1.
TEST(IndependentParts, AreCoupledOrNotOrUnknown) {
  const auto coupled_by = [](double epsilon) {
    System system(2);
    system.add_column({{0, 1}});
    system.add_column({{0, 1}});
    system.add_column({{0, epsilon}, {1, 1}});
    system.add_column({{1, 1}});
    return system.parts();
  };
  EXPECT_EQ(coupled_by(0).count, 2);
  EXPECT_EQ(coupled_by(1e-15).count, 2);
  EXPECT_EQ(coupled_by(1e-7).count, 1);
  EXPECT_EQ(coupled_by(1).count, 1);
  const IndependentParts unknown = coupled_by(1e-10);
  EXPECT_EQ(unknown.count, -1);
  EXPECT_NE(unknown.reason.find("rounding"), std::string::npos);
}

/// x_2k + x_2k+1 = 1, all of which enter one more row with a column that cannot vary then.
TEST(IndependentParts, ShareARow) {
  const auto pairs = [](int count) {
    System system(count + 1);
    for (int k = 0; k < 2 * count; ++k) system.add_column({{k / 2, 1}, {count, 1}});
    system.add_column({{count, 1}});
    return system.parts();
  };
  EXPECT_EQ(pairs(1).count, 1);
  EXPECT_EQ(pairs(30).count, 30);
  const IndependentParts many = pairs(300);
  EXPECT_EQ(many.count, -1);
  EXPECT_FALSE(many.reason.empty());
}

TEST(IndependentParts, AreNoneWhereNothingCanVary) {
  System system(2);
  system.add_column({{0, 1}});
  system.add_column({{0, 1}, {1, -1}});
  EXPECT_EQ(system.parts().count, 0);
}

}  // namespace
}  // namespace indet::barrier
