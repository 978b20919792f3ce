#include "apps/load_arguments.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "apps/command.h"
#include "libindet/base/error.h"
#include "libindet/io/table.h"

namespace indet::app {
namespace {

constexpr const char* kSyntax =
    "expected disk=ID,fx,fy[,torque], wall=NAME,normal,tangential, gravity=gx,gy or stress=xx,yy,xy, joined "
    "by + "
    "where several act, or the name of a TOML file";

[[noreturn]] void refuse(const std::string& text, const std::string& reason) {
  throw UsageError(fmt::format("--load {}: {}", text, reason));
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
  if (text.empty() || text.back() == at) parts.emplace_back();
  return parts;
}

/// Adds loads to bodies that are found by the names of the scene.
class LoadBuilder {
 public:
  LoadBuilder(const Packing& packing, std::string source) : packing_(packing), source_(std::move(source)) {
    loads_.disks.assign(packing.disks.size(), Vector3::Zero());
    loads_.walls.assign(packing.walls.size(), Vector2::Zero());
  }

  void add_to_disk(std::int64_t id, const Vector3& load) {
    for (std::size_t i = 0; i < packing_.disks.size(); ++i) {
      if (packing_.disks[i].id != id) continue;
      loads_.disks[i] += load;
      return;
    }
    throw InputError(fmt::format("{}: there is no disk {}", source_, id));
  }
  void add_to_wall(const std::string& name, const Vector2& load) {
    for (std::size_t w = 0; w < packing_.walls.size(); ++w) {
      if (wall_name(packing_.walls[w]) != name) continue;
      loads_.walls[w] += load;
      return;
    }
    std::string names;
    for (const Wall& wall : packing_.walls) names += (names.empty() ? "" : ", ") + wall_name(wall);
    throw InputError(fmt::format("{}: there is no wall \"{}\"; the walls are {}", source_, name,
                                 names.empty() ? "none" : names));
  }
  void add_gravity(const Vector2& gravity) { loads_.gravity += gravity; }
  void add_stress(std::size_t component, double stress) { loads_.stress[component] += stress; }

  Loads finish() const {
    if (loads_.is_zero()) throw InputError(fmt::format("{}: the load is 0", source_));
    if (const std::string defect = defect_of(loads_, packing_); !defect.empty())
      throw InputError(fmt::format("{}: {}", source_, defect));
    return loads_;
  }

 private:
  const Packing& packing_;
  std::string source_;
  Loads loads_;
};

/// The parts between those + that begin another one; numbers have some, too.
std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts(1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    bool begins = false;
    for (const char* kind : {"+disk=", "+wall=", "+gravity=", "+stress="})
      begins = begins || text.compare(i, std::strlen(kind), kind) == 0;
    if (begins)
      parts.emplace_back();
    else
      parts.back() += text[i];
  }
  return parts;
}

double number(const std::string& text, const std::string& word) {
  double value = 0;
  if (!parse_number(word, &value) || !std::isfinite(value))
    refuse(text, fmt::format("\"{}\" is not a finite number; {}", word, kSyntax));
  return value;
}

void add_part(const std::string& text, const std::string& part, LoadBuilder& loads) {
  const std::size_t equals = part.find('=');
  if (equals == std::string::npos) refuse(text, kSyntax);
  const std::string kind = part.substr(0, equals);
  const std::vector<std::string> words = split(part.substr(equals + 1), ',');
  const auto numbers_from = [&](std::size_t first, std::initializer_list<std::size_t> counts) {
    bool fits = false;
    for (const std::size_t count : counts) fits = fits || words.size() == first + count;
    if (!fits) refuse(text, kSyntax);
    std::vector<double> numbers;
    for (std::size_t k = first; k < words.size(); ++k) numbers.push_back(number(text, words[k]));
    return numbers;
  };
  if (kind == "disk") {
    const auto f = numbers_from(1, {2, 3});
    std::int64_t id = 0;
    if (!parse_number(words[0], &id))
      refuse(text, fmt::format("\"{}\" is not the number of a disk", words[0]));
    loads.add_to_disk(id, {f[0], f[1], f.size() > 2 ? f[2] : 0});
  } else if (kind == "wall") {
    const auto f = numbers_from(1, {2});
    loads.add_to_wall(words[0], {f[0], f[1]});
  } else if (kind == "gravity") {
    const auto g = numbers_from(0, {2});
    loads.add_gravity({g[0], g[1]});
  } else if (kind == "stress") {
    const auto s = numbers_from(0, {3});
    for (std::size_t k = 0; k < 3; ++k) loads.add_stress(k, s[k]);
  } else {
    refuse(text, kSyntax);
  }
}

/// The load of a TOML file.
class LoadFile {
 public:
  LoadFile(std::string path, LoadBuilder& loads) : path_(std::move(path)), loads_(loads) {}

