#pragma once

#include <string>
#include <vector>

#include "libindet/range/analyze_options.h"
#include "libindet/range/contact_choice.h"

namespace indet {

/// Some contacts of an analysis, which one process analyses at a time.
struct Chunk {
  std::string name;           ///< "contacts-0000-0063"; its file is chunks/NAME.h5.
  std::vector<int> contacts;  ///< Ascending.
  double cost = 0;            ///< Estimated seconds on one core.
};

/// What an analysis in parts is.
struct AnalysisPlan {
  std::string version;     ///< Of this program.
  std::string packing;     ///< SHA-256 of its numbers.
  std::string options;     ///< All else that its results depend on, TOML.
  ContactChoice contacts;  ///< kAll or kList.
  std::vector<Chunk> chunks;

  /// SHA-256 of what the results depend on.
  std::string hash() const;
};

/// `packing`: digest of one with so many contacts. The chunks do not depend on how many processes there are.
/// `conditions`: of --condition. Throws InputError where the analysis cannot be dealt.
AnalysisPlan make_analysis_plan(const std::string& packing, int contacts, const AnalyzeOptions& options,
                                const std::vector<std::string>& conditions);

/// "3,7,12-20", of ascending numbers; and these of such a text, nothing if it is none.
std::string to_list(const std::vector<int>& numbers);
std::vector<int> from_list(const std::string& text);

}  // namespace indet
