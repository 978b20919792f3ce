#include "libindet/io/lammps_columns.h"

#include <fmt/format.h>

#include "libindet/base/error.h"

namespace indet {

LammpsColumns::LammpsColumns(const std::map<std::string, std::string>& mapped)
    : names_{{"id", "id"},         {"x", "x"},           {"y", "y"},        {"radius", "radius"},
             {"mass", "mass"},     {"vx", "vx"},         {"vy", "vy"},      {"omegaz", "omegaz"},
             {"atom1", "c_pp[1]"}, {"atom2", "c_pp[2]"}, {"fx", "c_pl[3]"}, {"fy", "c_pl[4]"},
             {"p1", "c_pl[5]"},    {"p2", "c_pl[6]"}} {
  for (const auto& [key, name] : mapped) {
    if (key.starts_with("wall:") && key.size() > 5) {
      walls_[key.substr(5)] = name;
    } else if (const auto known = names_.find(key); known != names_.end()) {
      known->second = name;
    } else {
      std::string keys;
      for (const auto& [valid, unused] : names_) keys += valid + ", ";
      throw InputError(fmt::format("--columns: {} is unknown; the known ones are {}wall:NAME", key, keys));
    }
  }
}

std::map<std::string, std::string> LammpsColumns::walls(const Table& atoms) const {
  std::map<std::string, std::string> found = walls_;
  if (found.empty()) {
    for (const std::string& column : atoms.columns()) {
      if (column.starts_with("f_") && column.ends_with("[8]") &&
          !atoms.has(column.substr(0, column.size() - 2) + "9]")) {
        const std::string prefix = column.substr(0, column.size() - 3);
        found[prefix.substr(2)] = prefix;
      }
    }
  }
  for (const auto& [name, prefix] : found) {
    for (int i = 1; i <= 8; ++i) atoms.require({fmt::format("{}[{}]", prefix, i)});
  }
  return found;
}

}  // namespace indet
