#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "libindet/base/counted.h"
#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet::app {

/// "9 sliding contacts", from M_s, in which contacts without force count twice, and their number.
std::string describe_sliding(std::int64_t sliding, std::int64_t non_transmitting);

/// "12 disks", "12 disks (5 fixed)".
std::string describe_disks(const Packing& packing);

/// "R", "T" of a wall, "x", "y", "torque" of a fixed disk.
const char* reaction_component(Body body, int component);

/// "of 40 of 376 contacts given, 0.9876 … 1 of the radius". Precondition: packing.has_levers().
std::string describe_levers(const Packing& packing);

/// "2M − 3N = 92"; with loaded walls or imposed stress "2M − 3N − 4 = …" for 4 further equations, in a cell
/// that nothing fixed holds "… + 2 = …", for two of the equations that follow from the others.
std::string describe_expected_dimension(const Packing& packing);

/// "(10, 0), (0, 8)"; "(10, 0)" where one vector is missing. Precondition: it is periodic.
std::string describe_cell(const Cell& cell);

/// "xx = 1, yy = 1, xy = 0.02", "pressure = 1", "none".
std::string describe_stress(const Stress& stress);

/// null where the scene is not periodic; {"a": [10, 0], "b": null}.
nlohmann::json cell_to_json(const Cell& cell);
/// The components that are imposed.
nlohmann::json stress_to_json(const Stress& stress);

/// "linear programs (edge)", "pivoting-paper (neighbour: first, start: common)", "pivoting-tableau".
std::string describe_method(const ForceRanges& ranges);

}  // namespace indet::app
