#pragma once

#include "libindet/io/hdf5_file.h"
#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"
#include "libindet/verify/verification.h"

namespace indet {

/// Checks the group /VTKHDF of a file with ranges (io/vtkhdf.h): its grid and the data of its points against
/// the packing, and that the data of its cells are the datasets of /contacts and /ranges, not others of the
/// same name. Throws Hdf5ReadError where an object is missing or has another shape.
Verification verify_vtkhdf(const Hdf5File& file, const Packing& packing, const ForceRanges& ranges);

}  // namespace indet
