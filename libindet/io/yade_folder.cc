#include <fmt/format.h>

#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/io/table.h"
#include "libindet/io/yade_scene.h"

namespace indet {
namespace {

/// A line of named fields; those of walls and boxes behind their position have the form NAME=VALUE.
class Fields {
 public:
  Fields(Place place, const std::vector<std::string>& columns, const std::vector<std::string_view>& words)
      : place_(std::move(place)) {
    std::size_t column = 0;
    for (const std::string_view word : words) {
      const std::size_t equals = word.find('=');
      if (equals != std::string_view::npos) {
        values_[std::string(word.substr(0, equals))] = word.substr(equals + 1);
      } else if (column < columns.size()) {
        values_[columns[column++]] = word;
      } else {
        place_.fail(fmt::format("there are more fields than the {} columns", columns.size()));
      }
    }
    if (column < columns.size()) missing_ = columns[column];
  }

  /// Fails if a field is missing: all behind it would stand in the wrong columns.
  void require_all() const {
    if (missing_.empty()) return;
    place_.fail(fmt::format("there are fewer fields than columns: none is left for {}", missing_));
  }

  bool has(const std::string& name) const { return values_.contains(name); }

  std::string_view text(const std::string& name) const {
    const auto found = values_.find(name);
    if (found == values_.end()) place_.fail(fmt::format("{} is missing", name));
    return found->second;
  }

  double number(const std::string& name) const {
    double value = 0;
    if (!parse_number(text(name), &value)) {
      place_.fail(fmt::format("{}: \"{}\" is not a number", name, excerpt(text(name))));
    }
    return value;
  }
  double number_or(const std::string& name, double fallback) const {
    return has(name) ? number(name) : fallback;
  }

  int integer(const std::string& name) const {
    std::int64_t value = 0;
    if (!parse_number(text(name), &value) || value != static_cast<std::int32_t>(value)) {
      place_.fail(fmt::format("{}: \"{}\" is not a whole number of 32 bits", name, excerpt(text(name))));
    }
    return static_cast<int>(value);
  }

  Eigen::Vector3d vector(const std::string& x, const std::string& y, const std::string& z) const {
    return {number(x), number(y), number(z)};
  }

  const Place& place() const { return place_; }

 private:
  Place place_;
  std::map<std::string, std::string_view> values_;
  std::string missing_;  ///< The first column without a field; "" if there is none.
};

/// Lines of a file that are neither blank nor comments, and what the comments say.
class Lines {
 public:
  explicit Lines(const std::filesystem::path& path)
      : path_(path.string()), text_(read_text(path)), reader_(*text_) {}

  /// The next line as words; false at the end.
  bool next(std::vector<std::string_view>* words) {
    std::string_view line;
    while (reader_.next(&line)) {
      *words = split_words(line);
      if (words->empty()) continue;
      if (!words->front().starts_with('#')) return true;
      words->front().remove_prefix(1);
      if (words->front().empty()) words->erase(words->begin());
      comment(*words);
    }
    return false;
  }

  Place place() const { return {path_, reader_.line_number()}; }
  const std::vector<std::string>& columns() const { return columns_; }
  const std::optional<Eigen::Vector3d>& gravity() const { return gravity_; }
  const std::optional<Eigen::Matrix3d>& cell() const { return cell_; }

 private:
  void comment(const std::vector<std::string_view>& words) {
    if (words.empty()) return;
    if (words.front().starts_with("id")) {
      columns_.assign(words.begin(), words.end());
    } else if (words.front() == "gravity") {
      gravity_.emplace();
      read_numbers(words, {gravity_->data(), 3}, "gravity must have three numbers");
    } else if (words.front() == "cell") {
      cell_.emplace();  // vector by vector, as its columns lie
      read_numbers(words, {cell_->data(), 9}, "the cell must have nine numbers, three vectors");
    }
  }

  void read_numbers(const std::vector<std::string_view>& words, std::span<double> numbers,
                    const char* complaint) const {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (words.size() != numbers.size() + 1 || !parse_number(words[i + 1], &numbers[i]))
        place().fail(complaint);
    }
  }

  std::string path_;
  std::shared_ptr<const std::string> text_;
  LineReader reader_;
  std::vector<std::string> columns_;
  std::optional<Eigen::Vector3d> gravity_;
  std::optional<Eigen::Matrix3d> cell_;
};

/// "zXY" as bits; "-" for none.
int parse_blocked(const Fields& fields) {
  int bits = 0;
  for (const char c : fields.text("blocked")) {
    const std::size_t bit = std::string_view("xyzXYZ").find(c);
    if (bit != std::string_view::npos) {
      bits |= 1 << bit;
    } else if (c != '-') {
      fields.place().fail(fmt::format("blocked: \"{}\" must be of the letters xyzXYZ, or -",
                                      excerpt(fields.text("blocked"))));
    }
  }
  return bits;
}

YadeBody read_body(const Fields& fields) {
  YadeBody body;
  body.place = fields.place();
  body.id = fields.integer("id");
  body.shape = fields.text("shape");
  body.position = fields.vector("x", "y", "z");
  if (fields.has("material")) body.material = fields.integer("material");
  if (body.shape == "Wall") {
    body.axis = fields.integer("axis");
    body.sense = fields.integer("sense");
  } else if (body.shape == "Box") {
    body.extents = fields.vector("hx", "hy", "hz");
    body.turned = fields.number_or("turned", 0) != 0;
  } else if (body.shape == "Sphere") {
    fields.require_all();
    body.radius = fields.number("radius");
    body.mass = fields.number("mass");
    body.inertia = fields.number(fields.has("inertia") ? "inertia" : "inertia_zz");
    body.velocity = {fields.number_or("vx", 0), fields.number_or("vy", 0), fields.number_or("vz", 0)};
    body.angular_velocity = {fields.number_or("wx", 0), fields.number_or("wy", 0), fields.number_or("wz", 0)};
    if (fields.has("blocked")) body.blocked = parse_blocked(fields);
  }
  return body;
}

YadeInteraction read_interaction(const Fields& fields) {
  fields.require_all();
  YadeInteraction interaction;
  interaction.place = fields.place();
  interaction.first = fields.integer("id1");
  interaction.second = fields.integer("id2");
  interaction.normal = fields.vector("nx", "ny", "nz");
  interaction.normal_force = fields.vector("fnx", "fny", "fnz");
  interaction.shear_force = fields.vector("fsx", "fsy", "fsz");
  interaction.overlap = fields.number("pd");
  if (!std::isfinite(interaction.overlap)) fields.place().fail("pd must be a finite number");
  interaction.friction = fields.number_or("tanphi", kNaN);
  return interaction;
}

}  // namespace

YadeScene read_yade_folder(const std::filesystem::path& folder) {
  YadeScene scene;
  const auto read = [&](const char* name, const auto& take) {
    Lines lines(folder / name);
    std::vector<std::string_view> words;
    while (lines.next(&words)) {
      if (lines.columns().empty()) lines.place().fail("a comment line must name the columns first: # id …");
      take(Fields(lines.place(), lines.columns(), words));
    }
    if (lines.gravity()) scene.gravity = lines.gravity();
    if (lines.cell()) scene.cell = lines.cell();
  };
  read("bodies.txt", [&](const Fields& fields) { scene.bodies.push_back(read_body(fields)); });
  read("interactions.txt",
       [&](const Fields& fields) { scene.interactions.push_back(read_interaction(fields)); });
  return scene;
}

}  // namespace indet
