#pragma once

#include <filesystem>
#include <vector>

#include "apps/analyze_arguments.h"
#include "apps/command.h"
#include "apps/scheduler.h"

namespace indet::app {

/// indet analyze --out FOLDER: computes a share of the chunks of an analysis, or what is left of all, and
/// then joins them. Returns the exit status.
int analyze_in_parts(const AnalyzeArguments& arguments, const std::filesystem::path& folder,
                     const ShareArguments& share, bool overwrite, const Context& context);

/// indet merge of such folders: joins what they have into one file. Returns the exit status.
int merge_analysis(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& output,
                   bool overwrite, const Context& context);

}  // namespace indet::app
