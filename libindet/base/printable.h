#pragma once

#include <string>
#include <string_view>

namespace indet {

/// Text from a file or a command line as a terminal may show it: control characters, among them zero bytes
/// and those that begin escape sequences, become \xNN; line ends and tabs stay.
std::string printable(std::string_view text);

/// The same of at most 200 bytes of the text, for messages that quote it; "…" follows where there are more.
std::string excerpt(std::string_view text);

}  // namespace indet
