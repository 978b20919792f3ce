#include "bench/methods/rivals.h"

namespace indet::bench {

std::optional<Tally> natural_order_clp(const ForcePolytope&) { return {}; }

}  // namespace indet::bench
