#include "libsim/protocol.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace indet::sim {
namespace {

TEST(Protocol, TableIsInTheOrderOfTheEnumeration) {
  for (const ProtocolProperties& properties : kProtocols)
    EXPECT_EQ(&properties_of(properties.protocol), &properties) << properties.name;
}

TEST(Protocol, NamesAreReadBack) {
  for (const ProtocolProperties& properties : kProtocols)
    EXPECT_EQ(protocol_from(to_string(properties.protocol)), properties.protocol);
  for (const char* name : {"", "cd", "cd3", "CD-1", "import csv"}) EXPECT_FALSE(protocol_from(name)) << name;
}

TEST(Protocol, TheSimulatedAreThoseWithASimulator) {
  for (const ProtocolProperties& properties : kProtocols) {
    const bool listed = std::count(kSimulated.begin(), kSimulated.end(), properties.protocol) == 1;
    EXPECT_EQ(properties.simulator.has_value(), listed) << properties.name;
    EXPECT_EQ(properties.start != InitialCondition::kGiven, listed) << properties.name;
    EXPECT_EQ(*properties.paper_name != '\0', listed) << properties.name;
  }
}

}  // namespace
}  // namespace indet::sim
