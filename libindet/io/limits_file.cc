#include "libindet/io/limits_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/packing/force_bounds.h"

namespace indet {
namespace {

/// In the order of the values of LimitOutcome.
const EnumNames kLimitOutcomes = {to_string(LimitOutcome::kReached), to_string(LimitOutcome::kNever),
                                  to_string(LimitOutcome::kNoState), to_string(LimitOutcome::kUndecided)};
constexpr std::size_t kEnds = 2;  ///< smallest, largest

std::string group_of(std::size_t number) { return fmt::format("/limits/{}", number); }

/// One number of each end.
template <class Value, class Get>
std::array<Value, kEnds> both(const Limit& limit, Get get) {
  return {static_cast<Value>(get(limit.smallest)), static_cast<Value>(get(limit.largest))};
}

/// A table of each end, one after the other; NaN where an end has none.
template <class Get>
void write_tables(Hdf5File& file, const std::string& path, const Limit& limit, const Shape& shape,
                  const Label& label, Get get) {
  std::size_t size = 1;
  for (const std::size_t extent : shape) size *= extent;
  std::vector<double> values;
  for (const LimitEnd* end : {&limit.smallest, &limit.largest}) {
    const auto& table = get(*end);
    if (static_cast<std::size_t>(table.size()) == size) {
      values.insert(values.end(), table.data(), table.data() + table.size());
    } else {
      values.insert(values.end(), size, kNaN);
    }
  }
  Shape all = {kEnds};
  all.insert(all.end(), shape.begin(), shape.end());
  file.write(path, std::span<const double>(values), all, label);
}

void write_change(Hdf5File& file, const std::string& group, const Packing& packing, const Loads& change) {
  file.write(group + "/gravity", std::span<const double>(change.gravity.data(), 2), {2},
             {"acceleration", "of the change: gravity"});
  std::vector<double> values;
  for (const Vector3& load : change.disks) values.insert(values.end(), load.data(), load.data() + 3);
  values.resize(3 * packing.disks.size(), 0);
  file.write(group + "/disk_load", std::span<const double>(values), {packing.disks.size(), 3},
             {"force", "of the change: force x, force y and torque (force times length) on each disk"});
  values.clear();
  for (const Vector2& load : change.walls) values.insert(values.end(), load.data(), load.data() + 2);
  values.resize(2 * packing.walls.size(), 0);
  file.write(group + "/wall_load", std::span<const double>(values), {packing.walls.size(), 2},
             {"force", "of the change: force on each wall along its normal and tangent"});
  file.write(group + "/stress", std::span<const double>(change.stress), {4},
             {"force/length", "of the change: stress xx, yy, xy, pressure"});
}

std::string steps_of(const std::string& group) { return group + "/steps"; }

/// A table of each end; `none` where there is no way to it.
template <class Number, class Get>
std::vector<Number> step_table(const Limit& limit, std::size_t count, Number none, Get get) {
  std::vector<Number> values;
  for (const LimitEnd* end : {&limit.smallest, &limit.largest}) {
    for (const LimitStep& step : end->steps) values.push_back(get(step));
    values.resize(values.size() + count - end->steps.size(), none);
  }
  return values;
}

void write_steps(Hdf5File& file, const std::string& group, const Limit& limit) {
  const std::size_t count = std::max(limit.smallest.steps.size(), limit.largest.steps.size());
  if (count == 0) return;
  const Shape shape = {kEnds, count};
  file.make_group(group);
  const auto write = [&](const StepField<double>& field) {
    const auto values = step_table(limit, count, kNaN, [&](const LimitStep& s) { return s.*field.member; });
    file.write(group + "/" + field.name, std::span<const double>(values), shape, {field.unit, field.meaning});
  };
  write({"value", limit.kind == LimitKind::kTilt ? "rad" : "1", "on the way to each end", &LimitStep::value});
  for (const StepField<double>& field : kStepNumbers) write(field);
  for (const StepField<int>& field : kStepCounts) {
    const auto values =
        step_table<std::int32_t>(limit, count, -1, [&](const LimitStep& s) { return s.*field.member; });
    file.write(group + "/" + field.name, std::span<const std::int32_t>(values), shape,
               {field.unit, field.meaning});
  }
}

void write_limit(Hdf5File& file, const std::string& group, const Packing& packing, const Limit& limit) {
  const std::string unit = limit.kind == LimitKind::kTilt ? "rad" : "1";
  file.make_group(group);
  file.set_attribute(group, "kind", to_string(limit.kind));
  file.set_attribute(group, "load", limit.name);
  file.set_attribute(group, "first_of_several", limit.is_first_of_several ? 1 : 0);
  std::vector<std::int32_t> left_out;
  for (const DiskId disk : limit.left_out) left_out.push_back(disk.value());
  file.write(group + "/left_out", std::span<const std::int32_t>(left_out), {left_out.size()},
             {"1", "rows of disks that were taken out first, in this order"});
  const auto numbers = [&](const char* name, const char* meaning, auto get) {
    const auto values = both<double>(limit, get);
    file.write(group + "/" + name, std::span<const double>(values), {kEnds}, {unit, meaning});
  };
  const auto counts = [&](const char* name, const char* meaning, auto get) {
    const auto values = both<std::int32_t>(limit, get);
    file.write(group + "/" + name, std::span<const std::int32_t>(values), {kEnds}, {"1", meaning});
  };
  const auto outcomes = both<std::uint8_t>(limit, [](const LimitEnd& end) { return end.outcome; });
  file.write_enum(group + "/outcome", outcomes, {kEnds}, kLimitOutcomes,
                  {"1", "of the smallest and the largest admissible value"});
  numbers("value", "smallest and largest admissible value", [](const LimitEnd& end) { return end.value; });
  numbers("lower", "proven lower bound of it", [](const LimitEnd& end) { return end.lower; });
  numbers("upper", "proven upper bound of it", [](const LimitEnd& end) { return end.upper; });
  counts("sliding", "sliding contacts M_s of the state there; -1: not known",
         [](const LimitEnd& end) { return end.sliding; });
  counts("non_transmitting", "contacts without force of it; -1: not known",
         [](const LimitEnd& end) { return end.non_transmitting; });
  counts("dim", "dimension of the states that are left there; -1: not known",
         [](const LimitEnd& end) { return end.dim; });
  counts("one_mechanism", "1: no other motion than the one stored is possible there; 0: not known",
         [](const LimitEnd& end) { return end.has_one_mechanism ? 1 : 0; });
  const std::size_t bounds = force_bounds(packing).size();
  write_tables(
      file, group + "/forces", limit, {2 * packing.contacts.size()},
      {"force", "R and T of each contact in turn at each end; where it is never, a ray"},
      [](const LimitEnd& end) -> auto& { return end.forces.value(); });
  write_tables(
      file, group + "/motion", limit, {packing.disks.size(), 3},
      {"1", "mechanism: velocity x, y and r*omega of each disk, largest entry 1"},
      [](const LimitEnd& end) -> auto& { return end.motion.disks; });
  if (packing.has_loaded_walls())
    write_tables(
        file, group + "/wall_motion", limit, {packing.walls.size(), 2},
        {"1", "mechanism: velocity of each wall along its normal and tangent"},
        [](const LimitEnd& end) -> auto& { return end.motion.walls; });
  if (packing.stress.is_imposed())
    write_tables(
        file, group + "/cell_motion", limit, {2, 2},
        {"1", "mechanism: rate of compression of the cell times its length"},
        [](const LimitEnd& end) -> auto& { return end.motion.cell; });
  if (bounds > 0)
    write_tables(
        file, group + "/bound_multipliers", limit, {bounds},
        {"1", "mechanism: multipliers of the bounds of forces"},
        [](const LimitEnd& end) -> auto& { return end.motion.bounds; });
  if (limit.kind == LimitKind::kFriction) {
    file.set_attribute(group, "attained", limit.is_attained ? 1 : 0);
    std::vector<std::uint8_t> scaled;
    for (const bool is_scaled : limit.scaled) scaled.push_back(is_scaled ? 1 : 0);
    file.write(group + "/scaled", std::span<const std::uint8_t>(scaled), {scaled.size()},
               {"1", "1: the coefficient of friction of this contact is multiplied by the value"});
  }
  if (!std::isnan(limit.map_angle)) file.set_attribute(group, "map_angle", limit.map_angle);
  write_steps(file, steps_of(group), limit);
  if (limit.kind == LimitKind::kLoad) write_change(file, group + "/change", packing, limit.change);
}

class LimitReader {
 public:
  LimitReader(const Hdf5File& file, const Packing& packing, std::string group)
      : file_(file), packing_(packing), group_(std::move(group)) {}

