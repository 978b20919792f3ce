#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "libindet/base/index.h"
#include "libindet/packing/cell.h"
#include "libindet/packing/force.h"
#include "libindet/packing/vectors.h"

namespace indet {

/// A static packing of rigid disks, in the units of its scene (docs/notation.md). This is the value that
/// simulators and importers return, and that the analysis starts from.
///
/// Contact α joins disk a and body b (a disk or a wall). n̂ points from b to a [9]; t̂ = n̂ × ẑ = (n_y, −n_x)
/// [10]. The force on a is R n̂ + T t̂, on b the opposite [11]. The torque of T on a is l_a T, on b l_b T (both
/// counter-clockwise). The lever arm l is the disk's radius [15] unless the contact says otherwise: soft
/// disks overlap, and many codes put the force at the middle of the overlap. (Numbers in brackets: equations
/// of McNamara and Herrmann.)

/// One rigid disk. A disk is free, or fixed (glued, frozen): a fixed disk has no equation, its weight and its
/// load act on nothing, and neither counts in N nor in mg.
struct Disk {
  std::int32_t id = 0;  ///< The name that the user gave it; not an index.
  Vector2 position{0, 0};
  double radius = 0;
  double mass = 0;
  double inertia = 0;  ///< Moment of inertia; m r²/2 unless the scene says otherwise.
  double angle = 0;    ///< Orientation, radian.
  Vector2 velocity{0, 0};
  double angular_velocity = 0;
  Vector3 load{0, 0, 0};  ///< External force x, y and torque, beside gravity.
  bool fixed = false;
};

/// A half-plane: the domain is {x : normal · (x − point) ≥ 0}. It is fixed, or loaded (a piston): then it is
/// free to move along its normal, its tangent or both, but does not turn, and the sums over its contacts are
///
///     ΣR = load_n,  ΣT = load_t   (the weight of a lid is part of them).
struct Wall {
  std::int32_t id = 0;
  Vector2 point{0, 0};
  Vector2 normal{0, 1};  ///< Unit vector, pointing into the domain.
  std::string name;
  /// What pushes it along the normal, into the domain, and along the tangent. NaN: it is not free in that
  /// direction; 0: it is free, and nothing pushes.
  double load_n = std::numeric_limits<double>::quiet_NaN();
  double load_t = std::numeric_limits<double>::quiet_NaN();

  Vector2 tangent() const { return {normal.y(), -normal.x()}; }  ///< t̂ = n̂ × ẑ, as of contacts
  bool is_free_along_normal() const { return !std::isnan(load_n); }
  bool is_free_along_tangent() const { return !std::isnan(load_t); }
  bool is_loaded() const { return is_free_along_normal() || is_free_along_tangent(); }
};

/// The second body of a contact: a disk or a wall. In files a wall w is written as −(w + 1). Equations and
/// motions are also of the cell, which no contact is with; its components are those of the stress: 0 xx, 1
/// yy, 2 xy, 3 pressure.
class Body {
 public:
  Body() = default;
  static Body disk(DiskId id) { return Body(id.value()); }
  static Body wall(WallId id) { return Body(-(id.value() + 1)); }
  static Body cell() { return Body(std::numeric_limits<std::int32_t>::min()); }
  static Body from_code(std::int32_t code) { return Body(code); }

  bool is_cell() const { return *this == cell(); }
  bool is_wall() const { return code_ < 0 && !is_cell(); }
  DiskId disk_id() const { return DiskId(code_); }       ///< Precondition: !is_wall(), !is_cell().
  WallId wall_id() const { return WallId(-code_ - 1); }  ///< Precondition: is_wall().
  std::int32_t code() const { return code_; }
  bool operator==(const Body&) const = default;
  /// A disk or a wall of a scene with so many.
  bool is_among(int disks, int walls) const {
    if (is_cell()) return false;
    return is_wall() ? wall_id().value() < walls : disk_id().value() < disks;
  }

