#include "apps/analysis_parts/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <random>
#include <utility>

#include "apps/analysis_parts/chunk_file.h"
#include "apps/analysis_parts/folder.h"
#include "libindet/base/error.h"
#include "libindet/base/random.h"
#include "libindet/io/packing_file.h"
#include "libindet/io/ranges_file.h"
#include "libindet/io/whole_file.h"
#include "libindet/range/join_ranges.h"

namespace indet {
namespace {

namespace fs = std::filesystem;

/// Parts that are held in memory, each with tables of all contacts.
constexpr std::size_t kAtOnce = 16;

class ChunkBatch {
 public:
  ChunkBatch(const Packing& packing, const DealtAnalysis& analysis, const AnalysisPlan& plan,
             const std::vector<Chunk>& open, const fs::path& folder, const PartsOptions& options)
      : packing_(packing), analysis_(analysis), plan_(plan), folder_(folder), options_(options) {
    batch_.there_already = options.there_already;
    for (const Chunk& chunk : open) open_.push_back(&chunk);
    Random random(std::random_device{}());
    for (std::size_t i = open_.size(); i > 1; --i) std::swap(open_[i - 1], open_[random.below(i)]);
    for (const Chunk* chunk : open_) batch_.items.push_back({chunk->name, chunk->cost});
    batch_.is_done = [this](std::size_t item) {
      const std::scoped_lock lock(hdf5_);
      return chunk_is_done(chunk_path(folder_, *open_[item]), plan_);
    };
    batch_.compute = [this](std::size_t item, const ProgressCallback& progress) {
      return compute(*open_[item], progress);
    };
  }

  BatchSummary run() {
    return run_items(batch_, {.threads = options_.threads,
                              .stage = "force ranges",
                              .items = "parts",
                              .progress = options_.progress,
                              .time_budget = options_.time_budget,
                              .log = options_.log});
  }

 private:
  /// On one thread, where there are chunks for all.
  std::map<std::string, double> compute(const Chunk& chunk, const ProgressCallback& progress) {
    const int threads = std::max(1, options_.threads / static_cast<int>(open_.size()));
    const ForceRanges ranges = analysis_.find(chunk.contacts, threads, progress);
    const std::scoped_lock lock(hdf5_);
    const fs::path path = chunk_path(folder_, chunk);
    if (!chunk_is_done(path, plan_)) write_chunk(path, plan_, packing_, ranges, options_.provenance);
    return ranges.seconds;
  }

  const Packing& packing_;
  const DealtAnalysis& analysis_;
  const AnalysisPlan& plan_;
  const fs::path& folder_;
  const PartsOptions& options_;
  std::vector<const Chunk*> open_;
  Batch batch_;
  std::mutex hdf5_;  ///< Only one thread at a time is in HDF5.
};

}  // namespace

std::vector<Chunk> chunks_of(const AnalysisPlan& plan, const Shard& shard) {
  const std::vector<int> share_of = deal(dealt_costs(plan), shard.count);
  std::vector<Chunk> chunks;
  for (std::size_t i = 0; i < plan.chunks.size(); ++i) {
    if (share_of[i] == shard.number) chunks.push_back(plan.chunks[i]);
  }
  return chunks;
}

std::vector<double> dealt_costs(const AnalysisPlan& plan) {
  std::vector<double> costs;
  for (const Chunk& chunk : plan.chunks) costs.push_back(chunk.cost);
  return costs;
}

std::vector<Chunk> open_chunks(const AnalysisPlan& plan, const std::vector<Chunk>& chunks,
                               const fs::path& folder, const std::function<void(const std::string&)>& warn) {
  std::vector<Chunk> open;
  for (const Chunk& chunk : chunks) {
    const ItemState state = examine_chunk(chunk_path(folder, chunk), plan);
    if (state.status == ItemStatus::kUnreadable) warn(state.reason + "; it is computed again");
    if (state.status != ItemStatus::kDone) open.push_back(chunk);
  }
  return open;
}

BatchSummary compute_chunks(const Packing& packing, const DealtAnalysis& analysis, const AnalysisPlan& plan,
                            const std::vector<Chunk>& open, const fs::path& folder,
                            const PartsOptions& options) {
  remove_leftovers(folder);
  remove_leftovers(chunks_folder(folder));
  return ChunkBatch(packing, analysis, plan, open, folder, options).run();
}

JoinedAnalysis join_chunks(const AnalysisPlan& plan, const std::vector<fs::path>& folders,
                           const ProgressCallback& progress) {
  std::vector<fs::path> paths;
  std::string missing;
  for (const Chunk& chunk : plan.chunks) {
    const auto has = [&](const fs::path& folder) { return chunk_is_done(chunk_path(folder, chunk), plan); };
    const auto folder = std::find_if(folders.begin(), folders.end(), has);
    if (folder != folders.end()) {
      paths.push_back(chunk_path(*folder, chunk));
    } else {
      missing += "\n  " + chunk.name;
    }
  }
  if (!missing.empty()) {
    throw InputError(fmt::format("{} of {} parts are missing, so that there are no ranges of all contacts:{}",
                                 plan.chunks.size() - paths.size(), plan.chunks.size(), missing));
  }
  JoinedAnalysis joined;
  ContactChoice so_far{.kind = ContactChoice::Kind::kList};
  std::vector<ForceRanges> parts;
  try {
    for (std::size_t k = 0; k < paths.size(); ++k) {
      const Hdf5File file = open_indet_file(paths[k]);
      if (k == 0) joined.packing = read_packing(file);
      parts.push_back(read_ranges(file));
      const std::vector<int>& contacts = plan.chunks[k].contacts;
      so_far.list.insert(so_far.list.end(), contacts.begin(), contacts.end());
      if (parts.size() == kAtOnce) parts = {join_ranges(joined.packing, so_far, parts)};
      const Progress at{"joining", static_cast<std::int64_t>(k) + 1, std::ssize(paths), {}};
      if (progress && !progress(at)) throw Interrupted();
    }
    joined.ranges = join_ranges(joined.packing, plan.contacts, parts);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", chunks_folder(folders.front()).string(), error.what()));
  }
  return joined;
}

}  // namespace indet
