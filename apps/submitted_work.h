#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "apps/analyze_arguments.h"
#include "apps/command.h"
#include "apps/ensemble_arguments.h"

namespace indet::app {

/// Work that is about to be submitted: what its folder is to hold, and how it can be dealt.
struct SubmittedWork {
  std::string folder;
  std::string subcommand;  ///< That does it.
  std::int64_t items = 0;
  std::string item;           ///< What they are, for one: "packing".
  std::vector<double> costs;  ///< Of each group that is dealt, estimated seconds on one core.
  std::string group, groups;  ///< "seed or file", "seeds and files"
  double seconds_to_collect = 0;
  std::vector<std::string> afterwards;  ///< Arguments of the program once all is collected; empty: none.
  std::function<void()> write_plan;     ///< Into the folder, which is there.
};

/// Throws like the subcommand before it computes, InputError where it may not write into the folder.
SubmittedWork submitted_ensemble(const EnsembleArguments& arguments, bool overwrite, const Context& context);
SubmittedWork submitted_analysis(const AnalyzeArguments& arguments, const std::string& folder, bool overwrite,
                                 const Context& context);

}  // namespace indet::app
