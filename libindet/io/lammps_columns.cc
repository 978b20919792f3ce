#include "libindet/io/lammps_columns.h"

#include <fmt/format.h>

#include <cmath>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"

namespace indet {
namespace {

/// What a key of the plane x, y is called in this one.
std::string in_plane(const std::string& key, const Plane& plane) {
  if (key == "y") return {Plane::letter(plane.second)};
  if (key == "vy") return {'v', Plane::letter(plane.second)};
  if (key == "fy") return {'f', Plane::letter(plane.second)};
  if (key == "p2") return {'p', static_cast<char>('1' + plane.second)};
  if (key == "omegaz") return std::string("omega") + Plane::letter(plane.normal);
  return key;
}

}  // namespace

LammpsColumns::LammpsColumns(const std::map<std::string, std::string>& mapped, const Plane& plane)
    : names_{{"id", "id"},
             {"type", "type"},
             {"x", "x"},
             {"y", "y"},
             {"radius", "radius"},
             {"mass", "mass"},
             {"vx", "vx"},
             {"vy", "vy"},
             {"omegaz", "omegaz"},
             {"atom1", "c_pp[1]"},
             {"atom2", "c_pp[2]"},
             {"fx", "c_pl[3]"},
             {"fy", "c_pl[4]"},
             {"p1", "c_pl[5]"},
             {"p2", "c_pl[6]"},
             {"mu", ""},
             {"diameter", "diameter"}} {
  std::map<std::string, std::string> keys;  // as they are called in this plane
  for (auto& [key, name] : names_) {
    keys[in_plane(key, plane)] = key;
    if (name == key) name = in_plane(key, plane);
  }
  for (const auto& [key, name] : mapped) {
    if (key.starts_with("wall:") && key.size() > 5) {
      walls_[key.substr(5)] = name;
    } else if (const auto known = keys.find(key); known != keys.end()) {
      names_[known->second] = name;
      named_[known->second] = name;
    } else {
      std::string list;
      for (const auto& [valid, unused] : keys) list += valid + ", ";
      throw InputError(fmt::format("--columns: {} is unknown; the known ones are {}wall:NAME", key, list));
    }
  }
}

bool LammpsColumns::looks_like_a_wall(const Table& atoms, const std::string& prefix) const {
  if (!atoms.has(names_.at("radius"))) return true;
  for (int row = 0; row < atoms.rows(); ++row) {
    const double flag = atoms.number(row, prefix + "[1]");
    if (flag == 0) continue;
    const double radius = atoms.number(row, names_.at("radius"));
    if (flag != 1 ||
        std::abs(atoms.number(row, prefix + "[8]") - radius) > tolerance::kPrintedForce * radius) {
      return false;
    }
  }
  return true;
}

std::map<std::string, std::string> LammpsColumns::walls(const Table& atoms) const {
  const auto require = [&](const std::string& prefix) {
    for (int i = 1; i <= 8; ++i) atoms.require({fmt::format("{}[{}]", prefix, i)});
  };
  std::map<std::string, std::string> found = walls_;
  for (const auto& [name, prefix] : walls_) require(prefix);
  if (!found.empty()) return found;
  for (const std::string& column : atoms.columns()) {
    if (!column.starts_with("f_") || !column.ends_with("[8]")) continue;
    const std::string prefix = column.substr(0, column.size() - 3);
    // Newer versions append more columns; other fixes have as many.
    if (!atoms.has(prefix + "[9]")) require(prefix);
    if (!atoms.has(prefix + "[9]") || looks_like_a_wall(atoms, prefix)) found[prefix.substr(2)] = prefix;
  }
  return found;
}

}  // namespace indet
