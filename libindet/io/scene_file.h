#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "libindet/packing/packing.h"

namespace indet {

/// scene.toml of a CSV scene:
///
///     gravity = [0, -1]           force_unit = 1          mu = 0.3
///     [cell]    a = [10, 0]       b = [0, 8]              either may be missing
///     [stress]  xx = 1            yy = 1      xy = 0      or pressure = 1;   stress = "none": none is
///     imposed
///
/// Without a cell gravity is (0, −1) by default; in a full cell nothing takes a weight, and it is (0, 0).
struct SceneFile {
  std::string source;
  Vector2 gravity{0, -1};
  double force_unit = 0;
  std::optional<double> mu;
  Cell cell;
  Stress stress;
  bool names_stress = false;           ///< The file says which stress is imposed, or that none is.
  int cell_line = 0, stress_line = 0;  ///< Where these begin; 0: nowhere.
};

/// The defaults if there is no such file. Throws InputError that names file, line and reason.
SceneFile read_scene_file(const std::filesystem::path& path);

/// The text of scene.toml of a packing.
std::string scene_file_text(const Packing& packing);

/// True if a text is one that scene_file_text makes.
bool is_scene_file(std::string_view text);

}  // namespace indet