 private:
  explicit Body(std::int32_t code) : code_(code) {}
  std::int32_t code_ = 0;
};

/// One contact, with the forces that the simulation found, where they are known.
struct Contact {
  DiskId a;
  Body b;
  Vector2 normal{0, 0};  ///< n̂, unit, from b to a.
  double gap = 0;        ///< Distance of the surfaces; negative where they overlap.
  double mu = 0;         ///< Coulomb friction coefficient of this contact, ≥ 0.
  double R = std::numeric_limits<double>::quiet_NaN();  ///< Normal force as simulated; NaN if unknown.
  double T = std::numeric_limits<double>::quiet_NaN();  ///< Tangential force as simulated; NaN if unknown.
  /// Arm of the torque of T on a and on b; NaN: the radius. A wall has none. Packing::lever_a, lever_b.
  double lever_a = std::numeric_limits<double>::quiet_NaN();
  double lever_b = std::numeric_limits<double>::quiet_NaN();
  /// What the scene allows beside friction: R_lo ≤ R ≤ R_hi, T_lo ≤ T ≤ T_hi (force_bounds.h). R_lo < 0 is
  /// the same as 0: there is no cohesion.
  double R_lo = -std::numeric_limits<double>::infinity();
  double R_hi = std::numeric_limits<double>::infinity();
  double T_lo = -std::numeric_limits<double>::infinity();
  double T_hi = std::numeric_limits<double>::infinity();

  bool is_bounded() const {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    return R_lo > -kNone || R_hi < kNone || T_lo > -kNone || T_hi < kNone;
  }
  /// Of a periodic scene: which image of b it is with. 0 of walls. A disk may touch images of itself.
  Image image{0, 0};

  bool has_image() const { return image[0] != 0 || image[1] != 0; }
  /// t̂ = n̂ × ẑ = (n_y, −n_x) [10].
  Vector2 tangent() const { return {normal.y(), -normal.x()}; }
};

/// Where a packing comes from: attributes of /parameters in its file.
struct Origin {
  std::string protocol;    ///< "cd1", "md2", "import csv", …
  std::int64_t seed = -1;  ///< −1: no seed.
  std::string config;      ///< The resolved configuration (TOML) that made it.
  /// Lx, Ly: of the box, or the grid, that it was simulated in; 0: not known.
  double width = 0, height = 0;
};

struct Packing {
  std::vector<Disk> disks;
  std::vector<Wall> walls;
  std::vector<Contact> contacts;
  Vector2 gravity{0, 0};        ///< Acceleration.
  double named_force_unit = 0;  ///< Unit of force that the scene names; 0: the mean weight of a disk.
  Cell cell;
  Stress stress;  ///< Imposed on the cell.
  Origin origin;

  int disk_count() const { return static_cast<int>(disks.size()); }
  int free_disk_count() const;  ///< N: disks that are not fixed.
  int fixed_disk_count() const { return disk_count() - free_disk_count(); }
  bool has_loaded_walls() const;
  bool floats()
      const;  ///< A full cell that no fixed disk holds: two equations of force depend on the others.
  /// 2M − 3N, less the directions in which walls are loaded and the components of stress that are imposed:
  /// the least nullity of c. In a full cell that nothing fixed holds, 2 of the equations of force follow from
  /// the others, so it is 2 more.
  int expected_dimension() const;
  int wall_count() const { return static_cast<int>(walls.size()); }
  int contact_count() const { return static_cast<int>(contacts.size()); }

  /// The unit in which forces are computed and printed: the named one, else the mean weight |g| Σm/N of
  /// the free disks ("mg" in the paper), else, where nothing has weight, the largest load, else the largest
  /// known force, else 1. 1 for a packing without free disks.
  double force_unit() const;
  bool has_weight() const;  ///< of some free disk
  /// The largest part of what acts on a free disk (torques over the radius) or a loaded wall, or the largest
  /// stress times the largest diameter.
  double largest_load() const;

