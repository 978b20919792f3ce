#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "libindet/io/indet_file.h"
#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// Contacts and disks for ParaView and other readers of VTK: the group /VTKHDF of an HDF5 file, an
/// UnstructuredGrid of version 1.0 of that format (VTK 9.1, ParaView 5.10 and later), in one part.
///
///   Points, Connectivity, Offsets, Types   the grid of io/vtk_grid.h
///   PointData/radius, body                 of the disks, then of the feet
///   CellData/body_a, body_b, gap, mu, R, T as in /contacts
///   CellData/R_min …                       every field of the ranges that has a row a contact, by its name
///   in
///                                          range/result_fields.h and in its unit; outcome as its number

/// Writes the group into the file of a packing with ranges, whose /contacts and /ranges are there: the data
/// of cells are hard links to them.
void write_vtkhdf_part(Hdf5File& file, const Packing& packing, const ForceRanges& ranges);

/// Writes a file that has nothing else. `forces` (2M, the scene's units) become R and T; `ranges` may be
/// null. Throws like write_packing.
void write_vtkhdf(const std::filesystem::path& path, const Packing& packing,
                  const Eigen::Ref<const Eigen::VectorXd>& forces, const ForceRanges* ranges,
                  const Provenance& provenance);

/// Whether a file has the group.
bool has_vtkhdf(const Hdf5File& file);

}  // namespace indet