  Limit read() const {
    Limit limit;
    const std::string kind = file_.string_attribute(group_, "kind");
    const auto found = std::find_if(std::begin(kLimitKinds), std::end(kLimitKinds),
                                    [&](LimitKind k) { return kind == to_string(k); });
    if (found == std::end(kLimitKinds)) fail("@kind", fmt::format("\"{}\" is unknown", excerpt(kind)));
    limit.kind = *found;
    limit.name = file_.string_attribute(group_, "load");
    limit.is_first_of_several = file_.integer_attribute(group_, "first_of_several") != 0;
    for (const std::int32_t disk :
         file_.read_integers(group_ + "/left_out", file_.shape(group_ + "/left_out", 1))) {
      if (disk < 0 || disk >= packing_.disk_count())
        fail("/left_out", fmt::format("there is no disk {}", disk));
      limit.left_out.emplace_back(disk);
    }
    const auto outcomes = file_.read_enum(group_ + "/outcome", {kEnds}, kLimitOutcomes);
    for (const std::size_t k : {0, 1}) {
      LimitEnd& end = k == 0 ? limit.smallest : limit.largest;
      end.outcome = static_cast<LimitOutcome>(outcomes[k]);
      end.value = number("value", k);
      end.lower = number("lower", k);
      end.upper = number("upper", k);
      end.sliding = count("sliding", k);
      end.non_transmitting = count("non_transmitting", k);
      end.dim = count("dim", k);
      end.has_one_mechanism = count("one_mechanism", k) != 0;
      Eigen::VectorXd forces;
      read_table("/forces", {2 * packing_.contacts.size()}, k, forces);
      end.forces = SceneForces(std::move(forces));
      read_table("/motion", {packing_.disks.size(), 3}, k, end.motion.disks);
      if (packing_.has_loaded_walls())
        read_table("/wall_motion", {packing_.walls.size(), 2}, k, end.motion.walls);
      if (packing_.stress.is_imposed()) read_table("/cell_motion", {2, 2}, k, end.motion.cell);
      const std::size_t bounds = force_bounds(packing_).size();
      if (bounds > 0) read_table("/bound_multipliers", {bounds}, k, end.motion.bounds);
    }
    if (limit.kind == LimitKind::kFriction) {
      limit.is_attained = file_.integer_attribute(group_, "attained") != 0;
      for (const std::uint8_t is_scaled : file_.read_bytes(group_ + "/scaled", {packing_.contacts.size()}))
        limit.scaled.push_back(is_scaled != 0);
    }
    if (file_.has_attribute(group_, "map_angle"))
      limit.map_angle = file_.double_attribute(group_, "map_angle");
    if (limit.kind == LimitKind::kLoad) read_change(limit.change);
    if (file_.has(steps_of(group_))) read_steps(limit);
    return limit;
  }

