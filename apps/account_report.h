#pragma once

#include <string>

#include "apps/file_contents.h"

namespace indet::app {

/// A line of `inspect`.
void print_line(const std::string& name, const std::string& value);

/// What `inspect` shows of /simulation, /tilt and /sampling.
void print_simulation(const Account& s);
void print_tilt(const Account& t);
void print_sampling(const Account& s);

}  // namespace indet::app
