#pragma once

#include <optional>

#include "libindet/io/given_walls.h"
#include "libindet/io/import_settings.h"
#include "libindet/io/imported_packing.h"
#include "libindet/io/mercury_frames.h"

namespace indet {

/// Reads a packing of MercuryDPM from `.data` (particles) and `.fstat` (contacts), at `time` or the last time
/// that both have. The id of a particle is its place in the list, from 0, and its type the species, which
/// MercuryDPM writes as last column. A row of contacts says of particle i and body j
///
///   overlap δ, |normal force| F_n (> 0: pushes), |tangential force| F_t, unit vectors n and t
///
/// - pairs, each listed twice, once from either side: n points from j to i, the force on i is F_n n + F_t t;
///   MercuryDPM leaves out the side of a particle that it holds fixed
/// - walls, j = −k − 1 of wall k: n points from i into the wall, the force on i is −F_n n − F_t t
///
/// so that R = F_n in either case, T = ±F_t t·t̂ with normals from the positions, and the plane of a wall lies
/// at n·x = n·x_i + r_i − δ of each contact with it. `walls` says exactly where planes lie that the rounding
/// of these numbers blurs. Settings give densities (the files have no masses) and friction; gravity is (0,
/// −1) unless they name one. Throws InputError that names file, line and reason.
ImportedPacking read_mercury_data(const MercuryFiles& files, std::optional<double> time,
                                  const GivenWalls& walls, const ImportSettings& settings);

}  // namespace indet
