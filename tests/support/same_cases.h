#pragma once

#include <cstdlib>

namespace indet::test {

/// Who includes this has the same cases of RapidCheck in every run, unless the environment asks for others.
inline const int kSameCases = setenv("RC_PARAMS", "seed=2026", 0);

}  // namespace indet::test
