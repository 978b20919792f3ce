#include "libindet/io/scene_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <cmath>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/io/csv_table.h"

namespace indet {
namespace {

constexpr std::string_view kNoStress = "stress = \"none\"";

class SceneReader {
 public:
  explicit SceneReader(std::string source) { scene_.source = std::move(source); }

  SceneFile read(const toml::table& table) {
    for (const auto& [key_view, node] : table) read_key(std::string(key_view.str()), node);
    if (!has_gravity_ && scene_.cell.is_full()) scene_.gravity = {0, 0};
    return std::move(scene_);
  }

 private:
  [[noreturn]] void fail(const toml::node& node, const std::string& reason) const {
    throw InputError(fmt::format("{}:{}: {}", scene_.source, node.source().begin.line, reason));
  }

  double number(const std::string& key, const toml::node& node) const {
    const auto value = node.value<double>();
    if (!value) fail(node, fmt::format("{} must be a number", key));
    if (!std::isfinite(*value)) fail(node, fmt::format("{} must be finite", key));
    return *value;
  }

  Vector2 vector(const std::string& key, const toml::node& node, const char* example) const {
    const toml::array* array = node.as_array();
    if (array == nullptr || array->size() != 2)
      fail(node, fmt::format("{} must be a list of two numbers, e.g. {}", key, example));
    return {number(key, *array->get(0)), number(key, *array->get(1))};
  }

  const toml::table& table_of(const std::string& key, const toml::node& node, const char* entries) const {
    if (const toml::table* table = node.as_table()) return *table;
    fail(node, fmt::format("{} must be a table with {}", key, entries));
  }

  void read_key(const std::string& key, const toml::node& node) {
    if (key == "gravity") {
      scene_.gravity = vector(key, node, "[0, -1]");
      has_gravity_ = true;
    } else if (key == "force_unit") {
      scene_.force_unit = number(key, node);
      if (!(scene_.force_unit > 0))
        fail(node, fmt::format("force_unit must be positive, but is {}", scene_.force_unit));
    } else if (key == "mu") {
      scene_.mu = number(key, node);
      if (*scene_.mu < 0) fail(node, fmt::format("mu must not be negative, but is {}", *scene_.mu));
    } else if (key == "cell") {
      read_cell(node);
    } else if (key == "stress") {
      read_stress(node);
    } else {
      fail(node, fmt::format("{} is unknown; the known keys are gravity, force_unit, mu, cell, stress",
                             excerpt(key)));
    }
  }

  void read_cell(const toml::node& node) {
    scene_.cell_line = static_cast<int>(node.source().begin.line);
    for (const auto& [key, entry] : table_of("cell", node, "a and b, the vectors of a periodic scene")) {
      if (key.str() != "a" && key.str() != "b")
        fail(entry, fmt::format("{} of the cell is unknown; it has the vectors a and b", excerpt(key.str())));
      (key.str() == "a" ? scene_.cell.a : scene_.cell.b) = vector(std::string(key.str()), entry, "[10, 0]");
    }
    if (!scene_.cell.is_periodic()) fail(node, "the cell needs a vector a or b");
  }

  void read_stress(const toml::node& node) {
    scene_.stress_line = static_cast<int>(node.source().begin.line);
    scene_.names_stress = true;
    if (node.value<std::string>() == "none") return;
    Stress& stress = scene_.stress;
    for (const auto& [key, entry] : table_of("stress", node, "xx, yy, xy or pressure, or be \"none\"")) {
      double* const component = stress.find(key.str());
      if (component == nullptr) {
        fail(entry,
             fmt::format("{} of the stress is unknown; it has xx, yy, xy, or pressure{}", excerpt(key.str()),
                         key.str() == "yx" ? " (yx follows from the torques)" : ""));
      }
      *component = number(std::string(key.str()), entry);
    }
    if (!stress.is_imposed()) fail(node, "the stress needs a component: xx, yy, xy or pressure");
  }

  SceneFile scene_;
  bool has_gravity_ = false;
};

std::string vector_line(const char* name, const Vector2& vector) {
  return fmt::format("{} = [{}, {}]\n", name, vector.x(), vector.y());
}

}  // namespace

SceneFile read_scene_file(const std::filesystem::path& path) {
  const std::string source = path.string();
  if (!std::filesystem::exists(path)) {
    SceneFile scene;
    scene.source = source;
    return scene;
  }
  const auto text = read_text(path);
  toml::table table;
  try {
    table = toml::parse(*text, source);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: {}", source, error.source().begin.line, error.description()));
  }
  return SceneReader(source).read(table);
}

std::string scene_file_text(const Packing& packing) {
  std::string text = vector_line("gravity", packing.gravity);
  if (packing.named_force_unit > 0) text += fmt::format("force_unit = {}\n", packing.named_force_unit);
  const Cell& cell = packing.cell;
  const bool has_stress = packing.stress.is_imposed();
  if (cell.is_full() && !has_stress) text += fmt::format("{}\n", kNoStress);
  if (cell.is_periodic()) text += "[cell]\n";
  if (cell.a) text += vector_line("a", *cell.a);
  if (cell.b) text += vector_line("b", *cell.b);
  if (!has_stress) return text;
  text += "[stress]\n";
  const auto components = packing.stress.components();
  for (std::size_t k = 0; k < components.size(); ++k) {
    if (!std::isnan(components[k])) text += fmt::format("{} = {}\n", Stress::kNames[k], components[k]);
  }
  return text;
}

bool is_scene_file(std::string_view text) {
  // Lines as they are written, each at most once and in this order; whoever adds to them has a scene of their
  // own.
  constexpr std::array<std::string_view, 11> kLines = {
      "gravity = [", "force_unit = ", kNoStress, "[cell]\n", "a = [",      "b = [",
      "[stress]\n",  "xx = ",         "yy = ",   "xy = ",    "pressure = "};
  if (!text.starts_with(kLines.front())) return false;
  std::size_t next = 0;
  while (!text.empty()) {
    while (next < kLines.size() && !text.starts_with(kLines[next])) ++next;
    const std::size_t end = text.find('\n');
    if (next == kLines.size() || end == std::string_view::npos) return false;
    text.remove_prefix(end + 1);
    ++next;
  }
  return true;
}

}  // namespace indet
