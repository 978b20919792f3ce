#include "libindet/io/mercury_reader.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/io/import_format.h"
#include "libindet/io/packing_builder.h"
#include "libindet/io/table.h"

namespace indet {
namespace {

/// A line of keywords and numbers.
class Keywords {
 public:
  Keywords(Place place, std::string_view line) : place_(std::move(place)), words_(split_words(line)) {}

  bool empty() const { return words_.empty(); }
  std::string_view kind() const { return words_.empty() ? std::string_view() : words_.front(); }
  const Place& place() const { return place_; }
  bool has(std::string_view keyword) const { return find(keyword) < words_.size(); }

  double number(std::string_view keyword, std::size_t i = 0) const {
    const std::size_t at = find(keyword);
    double value = 0;
    if (at == words_.size()) place_.fail(fmt::format("{} is missing", keyword));
    if (at + 1 + i >= words_.size() || !parse_number(words_[at + 1 + i], &value)) {
      place_.fail(fmt::format("{} must be followed by {}", keyword, i == 0 ? "a number" : "more numbers"));
    }
    return value;
  }

  int integer(std::string_view keyword, std::size_t i = 0) const {
    const double value = number(keyword, i);
    if (value != std::floor(value) || std::abs(value) > 2e9) {
      place_.fail(fmt::format("{}: {} is not a whole number", keyword, value));
    }
    return static_cast<int>(value);
  }

  Eigen::Vector3d vector(std::string_view keyword) const {
    return {number(keyword, 0), number(keyword, 1), number(keyword, 2)};
  }

 private:
  std::size_t find(std::string_view keyword) const {
    return static_cast<std::size_t>(std::find(words_.begin(), words_.end(), keyword) - words_.begin());
  }

  Place place_;
  std::vector<std::string_view> words_;
};

/// x turned by the quaternion (w, x, y, z) that follows a keyword.
Eigen::Vector3d turned_x(const Keywords& line, std::string_view keyword) {
  std::array<double, 4> q{};
  for (std::size_t i = 0; i < 4; ++i) q[i] = line.number(keyword, i);
  return {q[0] * q[0] + q[1] * q[1] - q[2] * q[2] - q[3] * q[3], 2 * (q[1] * q[2] + q[0] * q[3]),
          2 * (q[1] * q[3] - q[0] * q[2])};
}

class MercuryReader {
 public:
  MercuryReader(const std::filesystem::path& file, const ImportSettings& settings)
      : source_(file.string()),
        text_(read_text(file)),
        lines_(*text_),
        plane_(settings.plane),
        builder_("import mercurydpm", "particle", source_, settings) {}

  ImportedPacking read() {
    next();
    if (line_->kind() != "MercuryDPM" && line_->kind() != "restart_version") {
      line_->place().fail("this is not a restart file of MercuryDPM: it does not begin with MercuryDPM");
    }
    while (line_->kind() != "Species" && line_->kind() != "Walls") {
      if (line_->has("gravity")) gravity_ = line_->vector("gravity");
      if (line_->has("particleDimensions")) dimensions_ = line_->integer("particleDimensions");
      next();
    }
    for (; line_->kind() != "Walls"; next()) read_species();
    section("Walls", [this] { walls_.emplace(line_->integer("id"), *line_); });
    for (; line_->kind() != "Boundaries"; next()) {
    }
    for (next(); line_->kind() != "Particles"; next()) {
      if (line_->kind().find("Periodic") != std::string_view::npos) {
        line_->place().fail("the packing is periodic, which is not supported");
      }
    }
    section("Particles", [this] { read_particle(); });
    builder_.close_disks();
    for (; line_->kind() != "Interactions"; next()) {
    }
    section("Interactions", [this] { read_interaction(); });
    return builder_.build(gravity_ ? std::optional(in_plane(*gravity_)) : std::nullopt);
  }

 private:
  /// The next line that is not blank. Fails at the end of the file.
  void next() {
    if (!advance()) throw InputError(fmt::format("{}: the file ends too early; it is truncated", source_));
  }

  bool advance() {
    std::string_view text;
    while (lines_.next(&text)) {
      line_.emplace(Place{source_, lines_.line_number()}, text);
      if (!line_->empty()) return true;
    }
    return false;
  }

  /// "Walls 4" and the lines that it announces.
  template <class Take>
  void section(std::string_view name, const Take& take) {
    const int count = line_->integer(name);
    for (int i = 0; i < count; ++i) {
      next();
      take();
    }
    advance();
  }

  void read_species() {
    if (line_->kind() == "Species") return;
    const double friction =
        line_->has("slidingFrictionCoefficient") ? line_->number("slidingFrictionCoefficient") : 0;
    const bool mixed = line_->has("idA");
    const int a = line_->integer(mixed ? "idA" : "id");
    const int b = mixed ? line_->integer("idB") : a;
    friction_[std::minmax(a, b)] = friction;
  }

