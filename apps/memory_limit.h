#pragma once

#include <cstddef>
#include <string>

namespace indet::app {

/// Under a limit of address space (ulimit -v): why the program cannot start, or nothing. OpenBLAS waits for
/// ever where it cannot have its buffers, so what it takes is asked for before it is needed.
std::string lack_of_memory();

/// Throws InputError if `task` needs more bytes than this process can have: of what the machine has left, of
/// what its group of processes may take (a container), and of its address space (ulimit -v).
void require_memory(std::size_t bytes, const std::string& task);

}  // namespace indet::app
