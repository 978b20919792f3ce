#include "libsim/molecular_preset.h"

#include <gtest/gtest.h>

namespace indet::sim {
namespace {

TEST(MolecularPreset, TableIsInTheOrderOfTheEnumeration) {
  for (const MolecularPresetProperties& properties : kMolecularPresets)
    EXPECT_EQ(&properties_of(properties.preset), &properties) << properties.name;
}

TEST(MolecularPreset, NamesAreReadBack) {
  for (const MolecularPresetProperties& properties : kMolecularPresets)
    EXPECT_EQ(molecular_preset_from(properties.name), properties.preset);
  EXPECT_FALSE(molecular_preset_from("soft"));
}

TEST(MolecularPreset, PaperIsTheDefault) {
  EXPECT_EQ(MolecularDynamicsOptions{}.k, options_of(MolecularPreset::kPaper).k);
  EXPECT_EQ(MolecularDynamicsOptions{}.gamma, options_of(MolecularPreset::kPaper).gamma);
  EXPECT_EQ(molecular_preset_names().front(), "paper");
}

}  // namespace
}  // namespace indet::sim
