#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/analysis_parts/plan.h"

namespace indet {

/// The folder of an analysis in parts: analysis.toml says what it is and which chunks it has, chunks/NAME.h5
/// is what was found of the contacts of one, and ranges.h5 is made from these. Several processes may write
/// into it; each file appears whole.

/// FOLDER/analysis.toml. Left alone where it says so already.
void write_analysis_plan(const std::filesystem::path& folder, const AnalysisPlan& plan);
bool has_analysis_plan(const std::filesystem::path& folder);
/// Throws InputError.
AnalysisPlan read_analysis_plan(const std::filesystem::path& folder);

/// FOLDER/chunks, with one file a chunk.
std::filesystem::path chunks_folder(const std::filesystem::path& folder);
std::filesystem::path chunk_path(const std::filesystem::path& folder, const Chunk& chunk);
/// Those of all chunks, whether there is a file or not.
std::vector<std::filesystem::path> chunk_paths(const std::filesystem::path& folder, const AnalysisPlan& plan);

/// FOLDER/ranges.h5: the ranges of all contacts.
std::filesystem::path joined_path(const std::filesystem::path& folder);

}  // namespace indet
