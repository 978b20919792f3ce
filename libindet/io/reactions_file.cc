#include "libindet/io/reactions_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace indet {
namespace {

const std::string kGroup = "/reactions";

/// In the order of the values.
EnumNames outcome_names() {
  EnumNames names;
  for (const Outcome outcome : {Outcome::kOptimal, Outcome::kUnbounded, Outcome::kImprecise, Outcome::kFailed,
                                Outcome::kNotRequested})
    names.emplace_back(to_string(outcome));
  return names;
}

template <class Table>
auto numbers_of(const Table& table) {
  return std::span(table.data(), static_cast<std::size_t>(table.size()));
}

}  // namespace

void write_reactions_part(Hdf5File& file, const Reactions& reactions) {
  if (reactions.count() == 0) return;
  const auto p = static_cast<std::size_t>(reactions.count());
  file.make_group(kGroup);
  const auto write = [&](const char* name, const auto& table, const Shape& shape, const Label& label) {
    file.write(kGroup + "/" + name, numbers_of(table), shape, label);
  };
  write("body", reactions.body, {p}, {"1", "row of a fixed disk, or -(w+1) for the wall of row w"});
  write("component", reactions.component, {p},
        {"1", "wall: 0 sum of R, 1 sum of T; disk: 0, 1 force x, y, 2 torque on it"});
  write("value", reactions.value, {p, 2},
        {"force (torque: force*length)",
         "smallest and largest value, inf where unbounded, NaN where not found"});
  write("lower", reactions.lower, {p, 2},
        {"force (torque: force*length)", "lower end of the enclosure of both"});
  write("upper", reactions.upper, {p, 2},
        {"force (torque: force*length)", "upper end of the enclosure of both"});
  std::vector<std::uint8_t> outcomes;
  for (const Outcome outcome : reactions.outcome.reshaped<Eigen::RowMajor>())
    outcomes.push_back(static_cast<std::uint8_t>(outcome));
  file.write_enum(kGroup + "/outcome", outcomes, {p, 2}, outcome_names(), {"1", "what became of both"});
  write("vertex", reactions.vertex, {p, 2},
        {"1", "row of /reactions/states that attains the value, -1 for none"});
  write(
      "states", reactions.states,
      {static_cast<std::size_t>(reactions.states.rows()), static_cast<std::size_t>(reactions.states.cols())},
      {"force", "states (R_1, T_1, ..., R_M, T_M) that attain the values"});
}

Reactions read_reactions(const Hdf5File& file) {
  Reactions reactions;
  if (!file.has(kGroup)) return reactions;
  const auto fail = [&](const std::string& object, const std::string& reason) {
    throw Hdf5ReadError(fmt::format("{}: {}{}: {}", file.path().string(), kGroup, object, reason));
  };
  const std::size_t p = file.shape(kGroup + "/body", 1)[0];
  const auto count = static_cast<Eigen::Index>(p);
  const auto fill = [](auto& table, Eigen::Index rows, Eigen::Index columns, const auto& values) {
    table.resize(rows, columns);
    std::copy(values.begin(), values.end(), table.data());
  };
  fill(reactions.body, count, 1, file.read_integers(kGroup + "/body", {p}));
  fill(reactions.component, count, 1, file.read_integers(kGroup + "/component", {p}));
  fill(reactions.value, count, 2, file.read_doubles(kGroup + "/value", {p, 2}));
  fill(reactions.lower, count, 2, file.read_doubles(kGroup + "/lower", {p, 2}));
  fill(reactions.upper, count, 2, file.read_doubles(kGroup + "/upper", {p, 2}));
  std::vector<Outcome> outcomes;
  for (const std::uint8_t value : file.read_enum(kGroup + "/outcome", {p, 2}, outcome_names()))
    outcomes.push_back(static_cast<Outcome>(value));
  fill(reactions.outcome, count, 2, outcomes);
  fill(reactions.vertex, count, 2, file.read_integers(kGroup + "/vertex", {p, 2}));
  const std::size_t states = file.shape(kGroup + "/states", 2)[0];
  const std::size_t size = 2 * file.shape("/contacts/body_a", 1)[0];
  const auto walls = static_cast<std::int64_t>(file.shape("/walls/id", 1)[0]);
  const auto disks = static_cast<std::int64_t>(file.shape("/particles/disks/id", 1)[0]);
  fill(reactions.states, static_cast<Eigen::Index>(states), static_cast<Eigen::Index>(size),
       file.read_doubles(kGroup + "/states", {states, size}));
  for (Eigen::Index k = 0; k < count; ++k) {
    const Body body = Body::from_code(reactions.body[k]);
    const bool exists =
        !body.is_cell() && (body.is_wall() ? body.wall_id().value() < walls : body.disk_id().value() < disks);
    if (!exists) fail("/body", fmt::format("there is no body {}", body.code()));
    const int components = body.is_wall() ? 2 : 3;
    if (reactions.component[k] < 0 || reactions.component[k] >= components)
      fail("/component",
           fmt::format("there is no component {} of body {}", reactions.component[k], body.code()));
    for (const std::int32_t row : reactions.vertex.row(k)) {
      if (row < -1 || row >= reactions.states.rows())
        fail("/vertex", fmt::format("there is no state {}", row));
    }
  }
  return reactions;
}

}  // namespace indet
