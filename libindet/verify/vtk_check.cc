#include "libindet/verify/vtk_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "libindet/base/tolerances.h"
#include "libindet/verify/comparisons.h"

namespace indet {
namespace {

const std::string kGroup = "/VTKHDF/";

class VtkVerifier {
 public:
  VtkVerifier(const Hdf5File& file, const Packing& packing, const ForceRanges& ranges)
      : file_(file), packing_(packing), ranges_(ranges), compare_("/VTKHDF") {}

  Verification run() {
    std::int64_t feet = 0;
    for (const Contact& contact : packing_.contacts)
      feet += contact.b.is_wall() || contact.has_image() ? 1 : 0;
    points_ = packing_.disk_count() + feet;
    check_counts();
    check_cells();
    check_points();
    check_links();
    check_outcomes();
    return compare_.result();
  }

 private:
  std::size_t cells() const { return packing_.contacts.size(); }
  std::vector<std::int64_t> long_integers(const char* name, std::size_t size) const {
    return file_.read_long_integers(kGroup + name, {size});
  }

  void check_counts() {
    const auto version = file_.doubles_attribute("/VTKHDF", "Version", 2);
    compare_.require(version[0] == 1 && version[1] == 0, "Version: {}.{} instead of 1.0", version[0],
                     version[1]);
    compare_.equal_count(long_integers("NumberOfPoints", 1)[0], points_, "NumberOfPoints");
    compare_.equal_count(long_integers("NumberOfCells", 1)[0], packing_.contact_count(), "NumberOfCells");
    compare_.equal_count(long_integers("NumberOfConnectivityIds", 1)[0], 2 * packing_.contact_count(),
                         "NumberOfConnectivityIds");
  }

  /// Each cell is a line from the centre of a to that of b, or to the next foot or image.
  void check_cells() {
    const auto ends = long_integers("Connectivity", 2 * cells());
    const auto offsets = long_integers("Offsets", cells() + 1);
    const auto types = file_.read_bytes(kGroup + "Types", {cells()});
    std::int64_t foot = packing_.disk_count();
    compare_.equal_count(offsets[0], 0, "the first of Offsets");
    for (std::size_t i = 0; i < cells(); ++i) {
      const Contact& contact = packing_.contacts[i];
      const std::int64_t end =
          contact.b.is_wall() || contact.has_image() ? foot++ : contact.b.disk_id().value();
      constexpr int kLine = 3;
      compare_.require(types[i] == kLine && ends[2 * i] == contact.a.value() && ends[2 * i + 1] == end &&
                           offsets[i + 1] == 2 * static_cast<std::int64_t>(i + 1),
                       "cell {}: it is no line between the bodies of its contact", i);
    }
  }

  void check_points() {
    const auto count = static_cast<std::size_t>(points_);
    const auto points = file_.read_doubles(kGroup + "Points", {count, 3});
    const auto radius = file_.read_doubles(kGroup + "PointData/radius", {count});
    const auto body = file_.read_integers(kGroup + "PointData/body", {count});
    const bool has_fixed = file_.has(kGroup + "PointData/fixed");
    const auto fixed = has_fixed ? file_.read_bytes(kGroup + "PointData/fixed", {count})
                                 : std::vector<std::uint8_t>(count, 0);
    const auto check = [&](std::size_t i, const Vector2& position, double right_radius,
                           std::int32_t right_body) {
      const double distance =
          std::hypot(points[3 * i] - position.x(), points[3 * i + 1] - position.y(), points[3 * i + 2]);
      const double scale = std::max(packing_.max_radius(), position.lpNorm<Eigen::Infinity>());
      compare_.require(distance <= tolerance::kAgreement * scale && radius[i] == right_radius &&
                           body[i] == right_body &&
                           (fixed[i] == 1) == (right_body >= 0 && packing_[DiskId(right_body)].fixed),
                       "point {}: it is not where disk or wall {} has it, or differs from it", i, right_body);
    };
    std::size_t i = 0;
    for (; i < packing_.disks.size(); ++i) {
      check(i, packing_.disks[i].position, packing_.disks[i].radius, static_cast<std::int32_t>(i));
    }
    for (const Contact& contact : packing_.contacts) {
      if (contact.has_image()) {
        Vector2 image = packing_[contact.b.disk_id()].position;
        if (packing_.cell.a) image += contact.image[0] * *packing_.cell.a;
        if (packing_.cell.b) image += contact.image[1] * *packing_.cell.b;
        check(i++, image, 0, contact.b.code());
      }
      if (!contact.b.is_wall()) continue;
      const Wall& wall = packing_[contact.b.wall_id()];
      const Vector2 from_wall = packing_[contact.a].position - wall.point;
      const Vector2 along(wall.normal.y(), -wall.normal.x());
      check(i++, wall.point + from_wall.dot(along) * along, 0, contact.b.code());
    }
  }

  void check_links() {
    for (const std::string& path : file_.datasets("/VTKHDF/CellData")) {
      const std::string name = path.substr(path.rfind('/') + 1);
      if (name == "outcome" || name == "d_min_outcome") continue;  // a copy: see check_outcomes
      const std::string source = file_.has("/contacts/" + name) ? "/contacts/" + name : "/ranges/" + name;
      compare_.require(file_.has(source) && file_.is_same(path, source), "CellData/{}: it is not {}", name,
                       source);
    }
  }

  void check_outcomes() {
    check_outcomes("outcome", ranges_.outcome);
    if (ranges_.smallest.outcome.size() > 0) check_outcomes("d_min_outcome", ranges_.smallest.outcome);
  }

  template <class Table>
  void check_outcomes(const std::string& name, const Table& outcomes) {
    const auto stored =
        file_.read_bytes(kGroup + "CellData/" + name, {cells(), static_cast<std::size_t>(outcomes.cols())});
    for (Eigen::Index i = 0; i < outcomes.size(); ++i) {
      const auto right = static_cast<int>(outcomes.data()[i]);
      compare_.require(stored[static_cast<std::size_t>(i)] == right, "CellData/{}: {} is stored, {} is right",
                       name, stored[static_cast<std::size_t>(i)], right);
    }
  }

  const Hdf5File& file_;
  const Packing& packing_;
  const ForceRanges& ranges_;
  Comparisons compare_;
  std::int64_t points_ = 0;
};

}  // namespace

Verification verify_vtkhdf(const Hdf5File& file, const Packing& packing, const ForceRanges& ranges) {
  return VtkVerifier(file, packing, ranges).run();
}

}  // namespace indet
