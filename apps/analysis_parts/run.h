#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/analysis_parts/plan.h"
#include "apps/batch/run_items.h"
#include "apps/batch/shard.h"
#include "libindet/base/progress.h"
#include "libindet/io/indet_file.h"
#include "libindet/packing/packing.h"
#include "libindet/range/dealt_analysis.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// The chunks of one share of the work; each share costs about the same.
std::vector<Chunk> chunks_of(const AnalysisPlan& plan, const Shard& shard);

/// Estimated seconds of what is dealt: of each chunk.
std::vector<double> dealt_costs(const AnalysisPlan& plan);

struct PartsOptions {
  int threads = 1;
  ProgressCallback progress;
  std::optional<double> time_budget;  ///< BatchOptions::time_budget
  std::int64_t there_already = 0;     ///< Batch::there_already
  TaskLog* log = nullptr;
  Provenance provenance;
};

/// Those of these chunks that are not done yet; `warn` is told what is there and cannot be read.
std::vector<Chunk> open_chunks(const AnalysisPlan& plan, const std::vector<Chunk>& chunks,
                               const std::filesystem::path& folder,
                               const std::function<void(const std::string&)>& warn);

/// Computes open chunks, and writes one file for each to FOLDER/chunks. Any number of processes, on any hosts
/// that share the folder, may do this at the same time: a file that exists is whole and is left as it is, and
/// each process takes chunks in an order of its own and passes over those that another one has done
/// meanwhile.
BatchSummary compute_chunks(const Packing& packing, const DealtAnalysis& analysis, const AnalysisPlan& plan,
                            const std::vector<Chunk>& open, const std::filesystem::path& folder,
                            const PartsOptions& options);

/// The packing, and the ranges of all chunks, each from the first of the folders that has it. Throws
/// InputError that names the chunks that are in none.
struct JoinedAnalysis {
  Packing packing;
  ForceRanges ranges;
};
JoinedAnalysis join_chunks(const AnalysisPlan& plan, const std::vector<std::filesystem::path>& folders,
                           const ProgressCallback& progress);

}  // namespace indet
