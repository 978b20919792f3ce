#pragma once

#include <filesystem>

#include "libindet/io/import_settings.h"
#include "libindet/io/imported_packing.h"

namespace indet {

/// Reads a packing of MercuryDPM from a `.restart` file (docs/importing.md): lines of keywords, each followed
/// by its numbers, in the sections Species, Walls, Boundaries, Particles, Interactions.
///
/// - a particle has position, radius, invMass (0: fixed), velocity, angularVelocity, indSpecies
/// - an InfiniteWall has position, and orientation (a quaternion that turns x into the normal) or normal; the
///   normal points out of the domain
/// - an interaction has particleIds P I or particleWallIds P W, and force (on P)
///
/// Normals and gaps follow from the positions. Friction (slidingFrictionCoefficient of the species, 0 if they
/// have none) and gravity are those of the file unless the settings name others. Throws InputError that names
/// file, line and reason, also for a periodic boundary or another wall that a particle touches.
ImportedPacking read_mercury(const std::filesystem::path& file, const ImportSettings& settings);

}  // namespace indet
