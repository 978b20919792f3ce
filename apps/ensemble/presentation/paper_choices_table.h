#pragma once

namespace indet {

/// docs/measurements/paper-choices.tsv as it was when the program was built.
const char* paper_choices_table();

}  // namespace indet
