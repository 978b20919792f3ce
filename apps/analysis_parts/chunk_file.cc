#include "apps/analysis_parts/chunk_file.h"

#include <fmt/format.h>

#include <system_error>

#include "libindet/base/error.h"
#include "libindet/io/ranges_file.h"

namespace indet {

void write_chunk(const std::filesystem::path& path, const AnalysisPlan& plan, const Packing& packing,
                 const ForceRanges& ranges, const Provenance& provenance) {
  Provenance part = provenance;
  part.part_of = plan.hash();
  write_ranges(path, packing, ranges, part);
}

ChunkState examine_chunk(const std::filesystem::path& path, const AnalysisPlan& plan) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    if (!error) return {ChunkStatus::kAbsent};
    return {ChunkStatus::kUnreadable, fmt::format("{}: {}", path.string(), error.message())};
  }
  try {
    const Hdf5File file = open_indet_file(path);
    if (has_ranges(file) && file.has_attribute("/provenance", "part_of") &&
        file.string_attribute("/provenance", "part_of") == plan.hash())
      return {ChunkStatus::kDone};
    return {ChunkStatus::kOther, fmt::format("{}: is no part of this analysis", path.string())};
  } catch (const InputError& unreadable) {
    return {ChunkStatus::kUnreadable, unreadable.what()};
  }
}

bool chunk_is_done(const std::filesystem::path& path, const AnalysisPlan& plan) {
  return examine_chunk(path, plan).status == ChunkStatus::kDone;
}

std::string packing_digest(const Hdf5File& file) {
  return file.sha256({"/contacts", "/parameters", "/particles", "/walls"});
}

}  // namespace indet
