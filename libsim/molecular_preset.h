#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libsim/simulate.h"

namespace indet::sim {

/// Named springs and dashpots of molecular dynamics.
enum class MolecularPreset : std::uint8_t {
  kPaper,         ///< Stiffness and damping as the paper prints them (Sec. III A).
  kPaperOverlap,  ///< The stiffness that gives the mean overlap that the paper prints, 7e-6 r_max.
  kStiff,         ///< That stiffness, damped so little that two disks of mean mass collide with e_n = 0.3.
};

struct MolecularPresetProperties {
  MolecularPreset preset;
  const char* name;  ///< In files and options.
  double k;          ///< mg/r_max
  double gamma;      ///< mg/r_max √(r_max/g)
};

/// In the order of the enumeration. The paper's stiffness and overlap contradict each other: with 1.2e5 the
/// disks overlap by 7e-5, with 1.2e6 by 7e-6 (docs/simulation.md).
inline constexpr std::array<MolecularPresetProperties, 3> kMolecularPresets = {
    {{MolecularPreset::kPaper, "paper", 1.2e5, 7.7e4},
     {MolecularPreset::kPaperOverlap, "paper-overlap", 1.2e6, 7.7e4},
     {MolecularPreset::kStiff, "stiff", 1.2e6, 558}}};

constexpr const MolecularPresetProperties& properties_of(MolecularPreset preset) {
  return kMolecularPresets[static_cast<std::size_t>(preset)];
}

MolecularDynamicsOptions options_of(MolecularPreset preset);

/// The names, in their order.
std::vector<std::string> molecular_preset_names();

/// The preset of this name, if there is one.
std::optional<MolecularPreset> molecular_preset_from(std::string_view name);

}  // namespace indet::sim
