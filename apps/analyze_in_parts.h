#pragma once

#include <filesystem>
#include <vector>

#include "apps/analysis_parts/plan.h"
#include "apps/analyze_arguments.h"
#include "apps/command.h"
#include "apps/scheduler.h"
#include "libindet/io/replacement.h"
#include "libindet/packing/packing.h"

namespace indet::app {

/// indet analyze --out FOLDER: computes a share of the chunks of an analysis, or what is left of all, and
/// then joins them. Returns the exit status.
int analyze_in_parts(const AnalyzeArguments& arguments, const std::filesystem::path& folder,
                     const ShareArguments& share, bool overwrite, const Context& context);

/// What indet analyze --out is to do. Throws UsageError where it cannot be dealt, by the options.
struct PlannedAnalysis {
  Packing packing;
  AnalyzeOptions options;
  AnalysisPlan plan;
};
PlannedAnalysis plan_in_parts(const AnalyzeArguments& arguments, const Context& context);

/// Throws InputError unless the parts of an analysis may be written into the folder: it is free, or has those
/// of the same analysis. With `overwrite`, of any.
void claim_parts_folder(const std::filesystem::path& folder, const AnalysisPlan& plan,
                        const Replacement& rule, bool overwrite);

/// indet merge of such folders: joins what they have into one file. Returns the exit status.
int merge_analysis(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& output,
                   bool overwrite, const Context& context);

}  // namespace indet::app
