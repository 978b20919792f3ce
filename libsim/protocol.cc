#include "libsim/protocol.h"

#include <algorithm>

namespace indet::sim {

const char* to_string(Simulator simulator) {
  return simulator == Simulator::kContactDynamics ? "contact dynamics" : "molecular dynamics";
}

std::vector<std::string> simulated_names() {
  std::vector<std::string> names;
  for (const Protocol protocol : kSimulated) names.emplace_back(to_string(protocol));
  return names;
}

std::optional<Protocol> protocol_from(std::string_view name) {
  const auto* const found = std::find_if(kProtocols.begin(), kProtocols.end(),
                                         [&](const ProtocolProperties& p) { return p.name == name; });
  if (found == kProtocols.end()) return {};
  return found->protocol;
}

}  // namespace indet::sim
