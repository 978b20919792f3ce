#include "libindet/io/import_format.h"

namespace indet {

const std::vector<ImportFormat>& import_formats() {
  static const std::vector<ImportFormat> formats = {csv_format(), lammps_format(), liggghts_format(),
                                                    mercury_format(), yade_format()};
  return formats;
}

}  // namespace indet
