#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "libindet/packing/packing.h"

namespace indet::app {

/// --condition R=known±ERROR[@LIST]: bounds around the known forces, known − ERROR ≤ R ≤ known + ERROR, of
/// all contacts whose R (or T) is known, or of those in a list like 3,7,12-20. ERROR is in mg, or with % a
/// share of the force itself, but at least 1e-9 mg. "+-" may be written for "±".
void add_condition_option(CLI::App& command, std::vector<std::string>& conditions);

/// Sets the bounds; those that the scene has already stay where they are narrower. Throws UsageError where a
/// condition does not read so, InputError where no force that it names is known, or where nothing is left
/// between it and the scene's own bounds.
void apply_conditions(const std::vector<std::string>& conditions, Packing& packing,
                      const std::string& source);

}  // namespace indet::app