 private:
  [[noreturn]] void fail(const std::string& object, const std::string& reason) const {
    throw Hdf5ReadError(fmt::format("{}: {}{}: {}", file_.path().string(), group_, object, reason));
  }
  double number(const char* name, std::size_t k) const {
    return file_.read_doubles(group_ + "/" + name, {kEnds})[k];
  }
  int count(const char* name, std::size_t k) const {
    return file_.read_integers(group_ + "/" + name, {kEnds})[k];
  }

  /// The table of one end; empty where it is NaN.
  template <class Table>
  void read_table(const std::string& name, const Shape& shape, std::size_t k, Table& table) const {
    Shape all = {kEnds};
    all.insert(all.end(), shape.begin(), shape.end());
    const std::vector<double> values = file_.read_doubles(group_ + name, all);
    const std::size_t size = values.size() / kEnds;
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(k * size);
    const auto last = first + static_cast<std::ptrdiff_t>(size);
    const auto missing = std::count_if(first, last, [](double value) { return std::isnan(value); });
    if (missing == static_cast<std::ptrdiff_t>(size)) return;
    if (missing > 0) fail(name, "is NaN in part");
    table.resize(static_cast<Eigen::Index>(shape[0]),
                 shape.size() == 2 ? static_cast<Eigen::Index>(shape[1]) : 1);
    std::copy(first, last, table.data());
  }

