#include "libindet/io/imbalance.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "libindet/base/counted.h"
#include "libindet/base/tolerances.h"
#include "libindet/equilibrium/contact_state.h"

namespace indet {
namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// A component that is nothing beside the vector is 0.
double without_noise(double component, const Vector2& vector) {
  return std::abs(component) <= tolerance::kPrintedComponent * vector.norm() ? 0 : component;
}

class CauseSearch {
 public:
  CauseSearch(const ImportedPacking& imported, double tolerance)
      : imported_(imported),
        packing_(imported.packing),
        tolerance_(tolerance),
        residual_(equilibrium_residual(packing_, packing_.simulated_forces())),
        worst_(worst_of([](int) { return true; })) {}

  std::vector<ImbalanceCause> causes() {
    look_at_levers();
    if (worst_ > tolerance_) {
      look_for_gravity();
      look_for_walls();
      look_for_fixed_disks();
    } else {
      causes_.push_back(
          {fmt::format("gravity, walls, fixed disks: the net forces balance to {:.2g} mg, so these are "
                       "those of the simulation",
                       worst_),
           false});
    }
    look_at_friction();
    look_for_motion();
    return std::move(causes_);
  }

 private:
  double force(int disk) const { return std::hypot(residual_(disk, 0), residual_(disk, 1)); }

  /// The largest net force on the free disks that are `meant`.
  double worst_of(const std::function<bool(int)>& meant) const {
    double worst = 0;
    for (int i = 0; i < packing_.disk_count(); ++i) {
      if (packing_.has_equations(DiskId(i)) && meant(i)) worst = std::max(worst, force(i));
    }
    return worst;
  }

  void add(double left, const std::string& text) { causes_.push_back({text, left <= tolerance_}); }

  void look_for_gravity() {
    if (packing_.cell.is_full()) return;  // where no gravity can be
    const double unit = packing_.force_unit();
    std::vector<double> x, y;
    for (int i = 0; i < packing_.disk_count(); ++i) {
      const Disk& disk = packing_[DiskId(i)];
      if (disk.fixed) continue;
      x.push_back(packing_.gravity.x() - residual_(i, 0) * unit / disk.mass);
      y.push_back(packing_.gravity.y() - residual_(i, 1) * unit / disk.mass);
    }
    if (x.empty()) return;
    const Vector2 gravity(median(x), median(y));
    double left = 0;
    for (int i = 0; i < packing_.disk_count(); ++i) {
      const Disk& disk = packing_[DiskId(i)];
      if (disk.fixed) continue;
      const Vector2 change = disk.mass / unit * (gravity - packing_.gravity);
      left = std::max(left, (residual_.row(i).head<2>().transpose() + change).norm());
    }
    const std::string wanted = fmt::format("{:.6g},{:.6g}", without_noise(gravity.x(), gravity),
                                           without_noise(gravity.y(), gravity));
    const std::string taken = fmt::format("{:.6g},{:.6g}", packing_.gravity.x(), packing_.gravity.y());
    add(left,
        wanted == taken
            ? fmt::format("gravity: most disks want that which was taken, {}", taken)
            : fmt::format("gravity: --gravity {}, which most disks want instead of {}, would leave {:.2g} mg",
                          wanted, taken, left));
  }

  void look_for_walls() {
    if (packing_.cell.is_full()) return;  // which has no sides
    const double near = tolerance::kAtSide * packing_.max_radius();
    Vector2 low = Vector2::Constant(std::numeric_limits<double>::infinity());
    Vector2 high = -low;
    for (const Disk& disk : packing_.disks) {
      low = low.cwiseMin(disk.position - Vector2::Constant(disk.radius));
      high = high.cwiseMax(disk.position + Vector2::Constant(disk.radius));
    }
    int at_side = 0;
    const auto is_inside = [&](int i) {
      const Disk& disk = packing_[DiskId(i)];
      const Vector2 margin =
          (disk.position - low).cwiseMin(high - disk.position) - Vector2::Constant(disk.radius);
      return margin.minCoeff() > near;
    };
    for (int i = 0; i < packing_.disk_count(); ++i) at_side += is_inside(i) ? 0 : 1;
    if (at_side == packing_.disk_count()) {
      causes_.push_back(
          {"walls: every disk reaches to a side of the packing, and may lack the force of a wall", false});
      return;
    }
    const double left = worst_of(is_inside);
    const int walls = packing_.wall_count();
    const std::string there = walls == 0   ? "are no walls at all"
                              : walls == 1 ? "is 1 wall"
                                           : fmt::format("are {} walls", walls);
    add(left,
        fmt::format("walls: on the {} that reach to no side of the packing {:.2g} mg is left; {} at "
                    "its sides may lack the force of a wall (there {})",
                    counted(packing_.disk_count() - at_side, "disk"), left, counted(at_side, "disk"), there));
  }

