#include "apps/ensemble/tables/contact_table.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

#include "apps/ensemble/tables/uniform_tables.h"

namespace indet {
namespace {

constexpr std::array<const char*, 4> kObjectives = {"R_min", "R_max", "T_min", "T_max"};

void add_extremal(const Hdf5File& file, const std::string& dataset, int choice, std::size_t run,
                  FlatTable& table) {
  if (!file.has(dataset)) return;
  const Shape shape = file.shape(dataset, 2);
  const std::vector<std::int32_t> counts = file.read_integers(dataset, shape);
  for (std::size_t k = 0; k < shape[0]; ++k) {
    for (std::size_t bin = 0; bin < shape[1]; ++bin) {
      const std::int32_t count = counts[k * shape[1] + bin];
      if (count == 0) continue;
      const std::size_t row = table.rows();
      table.add_rows(1);
      table.set("run", row, static_cast<double>(run));
      table.set("choice", row, choice);
      table.set("objective", row, static_cast<double>(k));
      table.set("bin", row, static_cast<double>(bin));
      table.set("count", row, count);
    }
  }
}

}  // namespace

std::vector<FlatTable::Column> contact_columns() {
  std::vector<FlatTable::Column> columns = {
      FlatTable::integer("run", "row of the packing in /table/runs"),
      FlatTable::integer("contact", "number of the contact in its packing"),
      FlatTable::integer("body_a", "row of disk a"),
      FlatTable::integer("body_b", "row of disk b, or -(w+1) for the wall of row w"),
      FlatTable::real("x", "r_max", "place of the contact"),
      FlatTable::real("y", "r_max", "place of the contact"),
      FlatTable::real("normal_x", "1", "unit normal from b to a"),
      FlatTable::real("normal_y", "1", "unit normal from b to a"),
      FlatTable::real("gap", "r_max", "distance of the surfaces"),
      FlatTable::real("mu", "1", "Coulomb friction coefficient"),
      FlatTable::real("R", "mg", "normal force as simulated"),
      FlatTable::real("T", "mg", "tangential force as simulated")};
  for (const char* name : kObjectives) columns.push_back(FlatTable::real(name, "mg", "end of the range"));
  columns.push_back(FlatTable::real("delta_R", "mg", "local indeterminacy of the normal force"));
  columns.push_back(FlatTable::real("delta_T", "mg", "local indeterminacy of the tangential force"));
  columns.push_back(FlatTable::real("d_R", "mg", "global indeterminacy of the normal force"));
  columns.push_back(FlatTable::real("d_T", "mg", "global indeterminacy of the tangential force"));
  columns.push_back(
      FlatTable::real("solver_d_R", "mg", "d_R with the states that the solver happens to find"));
  columns.push_back(
      FlatTable::real("solver_d_T", "mg", "d_T with the states that the solver happens to find"));
  columns.push_back(FlatTable::real("paper_d_R", "mg", "d_R with the states where the paper's walk ends"));
  columns.push_back(FlatTable::real("paper_d_T", "mg", "d_T with the states where the paper's walk ends"));
  columns.push_back(
      FlatTable::real("d_R_min", "mg", "smallest distance of states of largest and smallest normal force"));
  columns.push_back(FlatTable::real("d_T_min", "mg",
                                    "smallest distance of states of largest and smallest tangential force"));
  columns.push_back(FlatTable::real("d_R_min_lower", "mg", "proven lower bound of d_R_min"));
  columns.push_back(FlatTable::real("d_T_min_lower", "mg", "proven lower bound of d_T_min"));
  columns.push_back(FlatTable::real("R_star", "1", "place of R in its range"));
  columns.push_back(FlatTable::real("T_star", "1", "place of T in its range"));
  for (const char* name : {"unique_R_min", "unique_R_max", "unique_T_min", "unique_T_max"})
    columns.push_back(FlatTable::integer(name, "1 if only one state attains the value"));
  for (FlatTable::Column& column : uniform_contact_columns()) columns.push_back(std::move(column));
  return columns;
}

std::vector<FlatTable::Column> extremal_columns() {
  return {FlatTable::integer("run", "row of the packing in /table/runs"),
          FlatTable::integer("choice", "0: canonical states, 1: states that the solver happens to find"),
          FlatTable::integer("objective", "states of 0: R_min, 1: R_max, 2: T_min, 3: T_max"),
          FlatTable::integer("bin", "R in [bin, bin+1) mg"),
          FlatTable::integer("count", "contacts with such a force")};
}

void add_contacts(const Hdf5File& file, const Packing& packing, std::size_t run, EnsembleTables& tables) {
  FlatTable& table = tables.contacts;
  const double mg = packing.force_unit();
  const double length = packing.max_radius();
  const std::size_t m = packing.contacts.size();
  const std::size_t first = table.rows();
  table.add_rows(m);
  for (std::size_t i = 0; i < m; ++i) {
    const Contact& c = packing.contacts[i];
    const Disk& disk = packing[c.a];
    const Vector2 place = (disk.position - disk.radius * c.normal) / length;
    const std::size_t row = first + i;
    table.set("run", row, static_cast<double>(run));
    table.set("contact", row, static_cast<double>(i));
    table.set("body_a", row, c.a.value());
    table.set("body_b", row, c.b.code());
    table.set("x", row, place.x());
    table.set("y", row, place.y());
    table.set("normal_x", row, c.normal.x());
    table.set("normal_y", row, c.normal.y());
    table.set("gap", row, c.gap / length);
    table.set("mu", row, c.mu);
    table.set("R", row, c.R / mg);
    table.set("T", row, c.T / mg);
  }
  const auto take = [&](const std::string& dataset, const char* column, double unit) {
    if (!file.has(dataset)) return;
    const std::vector<double> values = file.read_doubles(dataset, {m});
    for (std::size_t i = 0; i < m; ++i) table.set(column, first + i, values[i] / unit);
  };
  for (const char* name : kObjectives) take(fmt::format("/ranges/{}", name), name, mg);
  for (const char* name : {"delta_R", "delta_T", "d_R", "d_T", "d_R_min", "d_T_min", "R_star", "T_star"})
    take(fmt::format("/ranges/{}", name), name, 1);
  for (const char* name : {"solver_d_R", "solver_d_T", "paper_d_R", "paper_d_T"})
    take(fmt::format("/ensemble/{}", name), name, 1);
  if (file.has("/ranges/d_min_lower")) {
    const std::vector<double> lower = file.read_doubles("/ranges/d_min_lower", {m, 2});
    for (std::size_t i = 0; i < m; ++i) {
      table.set("d_R_min_lower", first + i, lower[2 * i]);
      table.set("d_T_min_lower", first + i, lower[2 * i + 1]);
    }
  }
  const std::vector<std::uint8_t> unique = file.read_bytes("/ranges/unique", {m, 4});
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t k = 0; k < 4; ++k)
      table.set(fmt::format("unique_{}", kObjectives[k]), first + i, unique[4 * i + k]);
  }
  add_extremal(file, "/ensemble/extremal_R", 0, run, tables.extremal);
  add_extremal(file, "/ensemble/solver_extremal_R", 1, run, tables.extremal);
}

}  // namespace indet
