#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace indet::sim {

/// What moves the disks of a simulation.
enum class Simulator : std::uint8_t { kContactDynamics, kMolecularDynamics };

/// "contact dynamics", "molecular dynamics": as files and options have it.
const char* to_string(Simulator simulator);

/// How a packing came about. Programs pass this value; its name is text in files and options alone, and
/// protocol_from() is where that text is read.
enum class Protocol : std::uint8_t { kCd1, kCd2, kMd1, kMd2, kFile };

/// Where the disks of a packing set out from.
enum class InitialCondition : std::uint8_t {
  kGrid,       ///< A loose grid that falls.
  kCd1AtRest,  ///< The positions of the cd1 packing of the same seed; no velocities, no forces.
  kGiven,      ///< Nothing was simulated: the packing was there.
};

struct ProtocolProperties {
  Protocol protocol;
  const char* name;                    ///< In files and options.
  const char* paper_name;              ///< What the paper calls it; "" if it does not.
  std::optional<Simulator> simulator;  ///< Empty: none.
  InitialCondition start;
  const char* description;
};

/// In the order of the enumeration.
inline constexpr std::array<ProtocolProperties, 5> kProtocols = {
    {{Protocol::kCd1, "cd1", "CD-1", Simulator::kContactDynamics, InitialCondition::kGrid,
      "contact dynamics, falling from a grid"},
     {Protocol::kCd2, "cd2", "CD-2", Simulator::kContactDynamics, InitialCondition::kCd1AtRest,
      "contact dynamics, from CD-1 at rest"},
     {Protocol::kMd1, "md1", "MD-1", Simulator::kMolecularDynamics, InitialCondition::kGrid,
      "molecular dynamics, falling from a grid"},
     {Protocol::kMd2, "md2", "MD-2", Simulator::kMolecularDynamics, InitialCondition::kCd1AtRest,
      "molecular dynamics, from CD-1 at rest"},
     {Protocol::kFile, "file", "", std::nullopt, InitialCondition::kGiven, "read from a file"}}};

/// The protocols that simulate, which are the paper's.
inline constexpr std::array<Protocol, 4> kSimulated = {Protocol::kCd1, Protocol::kCd2, Protocol::kMd1,
                                                       Protocol::kMd2};

constexpr const ProtocolProperties& properties_of(Protocol protocol) {
  return kProtocols[static_cast<std::size_t>(protocol)];
}

constexpr const char* to_string(Protocol protocol) { return properties_of(protocol).name; }

constexpr bool starts_from_cd1(Protocol protocol) {
  return properties_of(protocol).start == InitialCondition::kCd1AtRest;
}

constexpr bool is_simulated_by(Protocol protocol, Simulator simulator) {
  return properties_of(protocol).simulator == simulator;
}

/// The names of kSimulated.
std::vector<std::string> simulated_names();

/// The protocol of this name, if there is one.
std::optional<Protocol> protocol_from(std::string_view name);

}  // namespace indet::sim
