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
#include "libindet/io/in_plane.h"
#include "libindet/io/mercury_data_reader.h"
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
        has_gravity_(settings.gravity.has_value()),
        builder_("import mercurydpm", "particle", source_, settings) {}

  ImportedPacking read() {
    if (!advance()) throw InputError(fmt::format("{}: the file is empty", source_));
    if (line_->kind() != "MercuryDPM" && line_->kind() != "restart_version") {
      line_->place().fail("this is not a restart file of MercuryDPM: it does not begin with MercuryDPM");
    }
    while (line_->kind() != "Species" && line_->kind() != "Walls") {
      if (line_->has("gravity")) read_gravity();
      if (line_->has("particleDimensions")) read_dimensions();
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
    return builder_.build(gravity_);
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
    if (count < 0) line_->place().fail(fmt::format("{} must not be negative, but is {}", name, count));
    for (int i = 0; i < count; ++i) {
      next();
      take();
    }
    advance();
  }

  void read_gravity() {
    if (has_gravity_) return;  // that of the settings is taken
    gravity_ =
        in_plane(line_->vector("gravity"), plane_, line_->place(), "gravity (which --gravity replaces)");
  }

  void read_dimensions() {
    dimensions_ = line_->integer("particleDimensions");
    if (dimensions_ != 2 && dimensions_ != 3) line_->place().fail("particleDimensions must be 2 or 3");
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

  void read_particle() {
    const Keywords& line = *line_;
    const Eigen::Vector3d position = line.vector("position");
    Disk disk;
    disk.id = line.integer("id");
    disk.position = plane_.components(position);
    disk.radius = line.number("radius");
    const double inverse = line.number("invMass");
    disk.fixed = inverse == 0;
    disk.mass = disk.fixed ? 0 : 1 / inverse;
    disk.inertia = (dimensions_ == 2 ? 0.5 : 0.4) * disk.mass * disk.radius * disk.radius;
    disk.velocity = plane_.components(line.vector("velocity"));
    disk.angular_velocity = plane_.turned(line.vector("angularVelocity")[plane_.normal]);
    if (!height_) height_ = position[plane_.normal];
    require_same_plane(position[plane_.normal] - *height_, disk.radius, plane_, line.place(),
                       fmt::format("particle {}", disk.id));
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
                    .point = plane_.components(line.vector("position")),
                    .normal = -plane_.components(outwards).stableNormalized(),
                    .name = std::to_string(id)};
    return wall_ids_.emplace(id, builder_.add_wall(wall, {}, line.place())).first->second;
  }

  void read_interaction() {
    const Keywords& line = *line_;
    const bool at_wall = line.has("particleWallIds");
    const char* const ids = at_wall ? "particleWallIds" : "particleIds";
    const Vector2 force = in_plane(line.vector("force"), plane_, line.place(), "the force");
    const DiskId a = builder_.disk(line.integer(ids, 0), line.place());
    const int other = line.integer(ids, 1);
    const Body b = at_wall ? Body::wall(wall(other)) : Body::disk(builder_.disk(other, line.place()));
    Contact contact = builder_.contact(a, b, line.place());
    contact.mu = friction(builder_.type(a),
                          at_wall ? walls_.at(other).integer("indSpecies") : builder_.type(b.disk_id()));
    PackingBuilder::project(contact, force);
    builder_.add_contact(contact, line.place());
  }

  std::string source_;
  std::shared_ptr<const std::string> text_;
  LineReader lines_;
  Plane plane_;
  bool has_gravity_;
  PackingBuilder builder_;
  std::optional<Keywords> line_;
  std::optional<Vector2> gravity_;
  int dimensions_ = 3;
  std::optional<double> height_;  ///< Of all centres, along the normal of the plane.
  std::map<std::pair<int, int>, double> friction_;
  std::map<int, Keywords> walls_;
  std::map<int, WallId> wall_ids_;
};

/// A restart file has what these options say.
void require_restart_options(const ImportRequest& request) {
  for (const auto& [option, given] :
       {std::pair("--density", !request.settings.density.empty()),
        std::pair("--time", request.time.has_value()), std::pair("--walls", !request.walls.empty())}) {
    if (!given) continue;
    throw InputError(fmt::format("{}: {} is for .data and .fstat files; a restart file has it itself",
                                 request.input.string(), option));
  }
}

}  // namespace

ImportedPacking read_mercury(const std::filesystem::path& file, const ImportSettings& settings) {
  return MercuryReader(file, settings).read();
}

ImportFormat mercury_format() {
  return {.name = "mercurydpm",
          .input = "the .restart file, or one of .data and .fstat",
          .options = {"--friction", "--gravity", "--fixed", "--force-unit", "--plane", "--density", "--time",
                      "--walls"},
          .documented = {Lever::kMidOverlap, Lever::kMidOverlap},
          .lacks_friction = "",
          .files = [](const ImportRequest& request) -> std::vector<std::filesystem::path> {
            if (const auto files = MercuryFiles::of(request.input)) return {files->data, files->fstat};
            return {request.input};
          },
          .read =
              [](const ImportRequest& request) {
                if (const auto files = MercuryFiles::of(request.input)) {
                  return read_mercury_data(*files, request.time,
                                           parse_walls(request.walls, request.settings.plane),
                                           request.settings);
                }
                require_restart_options(request);
                return read_mercury(request.input, request.settings);
              }};
}

}  // namespace indet
