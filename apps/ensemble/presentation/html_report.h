#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/ensemble/tables/ensemble_file.h"
#include "libindet/base/progress.h"

namespace indet {

/// A picture that is not a plot: the contact states of one packing (Fig. 5).
struct Picture {
  std::string file;  ///< Name of the SVG in the folder of the figures.
  std::string caption;
};

/// Writes FOLDER/figures/ID.{csv,gp,svg,pdf}, FOLDER/figures/comparison.csv and FOLDER/report.html, one page
/// with everything in it: it opens without a server and without a network. `about`: name and value of what is
/// said about the run that made the ensemble.
void write_report(const std::filesystem::path& folder, const EnsembleContents& contents,
                  const std::vector<Picture>& pictures,
                  const std::vector<std::pair<std::string, std::string>>& about,
                  const ProgressCallback& progress = {});

}  // namespace indet
