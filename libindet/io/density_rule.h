#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace indet {

/// Mass and moment of inertia of a particle.
struct Inertia {
  double mass = 0;
  double moment = 0;
};

/// The density ρ of particles whose files have no masses. A rule is a list of items:
///
///   sphere=2500       spheres: m = 4/3 π r³ ρ, I = 2/5 m r² (ρ per volume)
///   disk=1.27         disks:   m = π r² ρ,     I = 1/2 m r² (ρ per area)
///   sphere:1=1000     those of species 1 (or disk:1)
///
/// All items are of spheres, or all of disks. The item that names the species decides.
class DensityRule {
 public:
  DensityRule() = default;
  /// Throws InputError if an item has none of these forms or no density > 0, one is given twice, or spheres
  /// and disks are mixed.
  static DensityRule parse(const std::vector<std::string>& items);

  bool empty() const { return !all_ && by_type_.empty(); }
  /// Of a particle with this radius and species; none if no item is about it.
  std::optional<Inertia> of_particle(double radius, int type) const;
  /// The densities by species, which must be compared with the species that there are.
  const std::map<int, double>& types() const { return by_type_; }

 private:
  void add(const std::string& item);

  bool spheres_ = false;
  std::optional<double> all_;
  std::map<int, double> by_type_;
};

}  // namespace indet
