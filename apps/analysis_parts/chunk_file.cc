#include "apps/analysis_parts/chunk_file.h"

#include "libindet/io/ranges_file.h"

namespace indet {

void write_chunk(const std::filesystem::path& path, const AnalysisPlan& plan, const Packing& packing,
                 const ForceRanges& ranges, const Provenance& provenance) {
  Provenance part = provenance;
  part.part_of = plan.hash();
  write_ranges(path, packing, ranges, part);
}

ItemState examine_chunk(const std::filesystem::path& path, const AnalysisPlan& plan) {
  return examine_item(path, [&](const Hdf5File& file) {
    return has_ranges(file) && file.has_attribute("/provenance", "part_of") &&
           file.string_attribute("/provenance", "part_of") == plan.hash();
  });
}

bool chunk_is_done(const std::filesystem::path& path, const AnalysisPlan& plan) {
  return examine_chunk(path, plan).status == ItemStatus::kDone;
}

}  // namespace indet
