#pragma once

#include <map>
#include <string>
#include <vector>

#include "libindet/io/plane.h"
#include "libindet/io/table.h"

namespace indet {

/// Names of the columns of dumps of LAMMPS: the defaults of the documented script, and what the user put in
/// their place. In another plane than x, y the keys follow its axes: x, z, vx, vz, omegay, fx, fz, p1, p3.
class LammpsColumns {
 public:
  /// Throws InputError if a key is unknown.
  LammpsColumns(const std::map<std::string, std::string>& mapped, const Plane& plane);

  /// The column of a key as it is in the plane x, y.
  const std::string& operator[](const std::string& key) const { return names_.at(key); }
  /// True if the user named the column of this key (as in the plane x, y).
  bool is_named(const std::string& key) const { return named_.contains(key); }
  bool names_walls() const { return !walls_.empty(); }  ///< True if the user named a wall.

  /// Name and column prefix of each wall: those that the user named, else every fix whose columns look like
  /// those of `fix wall/gran … contacts`: at least eight, of which in each row the first is 0, or 1 and the
  /// eighth the atom's radius. Throws InputError if a column of a named wall, or one before the eighth, is
  /// missing.
  std::map<std::string, std::string> walls(const Table& atoms) const;

 private:
  bool looks_like_a_wall(const Table& atoms, const std::string& prefix) const;

  std::map<std::string, std::string> names_;
  std::map<std::string, std::string> named_;  ///< By the user.
  std::map<std::string, std::string> walls_;  ///< Prefix of each wall that the user named.
};

}  // namespace indet