  /// The unit in which the equilibrium problem is solved and residuals are judged. force_unit(), unless that
  /// says little about the scene: where the largest load on a disk or wall, or stress times the largest
  /// diameter, is more than 1000 times larger or smaller, the power of two next to it. Tolerances then mean
  /// the same whatever unit a scene names. (Narrow bounds of forces make the problem's unit finer:
  /// bound_rows.h.)
  double internal_force_unit() const;

  /// Between both and the scene's own unit.
  ForceUnits force_units() const { return {force_unit(), internal_force_unit()}; }

  /// Radius of the largest disk, the unit of length (1 for a packing without disks).
  double max_radius() const;

  /// External wrench on disk i: m g plus its load (force x, force y, torque). 0 for a fixed disk.
  Vector3 wrench(DiskId disk) const;

  /// True for a free disk and a loaded wall. A contact between two bodies without equations has no part in
  /// the problem.
  bool has_equations(DiskId disk) const { return !(*this)[disk].fixed; }
  bool has_equations(Body body) const {
    if (body.is_cell()) return stress.is_imposed();
    return body.is_wall() ? (*this)[body.wall_id()].is_loaded() : has_equations(body.disk_id());
  }
  bool is_free_disk(Body body) const {
    return !body.is_wall() && !body.is_cell() && has_equations(body.disk_id());
  }

  /// The arm of the torque of T on a; on b, 0 if b is a wall.
  double lever_a(ContactId contact) const { return lever_a((*this)[contact]); }
  double lever_b(ContactId contact) const { return lever_b((*this)[contact]); }
  double lever_a(const Contact& contact) const;  ///< Of one of this packing's disks.
  double lever_b(const Contact& contact) const;
  bool has_levers() const;         ///< Some contact has a lever of its own.
  bool has_bound_columns() const;  ///< Some contact has an R_lo, R_hi, T_lo or T_hi (force_bounds.h).
  /// Where the force of a contact acts: x_a − l_a n̂.
  Vector2 contact_point(const Contact& contact) const;
  /// l = x_a − (x_b + image · cell vectors) of a contact of two disks, to one rounding of |l|.
  Vector2 branch(const Contact& contact) const;
  /// √A of a full cell, but at least the largest diameter: equations of stress are divided by it, and so are
  /// forces across a side of the cell.
  double cell_length() const;

  /// The simulated forces, 2M; NaN where unknown.
  SceneForces simulated_forces() const;

  /// True if R and T of every contact are known.
  bool has_simulated_forces() const;

  const Disk& operator[](DiskId i) const { return disks[static_cast<std::size_t>(i.value())]; }
  const Wall& operator[](WallId i) const { return walls[static_cast<std::size_t>(i.value())]; }
  const Contact& operator[](ContactId i) const { return contacts[static_cast<std::size_t>(i.value())]; }
};

/// A wall for a person: its name, or its id where it has none.
std::string wall_name(const Wall& wall);

/// The bodies of a contact for a person, by their names in the scene: "12–7", "12–wall floor", and with an
/// image "12–7 (1, 0)".
std::string contact_name(const Packing& packing, ContactId contact);

/// x_a − (x_b + image · cell vectors), to one rounding of its length.
Vector2 centre_difference(const Packing& packing, DiskId a, DiskId b, const Image& image);

/// The image of disk b that is nearest to disk a; of two equally near ones the same each time. Of a disk
/// itself, the nearest that is not itself. (0, 0) where the scene is not periodic.
Image nearest_image(const Packing& packing, DiskId a, DiskId b);

/// The direction from body b (its image, if it is a disk) to the centre of disk a, from the positions alone
/// [9]: that of centre_difference for two disks, the wall's normal for a wall; unit length. Throws InputError
/// if two centres coincide.
Vector2 geometric_normal(const Packing& packing, DiskId a, Body b, const Image& image = {0, 0});

/// Distance of the surfaces of disk a and (the image of) body b from the positions alone; negative where they
/// overlap.
double geometric_gap(const Packing& packing, DiskId a, Body b, const Image& image = {0, 0});

}  // namespace indet
