#include "libsim/scene_toml.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/base/tolerances.h"
#include "libindet/base/toml_text.h"

namespace indet::sim {
namespace {

/// One table of the file, with messages that name the place.
class Reader {
 public:
  explicit Reader(std::string source) : source_(std::move(source)) {}

  [[noreturn]] void fail(const toml::node& node, const std::string& key, const std::string& reason) const {
    throw InputError(fmt::format("{}:{}: {} {}", source_, node.source().begin.line, excerpt(key), reason));
  }
  double number(const toml::node& node, const std::string& key) const {
    const auto value = node.value<double>();
    if (!value) fail(node, key, "must be a number");
    if (!std::isfinite(*value)) fail(node, key, fmt::format("must be finite, but is {}", *value));
    return *value;
  }
  template <class Integer>
  Integer integer(const toml::node& node, const std::string& key, Integer least) const {
    const auto* value = node.as_integer();
    if (value == nullptr) fail(node, key, "must be an integer");
    const std::int64_t number = value->get();
    if (number < static_cast<std::int64_t>(least) || !std::in_range<Integer>(number)) {
      const auto most = std::min<std::uint64_t>(std::numeric_limits<Integer>::max(),
                                                std::numeric_limits<std::int64_t>::max());
      fail(node, key, fmt::format("must be from {} to {}, but is {}", least, most, number));
    }
    return static_cast<Integer>(number);
  }
  std::string text(const toml::node& node, const std::string& key) const {
    const auto* value = node.as_string();
    if (value == nullptr) fail(node, key, "must be a string");
    if (value->get().find('\0') != std::string::npos) fail(node, key, "must not hold a zero byte");
    return value->get();
  }
  Vector2 pair(const toml::node& node, const std::string& key) const {
    const toml::array* array = node.as_array();
    if (array == nullptr || array->size() != 2) fail(node, key, "must be two numbers");
    return {number(*array->get(0), key), number(*array->get(1), key)};
  }

 private:
  std::string source_;
};

/// A normal of another length may be a misprint, so it is not made one silently.
std::optional<std::string> defect_of_normal(const Vector2& normal) {
  const double length = normal.norm();
  if (std::abs(length - 1) <= tolerance::kNormalLength) return {};
  std::string reason = fmt::format("must have length 1, but has length {:.6g}", length);
  if (!std::isfinite(length) || length == 0) return reason;
  const Vector2 unit = normal / length;
  return reason + fmt::format("; in this direction that is [{:.12g}, {:.12g}]", unit.x(), unit.y());
}

Wall read_wall(const Reader& reader, const toml::node& node) {
  const toml::table* table = node.as_table();
  if (table == nullptr) reader.fail(node, "wall", "must be a table");
  Wall wall;
  bool has_point = false;
  bool has_normal = false;
  for (const auto& [key, value] : *table) {
    const std::string name(key.str());
    if (name == "name") {
      wall.name = reader.text(value, name);
    } else if (name == "point") {
      wall.point = reader.pair(value, name);
      has_point = true;
    } else if (name == "normal") {
      wall.normal = reader.pair(value, name);
      if (const auto reason = defect_of_normal(wall.normal)) reader.fail(value, name, *reason);
      wall.normal.normalize();
      has_normal = true;
    } else {
      reader.fail(value, name, "is not a key of a wall: they are name, point, normal");
    }
  }
  if (!has_point || !has_normal) reader.fail(node, "wall", "needs a point and a normal");
  return wall;
}

Friction read_friction(const Reader& reader, const toml::node& node, Friction friction) {
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, value] : *table) {
      if (key.str() == "disk") {
        friction.disk = reader.number(value, "friction.disk");
      } else if (key.str() == "wall") {
        friction.wall = reader.number(value, "friction.wall");
      } else {
        reader.fail(value, std::string(key.str()), "is not a key of friction: they are disk and wall");
      }
    }
    return friction;
  }
  const double mu = reader.number(node, "friction");
  return {mu, mu};
}

void read_key(const Reader& reader, const std::string& key, const toml::node& value, Scene& scene) {
  if (key == "disks") {
    scene.disks = reader.integer(value, key, 1);
  } else if (key == "radius") {
    const Vector2 radius = reader.pair(value, key);
    scene.radius_min = radius.x();
    scene.radius_max = radius.y();
  } else if (key == "density") {
    scene.density = reader.number(value, key);
  } else if (key == "friction") {
    scene.friction = read_friction(reader, value, scene.friction);
  } else if (key == "gravity") {
    scene.gravity = reader.pair(value, key);
  } else if (key == "force_unit") {
    scene.force_unit = reader.number(value, key);
  } else if (key == "container") {
    scene.container = container_from(reader.text(value, key));
  } else if (key == "width") {
    scene.width = reader.number(value, key);
  } else if (key == "height") {
    scene.height = reader.number(value, key);
  } else if (key == "funnel_angle") {
    scene.funnel_angle = reader.number(value, key);
  } else if (key == "columns") {
    scene.columns = reader.integer(value, key, 0);
  } else if (key == "jitter") {
    scene.jitter = reader.number(value, key);
  } else if (key == "seed") {
    scene.seed = reader.integer(value, key, std::uint64_t{0});
  } else if (key == "wall") {
    const toml::array* walls = value.as_array();
    if (walls == nullptr) reader.fail(value, key, "must be written as [[wall]]");
    scene.walls.clear();
    for (const toml::node& wall : *walls) scene.walls.push_back(read_wall(reader, wall));
  } else {
    reader.fail(value, key, "is not a key of a scene");
  }
}

}  // namespace

Scene read_scene(const std::filesystem::path& path, const Scene& defaults) {
  toml::table table;
  try {
    table = toml::parse_file(path.string());
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: {}", path.string(), error.source().begin.line, error.description()));
  }
  Scene scene = defaults;
  const Reader reader(path.string());
  for (const auto& [key, value] : table) read_key(reader, std::string(key.str()), value, scene);
  if (const auto reason = scene.defect()) throw InputError(fmt::format("{}: {}", path.string(), *reason));
  return scene;
}

std::string to_toml(const Scene& scene) {
  std::string text;
  const auto line = [&](const std::string& key, const std::string& value) {
    text += key + " = " + value + "\n";
  };
  // {} prints the shortest decimal number that reads back as the same double; TOML wants floats as such or
  // integers.
  line("disks", fmt::format("{}", scene.disks));
  line("radius", fmt::format("[{}, {}]", scene.radius_min, scene.radius_max));
  line("density", fmt::format("{}", scene.density));
  line("friction", fmt::format("{{ disk = {}, wall = {} }}", scene.friction.disk, scene.friction.wall));
  line("gravity", fmt::format("[{}, {}]", scene.gravity.x(), scene.gravity.y()));
  line("force_unit", fmt::format("{}", scene.force_unit));
  line("container", fmt::format("\"{}\"", to_string(scene.container)));
  line("width", fmt::format("{}", scene.width));
  line("height", fmt::format("{}", scene.height));
  line("funnel_angle", fmt::format("{}", scene.funnel_angle));
  line("columns", fmt::format("{}", scene.columns));
  line("jitter", fmt::format("{}", scene.jitter));
  line("seed", fmt::format("{}", scene.seed));
  for (const Wall& wall : scene.walls) {
    text += fmt::format("[[wall]]\nname = {}\npoint = [{}, {}]\nnormal = [{}, {}]\n", toml_text(wall.name),
                        wall.point.x(), wall.point.y(), wall.normal.x(), wall.normal.y());
  }
  return text;
}

}  // namespace indet::sim
