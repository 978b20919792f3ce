#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string_view>

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// The files of a scene.
inline constexpr std::array<const char*, 4> kSceneFiles = {"disks.csv", "walls.csv", "contacts.csv",
                                                           "scene.toml"};

/// Writes disks.csv, walls.csv, contacts.csv and scene.toml, which read_csv_scene reads back to the same
/// packing, into a folder that is made if needed. `forces` (2M, the scene's units) becomes R and T; NaN
/// becomes an empty field. Numbers have as many digits as it takes to read them back exactly.
void write_csv_scene(const std::filesystem::path& folder, const Packing& packing,
                     const Eigen::Ref<const Eigen::VectorXd>& forces);

/// One table with a row a contact, for spreadsheets and pandas: contact (its row, from 0), a, b (as in
/// contacts.csv), x, y (contact point), nx, ny, gap, mu, lever_a, lever_b (where some contact has one), R_mg,
/// T_mg, and if there are `ranges` (else null)
/// R_min_mg … T_max_mg, their outcomes, and the measures delta_R_mg … d_T_mg, R_star, T_star. Columns that
/// end in _mg are in the packing's unit of force, lengths in the scene's unit; `forces` and `ranges` are
/// given in the scene's unit of force. Unbounded values are inf; empty fields are unknown.
void write_contact_table(const std::filesystem::path& path, const Packing& packing,
                         const Eigen::Ref<const Eigen::VectorXd>& forces, const ForceRanges* ranges);

/// True if a text begins as one that write_csv_scene or write_contact_table writes. Tables that others wrote
/// for import have other columns, or the same ones in another order.
bool is_scene_table(std::string_view text);
bool is_contact_table(std::string_view text);

}  // namespace indet
