#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace indet {

/// Which Coulomb coefficient μ ≥ 0 a contact has, by what its two bodies are. A rule is a list of items:
///
///   0.3               every contact that no other item names
///   disk=0.4          two disks
///   wall=0            a disk and a wall
///   wall:floor=0.2    a disk and this wall
///   type:1-2=0.3      a disk of type 1 and one of type 2 (types of atoms of LAMMPS and LIGGGHTS)
///
/// The item that says most decides: a wall by its name, or a pair of types, then wall or disk, then the
/// number.
class FrictionRule {
 public:
  FrictionRule() = default;
  /// Every contact has this coefficient. Throws InputError unless it is a number ≥ 0.
  explicit FrictionRule(double friction);
  /// Throws InputError if an item has none of these forms, or is given twice.
  static FrictionRule parse(const std::vector<std::string>& items);

  bool empty() const { return !all_ && !disk_ && !wall_ && walls_.empty() && types_.empty(); }
  /// True if some item may be about two disks.
  bool covers_disks() const { return all_ || disk_ || !types_.empty(); }

  /// Of two disks with these types; none if no item is about them.
  std::optional<double> of_disks(int type_a, int type_b) const;
  /// Of a disk and a wall that goes by any of these names.
  std::optional<double> of_wall(const std::vector<std::string>& names) const;

  /// The names of walls and the types that items name, to be compared with those that there are.
  const std::map<std::string, double>& walls() const { return walls_; }
  const std::map<std::pair<int, int>, double>& types() const { return types_; }

 private:
  void add(const std::string& item);

  std::optional<double> all_, disk_, wall_;
  std::map<std::string, double> walls_;
  std::map<std::pair<int, int>, double> types_;  ///< The smaller type first.
};

}  // namespace indet