  void look_for_fixed_disks() {
    const std::set<int> types(imported_.types.begin(), imported_.types.end());
    double best = std::numeric_limits<double>::infinity();
    int fixed = -1;
    for (const int type : types) {
      const double left =
          worst_of([&](int i) { return imported_.types[static_cast<std::size_t>(i)] != type; });
      if (types.size() > 1 && left < best) {
        best = left;
        fixed = type;
      }
    }
    std::vector<int> unbalanced;
    for (int i = 0; i < packing_.disk_count(); ++i) {
      if (packing_.has_equations(DiskId(i)) && force(i) > tolerance_) unbalanced.push_back(i);
    }
    if (types.size() > 1) {
      add(best, fmt::format("fixed disks: --fixed type={} would leave {:.2g} mg", fixed, best));
      if (best <= tolerance_) return;
    }
    if (2 * static_cast<int>(unbalanced.size()) > packing_.free_disk_count()) {
      causes_.push_back({fmt::format("fixed disks: {} of {} do not balance, too many to be glued or frozen",
                                     unbalanced.size(), counted(packing_.free_disk_count(), "disk")),
                         false});
      return;
    }
    constexpr std::size_t kShown = 8;
    std::string ids;
    for (std::size_t i = 0; i < std::min(kShown, unbalanced.size()); ++i) {
      ids += fmt::format("{}{}", i == 0 ? "" : ",", packing_[DiskId(unbalanced[i])].id);
    }
    if (unbalanced.size() > kShown) ids += ",…";
    const double left = worst_of([&](int i) { return force(i) <= tolerance_; });
    add(left,
        fmt::format("fixed disks: {} not balance ({}), the others do to {:.2g} mg; if these are glued or "
                    "frozen, say so: --fixed {}",
                    counted(static_cast<std::int64_t>(unbalanced.size()), "disk does", "disks do"), ids, left,
                    ids));
  }

  void look_at_levers() {
    if (!imported_.levers || imported_.levers->trials.empty()) return;
    const auto& trials = imported_.levers->trials;
    const auto best =
        std::min_element(trials.begin(), trials.end(),
                         [](const LeverTrial& a, const LeverTrial& b) { return a.residual < b.residual; });
    causes_.push_back(
        {fmt::format("lever arms: of {} allowed, --lever {} leaves the smallest torque, {:.2g} "
                     "mg r{}",
                     counted(static_cast<std::int64_t>(trials.size()), "choice"), name_of(best->levers),
                     best->residual, best->residual <= tolerance_ ? ", and balances" : ""),
         false});
  }

  void look_for_motion() {
    const double unit = packing_.force_unit();
    double largest = 0;
    const Disk* fastest = nullptr;
    for (const Disk& disk : packing_.disks) {
      if (disk.fixed) continue;
      const double energy = 0.5 * (disk.mass * disk.velocity.squaredNorm() +
                                   disk.inertia * disk.angular_velocity * disk.angular_velocity);
      if (energy / (unit * disk.radius) <= largest) continue;
      largest = energy / (unit * disk.radius);
      fastest = &disk;
    }
    if (fastest == nullptr || largest <= tolerance::kMoving) return;
    causes_.push_back(
        {fmt::format("motion: the packing is not at rest; disk {} has the kinetic energy {:.2g} mg r",
                     fastest->id, largest),
         false});
  }

  void look_at_friction() {
    const CoulombCount coulomb = count_coulomb(packing_, packing_.simulated_forces(), tolerance::kSliding);
    causes_.push_back(
        {coulomb.violated == 0
             ? std::string("friction: does not enter the balance; every contact is within the Coulomb limit")
             : fmt::format("friction: does not enter the balance; but {} beyond the Coulomb limit, by up to "
                           "{:.2g} mg",
                           counted(coulomb.violated, "contact is", "contacts are"), coulomb.worst_violation),
         false});
  }

  const ImportedPacking& imported_;
  const Packing& packing_;
  double tolerance_;
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> residual_;
  double worst_;
  std::vector<ImbalanceCause> causes_;
};

}  // namespace

std::vector<ImbalanceCause> find_causes(const ImportedPacking& imported, double tolerance) {
  return CauseSearch(imported, tolerance).causes();
}

}  // namespace indet
