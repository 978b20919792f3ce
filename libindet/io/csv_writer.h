#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// Writes disks.csv, walls.csv, contacts.csv and scene.toml, which read_csv_scene reads back to the same
/// packing, into a folder that is made if needed. `forces` (2M, the scene's units) becomes R and T; NaN
/// becomes an empty field. Numbers have as many digits as it takes to read them back exactly.
void write_csv_scene(const std::filesystem::path& folder, const Packing& packing,
                     const Eigen::Ref<const Eigen::VectorXd>& forces);

/// One table with a row a contact, for spreadsheets: contact (its row, from 0), a, b (as in contacts.csv), x,
/// y (contact point), nx, ny, gap, mu, R, T, and if there are `ranges` (else null) R_min, R_max, T_min,
/// T_max, their outcomes, and the measures. Unbounded values are inf; empty fields are unknown.
void write_contact_table(const std::filesystem::path& path, const Packing& packing,
                         const Eigen::Ref<const Eigen::VectorXd>& forces, const ForceRanges* ranges);

}  // namespace indet
