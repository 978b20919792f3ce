#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "libindet/base/progress.h"
#include "libindet/io/hdf5_file.h"
#include "libindet/packing/packing.h"

namespace indet {

/// What the paper's walk found about one packing (Method::kPivotingPaper with the default PaperOptions).
struct PaperWalkResult {
  Eigen::VectorXd d_R, d_T;    ///< [24] with the states at which walks ended; NaN where one found none.
  std::int64_t walks = 0;      ///< Searches; determined forces need none.
  std::int64_t failures = 0;   ///< Of these, by the method's own account (PaperWork::failures).
  std::int64_t imprecise = 0;  ///< Values that are not proven, or were not found.
};

/// Throws LibraryError, Interrupted.
PaperWalkResult walk_as_the_paper(const Packing& packing, const ProgressCallback& progress);

/// Into /ensemble, which is there: @paper_walks, @paper_failures, @paper_imprecise; paper_d_R, paper_d_T
/// f8[M].
void write_paper_walk(Hdf5File& file, const PaperWalkResult& result);

}  // namespace indet
