#pragma once

#include <filesystem>

#include "apps/analysis_parts/plan.h"
#include "apps/batch/item_file.h"
#include "libindet/io/indet_file.h"
#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// The file of a chunk is one of ranges, as indet analyze --contacts LIST makes it, and says of which
/// analysis it is a part.
void write_chunk(const std::filesystem::path& path, const AnalysisPlan& plan, const Packing& packing,
                 const ForceRanges& ranges, const Provenance& provenance);

/// Done: it says that it is a part of this analysis.
ItemState examine_chunk(const std::filesystem::path& path, const AnalysisPlan& plan);
bool chunk_is_done(const std::filesystem::path& path, const AnalysisPlan& plan);

}  // namespace indet
