#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libindet/io/levers.h"
#include "libindet/packing/packing.h"

namespace indet {

/// What an importer returns: a valid packing, and what its user should know about it.
struct ImportedPacking {
  Packing packing;
  std::vector<std::string> warnings;
  int duplicates = 0;         ///< Contacts that were given twice with the same forces, and dropped once.
  int without_equations = 0;  ///< Contacts between two bodies without equations, which were left out.
  double rounding = 0;     ///< Relative rounding of the numbers in the file where they were printed with few
                           ///< digits (5e-6 for six); 0 for full precision.
  std::vector<int> types;  ///< Of the material of each disk, −1 if it has none; empty if the format has none.
  bool stress_is_named = false;       ///< The files say which stress is imposed, or that none is.
  std::optional<LeverChoice> levers;  ///< What choose_levers found; none if the file has levers of its own.
};

/// Appends a warning for each contact (at most a few) whose bodies are further apart, or overlap more, than
/// 1 % of the largest radius: the force directions then belong to another geometry.
void warn_of_large_gaps(ImportedPacking& imported);

/// Appends a warning for each wall, and for all contacts of two disks, where every known T is 0 although μ is
/// not, while other contacts have a T: their friction was most likely 0 in the simulation.
void warn_of_idle_friction(ImportedPacking& imported);

}  // namespace indet
