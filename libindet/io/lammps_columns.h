#pragma once

#include <map>
#include <string>

#include "libindet/io/table.h"

namespace indet {

/// Names of the columns of LAMMPS dumps: the defaults of the documented script, and what the user put in
/// their place.
class LammpsColumns {
 public:
  /// Throws InputError if a key is unknown.
  explicit LammpsColumns(const std::map<std::string, std::string>& mapped);

  const std::string& operator[](const std::string& key) const { return names_.at(key); }

  /// Name and column prefix of each wall: those that the user named, else every fix of which the dump has the
  /// eighth column (the number of columns of a wall fix). Throws InputError if a column is missing.
  std::map<std::string, std::string> walls(const Table& atoms) const;

 private:
  std::map<std::string, std::string> names_;
  std::map<std::string, std::string> walls_;
};

}  // namespace indet