  void read() {
    toml::table table;
    try {
      table = toml::parse_file(path_);
    } catch (const toml::parse_error& error) {
      throw InputError(fmt::format("{}:{}: {}", path_, error.source().begin.line, error.description()));
    }
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      if (name == "gravity") {
        const auto g = numbers(name, node, 2);
        loads_.add_gravity({g[0], g[1]});
      } else if (name == "stress") {
        read_stress(table_of(name, node));
      } else if (name == "disk" || name == "wall") {
        const toml::array* bodies = node.as_array();
        if (bodies == nullptr) fail(node, fmt::format("{0} must be tables [[{0}]]", name));
        for (const toml::node& body : *bodies)
          name == "disk" ? read_disk(table_of(name, body)) : read_wall(table_of(name, body));
      } else {
        fail(node, fmt::format("unknown key \"{}\"; there are gravity, stress, [[disk]] and [[wall]]", name));
      }
    }
  }

 private:
  [[noreturn]] void fail(const toml::node& node, const std::string& reason) const {
    throw InputError(fmt::format("{}:{}: {}", path_, node.source().begin.line, reason));
  }
  const toml::table& table_of(const std::string& name, const toml::node& node) const {
    if (const toml::table* table = node.as_table()) return *table;
    fail(node, name + " must be a table");
  }
  double number(const std::string& name, const toml::node& node) const {
    const auto value = node.value<double>();
    if (!node.is_number() || !value || !std::isfinite(*value)) fail(node, name + " must be a finite number");
    return *value;
  }
  std::vector<double> numbers(const std::string& name, const toml::node& node, std::size_t count) const {
    const toml::array* array = node.as_array();
    if (array == nullptr || array->size() != count)
      fail(node, fmt::format("{} must be {} numbers", name, count));
    std::vector<double> values;
    for (const toml::node& entry : *array) values.push_back(number(name, entry));
    return values;
  }
  void read_stress(const toml::table& table) {
    for (const auto& [key, node] : table) {
      std::size_t k = 0;
      while (k < Stress::kNames.size() && key.str() != Stress::kNames[k]) ++k;
      if (k == Stress::kNames.size()) fail(node, fmt::format("there is no stress \"{}\"", key.str()));
      loads_.add_stress(k, number(std::string(key.str()), node));
    }
  }
  void read_disk(const toml::table& table) {
    std::optional<std::int64_t> id;
    Vector3 load(0, 0, 0);
    for (const auto& [key, node] : table) {
      if (key == "id") {
        id = node.value_exact<std::int64_t>();
      } else if (key == "force") {
        const auto force = numbers("force", node, 2);
        load.head<2>() = Vector2(force[0], force[1]);
      } else if (key == "torque") {
        load.z() = number("torque", node);
      } else {
        fail(node, fmt::format("unknown key \"{}\" of [[disk]]; there are id, force and torque", key.str()));
      }
    }
    if (!id) fail(table, "[[disk]] needs an id");
    loads_.add_to_disk(*id, load);
  }
  void read_wall(const toml::table& table) {
    std::optional<std::string> name;
    Vector2 load(0, 0);
    for (const auto& [key, node] : table) {
      if (key == "name") {
        name = node.value_exact<std::string>();
      } else if (key == "force") {
        const auto force = numbers("force", node, 2);
        load = {force[0], force[1]};
      } else {
        fail(node, fmt::format("unknown key \"{}\" of [[wall]]; there are name and force", key.str()));
      }
    }
    if (!name) fail(table, "[[wall]] needs a name");
    loads_.add_to_wall(*name, load);
  }

  std::string path_;
  LoadBuilder& loads_;
};

}  // namespace

Loads parse_load(const std::string& text, const Packing& packing) {
  if (text.ends_with(".toml")) {
    if (!std::filesystem::is_regular_file(text)) throw InputError(text + ": there is no such file");
    LoadBuilder loads(packing, text);
    LoadFile(text, loads).read();
    return loads.finish();
  }
  LoadBuilder loads(packing, "--load " + text);
  for (const std::string& part : parts_of(text)) add_part(text, part, loads);
  return loads.finish();
}

}  // namespace indet::app
