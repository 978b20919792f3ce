#include "libindet/packing/cancelling_loads.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "libindet/base/disjoint_sets.h"
#include "libindet/base/doubled_sum.h"
#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"

namespace indet {
namespace {

/// Bodies with equations, joined where a contact holds two of them: disk i is i, wall w is N + w.
class Groups {
 public:
  explicit Groups(const Packing& packing)
      : disks_(packing.disk_count()), sets_(disks_ + packing.wall_count()) {
    for (const Contact& contact : packing.contacts) {
      if (packing.has_equations(contact.a) && packing.has_equations(contact.b))
        sets_.join(contact.a.value(), number(contact.b));
    }
  }
  int of(int body) { return static_cast<int>(sets_.root(body)); }
  int number(Body body) const {
    return body.is_wall() ? disks_ + body.wall_id().value() : body.disk_id().value();
  }

 private:
  int disks_;
  DisjointSets sets_;
};

/// The directions of force that nothing fixed takes, orthonormal: none, one or both.
class FreeDirections {
 public:
  void remove(const Vector2& taken) {
    if (count_ == 0) return;
    if (count_ == 2) {
      first_ = Vector2(-taken.y(), taken.x());
      count_ = 1;
    } else if (std::abs(first_.dot(taken)) > tolerance::kFreeDirection) {
      count_ = 0;
    }
  }
  void remove_all() { count_ = 0; }
  int count() const { return count_; }
  /// One of them. Precondition: count() > 0.
  Vector2 along(const Vector2& wish) const { return count_ == 2 ? wish : first_; }
  bool contains_part_of(const Vector2& direction) const {
    return count_ == 2 || (count_ == 1 && std::abs(first_.dot(direction)) > tolerance::kFreeDirection);
  }

 private:
  int count_ = 2;
  Vector2 first_{1, 0};
};

/// Loads of one group of bodies.
struct Sum {
  Vector2 total{0, 0};
  double size = 0;  ///< Σ |load|
  void add(const Vector2& load) {
    total += load;
    size += load.norm();
  }
};

class Cancellation {
 public:
  explicit Cancellation(Packing& packing)
      : packing_(packing),
        groups_(packing),
        free_(packing.disks.size() + packing.walls.size()),
        loads_(free_.size()) {}

  std::vector<std::string> run() {
    find_free_directions();
    add_loads();
    if (packing_.cell.is_full()) require_exact_cancelling();
    for (int w = packing_.wall_count() - 1; w >= 0; --w) take_out(WallId(w));
    return std::move(notes_);
  }

 private:
  /// What a fixed body at one end of a contact takes from the body at its other end.
  void find_free_directions() {
    for (const Contact& contact : packing_.contacts) {
      const bool fixed_a = !packing_.has_equations(contact.a);
      if (fixed_a || (!contact.b.is_wall() && !packing_.has_equations(contact.b)))
        free_of(fixed_a ? contact.b : Body::disk(contact.a)).remove_all();
      if (!contact.b.is_wall()) continue;
      const Wall& wall = packing_[contact.b.wall_id()];
      FreeDirections& free = free_of(Body::disk(contact.a));
      if (!wall.is_free_along_normal()) free.remove(wall.normal);
      if (!wall.is_free_along_tangent() && contact.mu > 0) free.remove(wall.tangent());
    }
  }

  FreeDirections& free_of(Body body) {
    return free_[static_cast<std::size_t>(groups_.of(groups_.number(body)))];
  }

  void add_loads() {
    for (int i = 0; i < packing_.disk_count(); ++i) {
      const Vector3 wrench = packing_.wrench(DiskId(i));
      sum_of(i).add({wrench.x(), wrench.y()});
    }
    for (int w = 0; w < packing_.wall_count(); ++w) {
      const Wall& wall = packing_[WallId(w)];
      Sum& sum = sum_of(packing_.disk_count() + w);
      if (wall.is_free_along_normal()) sum.add(wall.load_n * wall.normal);
      if (wall.is_free_along_tangent()) sum.add(wall.load_t * wall.tangent());
    }
  }
  Sum& sum_of(int body) { return loads_[static_cast<std::size_t>(groups_.of(body))]; }

  /// Holds a wall in the directions that nothing else takes.
  void take_out(WallId id) {
    Wall& wall = packing_.walls[static_cast<std::size_t>(id.value())];
    if (!wall.is_loaded() || !touches(id)) return;
    const int number = packing_.disk_count() + id.value();
    FreeDirections& free = free_of(Body::wall(id));
    const auto hold = [&](double& load, const Vector2& direction, const char* name) {
      if (std::isnan(load) || !free.contains_part_of(direction)) return;
      require_cancelling(sum_of(number), free.along(direction));
      notes_.push_back(fmt::format(
          "nothing that is fixed takes the loads along ({:.4g}, {:.4g}); they cancel, so {} of "
          "wall {} follows from the others, and this wall is held instead",
          direction.x(), direction.y(), name, wall.name.empty() ? fmt::format("{}", wall.id) : wall.name));
      load = std::numeric_limits<double>::quiet_NaN();
      free.remove(direction);
    };
    // Only what some contact can push against holds anything: friction, for the tangent.
    hold(wall.load_n, wall.normal, "load_n");
    if (has_friction(id)) hold(wall.load_t, wall.tangent(), "load_t");
  }

  void require_exact_cancelling() {
    std::map<int, std::array<DoubledSum, 2>> sums;
    for (int i = 0; i < packing_.disk_count(); ++i) {
      if (!packing_.has_equations(DiskId(i)) || free_of(Body::disk(DiskId(i))).count() < 2) continue;
      for (const std::size_t k : {0U, 1U})
        sums[groups_.of(i)][k].add(packing_[DiskId(i)].load[static_cast<Eigen::Index>(k)]);
    }
    for (const auto& [group, sum] : sums) {
      if (sum[0].value() == 0 && sum[1].value() == 0) continue;
      throw InputError(fmt::format(
          "in a cell that is periodic in both directions nothing takes the loads of disks (fx, fy), so they "
          "must cancel exactly, but their sum is ({:.3g}, {:.3g}): the packing would move as a whole",
          sum[0].value(), sum[1].value()));
    }
  }

  bool touches(WallId wall) const {
    return std::any_of(packing_.contacts.begin(), packing_.contacts.end(),
                       [&](const Contact& contact) { return contact.b == Body::wall(wall); });
  }
  bool has_friction(WallId wall) const {
    return std::any_of(packing_.contacts.begin(), packing_.contacts.end(), [&](const Contact& contact) {
      return contact.b == Body::wall(wall) && contact.mu > 0;
    });
  }

  static void require_cancelling(const Sum& sum, const Vector2& direction) {
    const double along = sum.total.dot(direction);
    if (std::abs(along) <= tolerance::kCancellingLoads * sum.size) return;
    throw InputError(fmt::format(
        "nothing that is fixed takes the loads along ({:.4g}, {:.4g}), where their sum is {:.6g}, "
        "not 0: the packing would move as a whole. Give loads that cancel, or leave the load of "
        "one wall empty: it is then held, and bears what is left",
        direction.x(), direction.y(), along));
  }

  Packing& packing_;
  Groups groups_;
  std::vector<FreeDirections> free_;  ///< by group
  std::vector<Sum> loads_;            ///< by group
  std::vector<std::string> notes_;
};

}  // namespace

std::vector<std::string> take_out_cancelling_loads(Packing& packing) { return Cancellation(packing).run(); }

}  // namespace indet
