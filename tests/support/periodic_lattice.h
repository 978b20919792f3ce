#pragma once

#include "libindet/packing/packing.h"

namespace indet::zoo {

/// A triangular lattice of disks of diameter 1 in a cell of `columns` by `rows`, a little disordered: radii
/// stay, centres move by up to `disorder`, so that normals and branches are generic. Contacts along 0°, 60°
/// and 120° with images where these are nearest; a stress of xx = 1, yy = 1.1, xy = 0.05.
Packing periodic_lattice(int columns, int rows, double mu, double disorder);

}  // namespace indet::zoo
