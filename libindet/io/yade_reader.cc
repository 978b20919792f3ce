#include "libindet/io/yade_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/io/import_format.h"
#include "libindet/io/in_plane.h"
#include "libindet/io/yade_scene.h"

namespace indet {
namespace {

namespace fs = std::filesystem;

class Reader {
 public:
  Reader(const YadeScene& scene, const std::string& source, const ImportSettings& settings)
      : scene_(scene),
        source_(source),
        plane_(settings.plane),
        builder_("import yade", "body", source, settings) {}

  ImportedPacking read() {
    read_bodies();
    read_cell();
    for (const YadeInteraction& interaction : scene_.interactions) read_contact(interaction);
    return builder_.build(scene_.gravity ? std::optional(plane_.components(*scene_.gravity)) : std::nullopt);
  }

 private:
  /// YADE is periodic in all three directions or in none.
  void read_cell() {
    if (!scene_.cell) return;
    Cell cell;
    for (const int axis : {plane_.first, plane_.second}) {
      const Eigen::Vector3d vector = scene_.cell->col(axis);
      (axis == plane_.first ? cell.a : cell.b) =
          in_plane(vector, plane_, {source_, 0}, "a vector of the cell");
    }
    builder_.set_cell(cell);
  }

  /// Whether a sphere is fixed. Fails if it is held in some directions only.
  bool is_fixed(const YadeBody& body) const {
    const int in_plane = (1 << plane_.first) | (1 << plane_.second) | (8 << plane_.normal);
    const int blocked = body.blocked & in_plane;
    if (blocked != 0 && blocked != in_plane) {
      body.place.fail(
          fmt::format("body {} may not move in some directions of the plane {} (blockedDOFs); a disk is "
                      "free or fixed",
                      body.id, plane_.name()));
    }
    return blocked != 0;
  }

  void read_bodies() {
    const YadeBody* first = nullptr;
    for (const YadeBody& body : scene_.bodies) {
      if (!bodies_.emplace(body.id, &body).second)
        body.place.fail(fmt::format("body {} is given twice", body.id));
      if (body.shape == "Wall" || body.shape == "Box") continue;
      if (body.shape != "Sphere") {
        body.place.fail(
            fmt::format("body {} is a {}; only spheres, walls and boxes can be read", body.id, body.shape));
      }
      Disk disk;
      disk.id = body.id;
      disk.position = plane_.components(body.position);
      disk.radius = body.radius;
      disk.mass = body.mass;
      disk.inertia = body.inertia;
      disk.velocity = plane_.components(body.velocity);
      disk.angular_velocity = plane_.turned(body.angular_velocity[plane_.normal]);
      disk.fixed = is_fixed(body);
      if (first == nullptr) first = &body;
      const double height = body.position[plane_.normal] - first->position[plane_.normal];
      require_same_plane(height, body.radius, plane_, body.place, fmt::format("body {}", body.id));
      builder_.add_disk(disk, body.material, body.place);
    }
    builder_.close_disks();
  }

  /// The wall that a body is on the side to which `normal` points.
  WallId wall(const YadeBody& body, const Vector2& normal, const Place& place) {
    const int side =
        std::abs(normal.x()) > std::abs(normal.y()) ? (normal.x() > 0 ? 0 : 1) : (normal.y() > 0 ? 2 : 3);
    const auto [found, is_new] = walls_.emplace(std::pair(body.id, side), WallId());
    if (!is_new) return found->second;
    const int axis = side < 2 ? plane_.first : plane_.second;
    const double sign = side % 2 == 0 ? 1 : -1;
    if (body.shape == "Wall" ? body.axis != axis || (body.sense != 0 && body.sense != sign) : body.turned) {
      place.fail(fmt::format("body {} is a {} that does not push this way", body.id, body.shape));
    }
    Wall wall;
    wall.id = builder_.packing().wall_count();
    wall.point = plane_.components(body.position);
    wall.normal = {side < 2 ? sign : 0, side < 2 ? 0 : sign};
    if (body.shape == "Box") wall.point += body.extents[axis] * wall.normal;
    const std::string id = std::to_string(body.id);
    static constexpr const char* kSides[] = {"right of ", "left of ", "above ", "below "};
    wall.name = body.shape == "Wall" && body.sense != 0 ? id : kSides[side] + id;
    found->second = builder_.add_wall(std::move(wall), {id}, body.place);
    return found->second;
  }

  const YadeBody& body(std::int32_t id, const Place& place) const {
    const auto found = bodies_.find(id);
    if (found == bodies_.end()) place.fail(fmt::format("there is no body {}", id));
    return *found->second;
  }

  void read_contact(const YadeInteraction& interaction) {
    const Place& place = interaction.place;
    const Vector2 direction = in_plane(interaction.normal, plane_, place, "the normal");
    const Vector2 force =
        in_plane(interaction.normal_force + interaction.shear_force, plane_, place, "the force");
    const YadeBody& first = body(interaction.first, place);
    const YadeBody& second = body(interaction.second, place);
    // The normal points from the first body to the second, so the second is a, unless it is a wall.
    const bool swapped = second.shape != "Sphere";
    const YadeBody& a = swapped ? first : second;
    const YadeBody& b = swapped ? second : first;
    if (a.shape != "Sphere") place.fail(fmt::format("bodies {} and {} are both walls", first.id, second.id));
    const double sign = swapped ? -1 : 1;
    const Vector2 normal = sign * direction;
    const DiskId disk = builder_.disk(a.id, place);
    Contact contact = builder_.contact(
        disk,
        b.shape == "Sphere" ? Body::disk(builder_.disk(b.id, place)) : Body::wall(wall(b, normal, place)),
        place);
    contact.normal = normal;
    if (!std::isnan(interaction.overlap)) contact.gap = -interaction.overlap;
    contact.mu = interaction.friction;
    PackingBuilder::project(contact, sign * force);
    builder_.add_contact(contact, place);
  }

  const YadeScene& scene_;
  std::string source_;
  Plane plane_;
  PackingBuilder builder_;
  std::unordered_map<std::int32_t, const YadeBody*> bodies_;
  std::map<std::pair<std::int32_t, int>, WallId> walls_;  ///< By body and side.
};

}  // namespace

ImportedPacking read_yade(const fs::path& input, const ImportSettings& settings) {
  std::error_code ignored;
  const bool folder = fs::is_directory(input, ignored);
  const YadeScene scene = folder ? read_yade_folder(input) : read_yade_archive(input);
  return Reader(scene, folder ? (input / "bodies.txt").string() : input.string(), settings).read();
}

ImportFormat yade_format() {
  return {.name = "yade",
          .input = "the folder that yade_export.py wrote, or the file of O.save (.xml, .xml.gz)",
          .options = {"--friction", "--gravity", "--fixed", "--force-unit", "--plane"},
          .documented = {Lever::kMidOverlap, Lever::kMidOverlap},
          .lacks_friction = "",
          .files = [](const ImportRequest& request) -> std::vector<fs::path> {
            return {request.input, request.input / "bodies.txt", request.input / "interactions.txt"};
          },
          .read = [](const ImportRequest& request) { return read_yade(request.input, request.settings); }};
}

}  // namespace indet
