#pragma once

#include <string>

#include "libindet/verify/verification.h"

namespace indet {

/// Of what contradicts; "" if nothing does.
inline std::string first_message(const Verification& found) {
  return found.messages.empty() ? "" : found.messages.front();
}

}  // namespace indet
