#include "libsim/molecular_preset.h"

#include <algorithm>

namespace indet::sim {
MolecularDynamicsOptions options_of(MolecularPreset preset) {
  MolecularDynamicsOptions options;
  options.k = properties_of(preset).k;
  options.gamma = properties_of(preset).gamma;
  return options;
}

std::vector<std::string> molecular_preset_names() {
  std::vector<std::string> names;
  for (const MolecularPresetProperties& preset : kMolecularPresets) names.emplace_back(preset.name);
  return names;
}

std::optional<MolecularPreset> molecular_preset_from(std::string_view name) {
  const auto* const found = std::find_if(kMolecularPresets.begin(), kMolecularPresets.end(),
                                         [&](const MolecularPresetProperties& p) { return p.name == name; });
  if (found == kMolecularPresets.end()) return {};
  return found->preset;
}

}  // namespace indet::sim
