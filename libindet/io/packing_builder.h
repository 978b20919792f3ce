#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "libindet/io/import_settings.h"
#include "libindet/io/imported_packing.h"
#include "libindet/io/table.h"
#include "libindet/packing/validate.h"

namespace indet {

/// Where something was read.
struct Place {
  std::string source;  ///< file
  int line = 0;        ///< from 1; 0: the file as a whole
  /// Throws InputError: "contacts.dump:13: reason".
  [[noreturn]] void fail(const std::string& reason) const;
};

/// The place of a row.
inline Place place_of(const Table& table, int row) { return {table.source(), table.line(row)}; }

/// Makes a packing of what a reader of another code's files finds: first all disks, then walls and contacts,
/// in any order. All that does not depend on the format is here: ids become indices, disks are sorted by id
/// and contacts by their bodies, normals and gaps follow from the positions, a contact that is listed twice
/// with one force counts once, contacts that say nothing are left out and counted, each contact gets its
/// friction. Every complaint names the place that its cause was read from.
class PackingBuilder {
 public:
  /// `protocol`: "import yade". `noun`: what the code calls a disk, "atom". `source`: the file that is named
  /// where no line is to blame.
  PackingBuilder(std::string protocol, std::string noun, std::string source, const ImportSettings& settings);

  /// `type`: of the material, −1 if there is none. A disk is fixed if it says so or the settings do.
  void add_disk(const Disk& disk, int type, const Place& place);
  /// Sorts the disks and checks them. Throws InputError if there is none that moves, an id is given twice, a
  /// number cannot be, or the rule of fixed disks names one that is not there.
  void close_disks();

  /// `names`: by which a friction may name it, beside its own name (of the fix that has several planes).
  WallId add_wall(Wall wall, const std::vector<std::string>& names, const Place& place);

  /// The disk with this id. Throws InputError if there is none. Precondition: close_disks().
  DiskId disk(std::int32_t id, const Place& place) const;
  std::optional<DiskId> find_disk(std::int32_t id) const;
  int type(DiskId disk) const { return types_[static_cast<std::size_t>(disk.value())]; }

  /// A contact with normal and gap from the positions, NaN for μ (which then follows from the rule), R and T.
  /// In a cell it is with the nearest image of b (but not with a itself). Throws InputError if a disk touches
  /// itself or two centres coincide.
  Contact contact(DiskId a, Body b, const Place& place) const;
  /// Sets R and T to the projections on n̂ and t̂ of the force on a.
  static void project(Contact& contact, const Vector2& force);
  /// Takes a contact, or leaves it out. Throws InputError if its force is not finite, its bodies push each
  /// other across a distance, or it was given before with another force.
  void add_contact(const Contact& contact, const Place& place);

  /// Contacts are with the nearest images of disks. Precondition: close_disks(), no contact yet.
  void set_cell(const Cell& cell) { packing_.cell = cell; }
  /// The box is periodic, but the format does not tell how: what seems to push across a distance may do so
  /// across a boundary.
  void set_periodic() { periodic_ = true; }
  void warn(std::string text) { imported_.warnings.push_back(std::move(text)); }
  const Packing& packing() const { return imported_.packing; }

  /// The packing, valid, with warnings about what was left out. Directions of the cell that no contact
  /// crosses are left out too. `gravity`: that of the files; where neither they nor the settings name one,
  /// it is (0, −1), and none in a full cell. Throws InputError, also
  /// if a contact has no friction, the friction names a wall or a pair of types that no contact has, or there
  /// is neither gravity nor a unit of force.
  ImportedPacking build(const std::optional<Vector2>& gravity);

 private:
  struct FoundDisk {
    Disk disk;
    int type;
    Place place;
  };
  struct FoundContact {
    Contact contact;
    Place place;
  };

  void check_fixed_names() const;
  void check_friction_names() const;
  void set_friction();
  void sort_contacts();
  void drop_idle_directions();
  void require_force_unit() const;
  void find_defects() const;
  void warn_of_what_was_left_out();
  std::string plural() const;  ///< Of the noun.
  std::string bodies_of(const Contact& contact) const;

  std::string noun_, source_;
  const ImportSettings& settings_;
  ImportedPacking imported_;
  Packing& packing_ = imported_.packing;
  std::vector<FoundDisk> found_disks_;
  std::vector<int> types_;
  std::vector<Place> disk_places_, wall_places_;
  std::vector<std::vector<std::string>> wall_names_;
  std::unordered_map<std::int32_t, int> index_of_id_;
  std::vector<FoundContact> contacts_;
  std::map<ContactKey, FoundContact> first_;  ///< By bodies and image.
  bool periodic_ = false;
  int apart_ = 0;  ///< Contacts that neither touch nor push.
  Place apart_place_, repeated_place_;
};

}  // namespace indet