  /// Friction of two species; NaN if the file has none for them.
  double friction(int a, int b) const {
    const auto found = friction_.find(std::minmax(a, b));
    return found == friction_.end() ? kNaN : found->second;
  }

  Vector2 in_plane(const Eigen::Vector3d& vector) const {
    return {vector[plane_.first], vector[plane_.second]};
  }

  void read_particle() {
    const Keywords& line = *line_;
    const Eigen::Vector3d position = line.vector("position");
    Disk disk;
    disk.id = line.integer("id");
    disk.position = in_plane(position);
    disk.radius = line.number("radius");
    const double inverse = line.number("invMass");
    disk.fixed = inverse == 0;
    disk.mass = disk.fixed ? 0 : 1 / inverse;
    disk.inertia = (dimensions_ == 2 ? 0.5 : 0.4) * disk.mass * disk.radius * disk.radius;
    disk.velocity = in_plane(line.vector("velocity"));
    disk.angular_velocity = plane_.turned(line.vector("angularVelocity")[plane_.normal]);
    if (!height_) height_ = position[plane_.normal];
    if (std::abs(position[plane_.normal] - *height_) > tolerance::kSameWall * disk.radius) {
      line.place().fail(
          fmt::format("particle {} lies {:.3g} off the plane {} of the first one; only packings in a "
                      "plane can be read (--plane xy or xz)",
                      disk.id, position[plane_.normal] - *height_, plane_.name()));
    }
    builder_.add_disk(disk, line.integer("indSpecies"), line.place());
  }

  /// The wall with this id, added when the first particle touches it.
  WallId wall(int id) {
    if (const auto found = wall_ids_.find(id); found != wall_ids_.end()) return found->second;
    const auto found = walls_.find(id);
    if (found == walls_.end()) line_->place().fail(fmt::format("there is no wall {}", id));
    const Keywords& line = found->second;
    if (line.kind() != "InfiniteWall") {
      line.place().fail(fmt::format("wall {} is a {}; only InfiniteWall can be read", id, line.kind()));
    }
    const Eigen::Vector3d outwards =
        line.has("normal") ? line.vector("normal") : turned_x(line, "orientation");
    if (std::abs(outwards[plane_.normal]) > tolerance::kOutOfPlane * outwards.norm()) {
      line.place().fail(fmt::format("wall {} is not perpendicular to the plane {}", id, plane_.name()));
    }
    const Wall wall{.id = builder_.packing().wall_count(),
                    .point = in_plane(line.vector("position")),
                    .normal = -in_plane(outwards).stableNormalized(),
                    .name = std::to_string(id)};
    return wall_ids_.emplace(id, builder_.add_wall(wall, {}, line.place())).first->second;
  }

  void read_interaction() {
    const Keywords& line = *line_;
    const bool at_wall = line.has("particleWallIds");
    const char* const ids = at_wall ? "particleWallIds" : "particleIds";
    const Eigen::Vector3d force = line.vector("force");
    if (std::abs(force[plane_.normal]) > tolerance::kOutOfPlane * force.norm()) {
      line.place().fail(
          fmt::format("the force points out of the plane {}; only packings in a plane can be read "
                      "(--plane xy or xz)",
                      plane_.name()));
    }
    const DiskId a = builder_.disk(line.integer(ids, 0), line.place());
    const int other = line.integer(ids, 1);
    const Body b = at_wall ? Body::wall(wall(other)) : Body::disk(builder_.disk(other, line.place()));
    Contact contact = builder_.contact(a, b, line.place());
    contact.mu = friction(builder_.type(a),
                          at_wall ? walls_.at(other).integer("indSpecies") : builder_.type(b.disk_id()));
    PackingBuilder::project(contact, in_plane(force));
    builder_.add_contact(contact, line.place());
  }

  std::string source_;
  std::shared_ptr<const std::string> text_;
  LineReader lines_;
  Plane plane_;
  PackingBuilder builder_;
  std::optional<Keywords> line_;
  std::optional<Eigen::Vector3d> gravity_;
  int dimensions_ = 3;
  std::optional<double> height_;  ///< Of all centres, along the normal of the plane.
  std::map<std::pair<int, int>, double> friction_;
  std::map<int, Keywords> walls_;
  std::map<int, WallId> wall_ids_;
};

}  // namespace

ImportedPacking read_mercury(const std::filesystem::path& file, const ImportSettings& settings) {
  return MercuryReader(file, settings).read();
}

ImportFormat mercury_format() {
  return {.name = "mercurydpm",
          .input = "the .restart file",
          .options = {"--friction", "--gravity", "--fixed", "--force-unit", "--plane"},
          .documented = {Lever::kMidOverlap, Lever::kMidOverlap},
          .lacks_friction = "",
          .files = [](const ImportRequest& request) -> std::vector<std::filesystem::path> {
            return {request.input};
          },
          .read = [](const ImportRequest& request) { return read_mercury(request.input, request.settings); }};
}

}  // namespace indet
