#include "libsim/molecular_preset.h"

#include <algorithm>

namespace indet::sim {
namespace {

template <class Predicate>
std::optional<MolecularPreset> find(const Predicate& predicate) {
  const auto* const found = std::find_if(kMolecularPresets.begin(), kMolecularPresets.end(), predicate);
  if (found == kMolecularPresets.end()) return {};
  return found->preset;
}

}  // namespace

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
  return find([&](const MolecularPresetProperties& p) { return p.name == name; });
}

std::optional<MolecularPreset> molecular_preset_of(const MolecularDynamicsOptions& options) {
  return find([&](const MolecularPresetProperties& p) { return p.k == options.k && p.gamma == options.gamma; });
}

}  // namespace indet::sim
