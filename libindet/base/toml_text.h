#pragma once

#include <string>

namespace indet {

/// A text as a value in TOML, with its quotation marks, and escapes where they are needed; in one line,
/// unless the text is of whole lines. Precondition: it is UTF-8.
std::string toml_text(const std::string& text);

}  // namespace indet
