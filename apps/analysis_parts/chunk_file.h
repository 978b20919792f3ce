#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "apps/analysis_parts/plan.h"
#include "libindet/io/indet_file.h"
#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// The file of a chunk is one of ranges, as indet analyze --contacts LIST makes it, and says of which
/// analysis it is a part.
void write_chunk(const std::filesystem::path& path, const AnalysisPlan& plan, const Packing& packing,
                 const ForceRanges& ranges, const Provenance& provenance);

enum class ChunkStatus : std::uint8_t {
  kAbsent,
  kOther,       ///< It is of another analysis, or of none.
  kUnreadable,  ///< It cannot be opened, or is not complete.
  kDone
};

struct ChunkState {
  ChunkStatus status = ChunkStatus::kAbsent;
  std::string reason = {};  ///< Why it does not count, with the path; of kOther and kUnreadable.
};

ChunkState examine_chunk(const std::filesystem::path& path, const AnalysisPlan& plan);
bool chunk_is_done(const std::filesystem::path& path, const AnalysisPlan& plan);

/// Digest of the numbers of the packing of a file.
std::string packing_digest(const Hdf5File& file);

}  // namespace indet