  void read_steps(Limit& limit) const {
    const std::string group = steps_of(group_);
    const Shape shape = file_.shape(group + "/value", 2);
    if (shape[0] != kEnds) fail("/steps/value", "has not a row for each end");
    const auto read = [&](auto values, auto member) {
      for (std::size_t k = 0; k < shape[1]; ++k) {
        limit.smallest.steps[k].*member = values[k];
        limit.largest.steps[k].*member = values[shape[1] + k];
      }
    };
    const std::vector<double> values = file_.read_doubles(group + "/value", shape);
    limit.smallest.steps.resize(shape[1]);
    limit.largest.steps.resize(shape[1]);
    read(values, &LimitStep::value);
    for (const StepField<double>& field : kStepNumbers)
      read(file_.read_doubles(group + "/" + field.name, shape), field.member);
    for (const StepField<int>& field : kStepCounts)
      read(file_.read_integers(group + "/" + field.name, shape), field.member);
    for (LimitEnd* end : {&limit.smallest, &limit.largest}) {
      const auto is_blank = [](const LimitStep& step) { return std::isnan(step.value); };
      const auto blank = std::count_if(end->steps.begin(), end->steps.end(), is_blank);
      if (blank == 0) continue;
      if (blank != std::ssize(end->steps)) fail("/steps/value", "is NaN in part");
      for (const LimitStep& step : end->steps) require_blank(step);
      end->steps.clear();
    }
  }

  /// Of an end that there is no way to.
  void require_blank(const LimitStep& step) const {
    const auto require = [&](const char* name, bool holds) {
      if (!holds) fail(fmt::format("/steps/{}", name), "tells of an end that there is no way to");
    };
    for (const StepField<double>& field : kStepNumbers) require(field.name, std::isnan(step.*field.member));
    for (const StepField<int>& field : kStepCounts) require(field.name, step.*field.member == -1);
  }

  void read_change(Loads& change) const {
    const std::string group = group_ + "/change";
    const auto gravity = file_.read_doubles(group + "/gravity", {2});
    change.gravity = {gravity[0], gravity[1]};
    const auto disks = file_.read_doubles(group + "/disk_load", {packing_.disks.size(), 3});
    for (std::size_t i = 0; i < packing_.disks.size(); ++i)
      change.disks.emplace_back(disks[3 * i], disks[3 * i + 1], disks[3 * i + 2]);
    const auto walls = file_.read_doubles(group + "/wall_load", {packing_.walls.size(), 2});
    for (std::size_t w = 0; w < packing_.walls.size(); ++w)
      change.walls.emplace_back(walls[2 * w], walls[2 * w + 1]);
    const auto stress = file_.read_doubles(group + "/stress", {4});
    std::copy(stress.begin(), stress.end(), change.stress.begin());
    if (const std::string defect = defect_of(change, packing_); !defect.empty()) fail("/change", defect);
  }

  const Hdf5File& file_;
  const Packing& packing_;
  std::string group_;
};

}  // namespace

void write_limits_part(Hdf5File& file, const Packing& packing, const std::vector<Limit>& limits) {
  file.make_group("/limits");
  file.set_attribute("/limits", "count", static_cast<std::int64_t>(limits.size()));
  for (std::size_t k = 0; k < limits.size(); ++k) write_limit(file, group_of(k), packing, limits[k]);
}

void write_limits(const std::filesystem::path& path, const Packing& packing, const std::vector<Limit>& limits,
                  const Provenance& provenance) {
  Hdf5File file = Hdf5File::create(path);
  write_header(file, schema_of(packing));
  write_packing_part(file, packing);
  write_limits_part(file, packing, limits);
  write_provenance_part(file, provenance);
  seal(file);
}

bool has_limits(const Hdf5File& file) { return file.has("/limits"); }

std::vector<Limit> read_limits(const Hdf5File& file) {
  if (!has_limits(file))
    throw InputError(fmt::format("{} has no limits; compute them first: indet limit {} --tilt",
                                 file.path().string(), file.path().string()));
  const Packing packing = read_packing(file);
  const std::int64_t count = file.integer_attribute("/limits", "count");
  if (count < 1 || !file.has(group_of(static_cast<std::size_t>(count) - 1)) ||
      file.has(group_of(static_cast<std::size_t>(count))))
    throw Hdf5ReadError(fmt::format("{}: /limits@count: {} limits", file.path().string(), count));
  std::vector<Limit> limits;
  for (std::int64_t k = 0; k < count; ++k)
    limits.push_back(LimitReader(file, packing, group_of(static_cast<std::size_t>(k))).read());
  return limits;
}

}  // namespace indet
