#pragma once

#include <string>

namespace indet::app {

/// Under a limit of address space (ulimit -v): why the program cannot start, or nothing. OpenBLAS waits for
/// ever where it cannot have its buffers, so what it takes is asked for before it is needed.
std::string lack_of_memory();

}  // namespace indet::app
