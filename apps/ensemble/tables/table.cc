#include "apps/ensemble/tables/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "apps/ensemble/members/member_file.h"
#include "apps/ensemble/tables/uniform_tables.h"
#include "libindet/base/error.h"
#include "libindet/io/ranges_file.h"

namespace indet {
namespace {

using Column = FlatTable::Column;

constexpr std::array<const char*, 4> kObjectives = {"R_min", "R_max", "T_min", "T_max"};

/// Attributes of /equilibrium that become columns of the same name.
const std::vector<std::pair<const char*, const char*>> kEquilibrium = {
    {"rank", "rank of the contact matrix"},
    {"nullity", "dimension of its kernel"},
    {"dim", "dimension of the set of contact states, -1 if empty"},
    {"sliding", "sliding contacts of the simulated state; one that transmits nothing counts twice"},
    {"non_transmitting", "contacts of the simulated state that transmit nothing"},
    {"objectives", "minima and maxima asked for"},
    {"certified", "minima and maxima certified"},
    {"imprecise", "minima and maxima found with doubt"},
    {"failed", "minima and maxima not found"},
    {"unbounded", "minima and maxima without limit"}};

/// Attributes of /simulation and /sampling that become columns of another name.
constexpr std::array<AttributeColumn, 15> kAttributes = {{
    {"time", "/simulation", "time", "sqrt(r_max/g)", "simulated time"},
    {"steps", "/simulation", "steps", "1", "time steps"},
    {"kinetic_energy", "/simulation", "kinetic_energy", "mg r_max", "kinetic energy per disk at the end"},
    {"raw_residual", "/simulation", "raw_residual", "mg", "imbalance before the polish"},
    {"residual", "/simulation", "residual", "mg", "imbalance after the polish"},
    {"polish_distance", "/simulation", "distance", "mg", "distance of raw and polished forces"},
    {"mean_overlap", "/simulation", "mean_overlap", "r_max", "mean overlap"},
    {"r", "/sampling", "r", "mg", "radius of the ensemble of perturb-and-resolve [38]"},
    {"r_error", "/sampling", "r_error", "mg", "standard error of r over the samples"},
    {"r_spread", "/sampling", "spread", "mg", "standard deviation of the distance from the centre"},
    {"start_distance", "/sampling", "start_distance", "mg", "distance of simulated state and centre"},
    {"samples", "/sampling", "samples", "1", "solutions asked for"},
    {"accepted", "/sampling", "accepted", "1", "solutions accepted"},
    {"worst_sample_residual", "/sampling", "worst_residual", "mg",
     "imbalance of the worst accepted solution"},
    {"worst_raw_sample_residual", "/sampling", "worst_raw_residual", "mg", "the same before the polish"},
}};

/// Seconds.
constexpr std::array<AttributeColumn, 4> kTimings = {{
    {"simulate", "/provenance/timings", "simulate", "s", "simulation"},
    {"analyze", "/provenance/timings", "analyze", "s", "ranges and extremal states"},
    {"sample", "/provenance/timings", "sample", "s", "perturb and resolve"},
    {"sample_uniform", "/provenance/timings", "sample_uniform", "s", "uniform sampling, and its comparison"},
}};

std::vector<Column> run_columns() {
  std::vector<Column> columns = {
      FlatTable::text("member", "name of the packing"),
      FlatTable::text("protocol", "how it was made"),
      FlatTable::integer("seed", "seed, -1 if there is none"),
      FlatTable::integer("disks", "number of disks N"),
      FlatTable::integer("contacts", "number of contacts M"),
      FlatTable::integer("lower_bound", "2M - 3N"),
      FlatTable::real("mg", "force", "the unit of force, in the scene's own units"),
      FlatTable::text("status", "bounded, unbounded, point or empty"),
      FlatTable::text("ending", "why the simulation ended")};
  for (const auto& [name, long_name] : kEquilibrium) columns.push_back(FlatTable::integer(name, long_name));
  columns.push_back(FlatTable::integer("unique", "minima and maxima that only one state attains"));
  columns.push_back(FlatTable::integer("states", "distinct extremal states"));
  columns.push_back(FlatTable::real("worst_primal_residual", "mg", "imbalance of the worst extremal state"));
  columns.push_back(FlatTable::real("worst_dual_residual", "1", "largest reduced cost of the wrong sign"));
  columns.push_back(FlatTable::real("mean_R", "mg", "mean normal force of the simulated state"));
  columns.push_back(FlatTable::real("norm", "mg", "norm of the simulated state"));
  columns.push_back(FlatTable::real("largest_norm", "mg", "largest norm of an extremal state"));
  columns.push_back(FlatTable::real("distance_cd1", "mg", "distance to the cd1 state of the same seed"));
  columns.push_back(FlatTable::real("distance_cd2", "mg", "distance to the cd2 state of the same seed"));
  append_columns(kAttributes, columns);
  for (Column& column : uniform_run_columns()) columns.push_back(std::move(column));
  return columns;
}

std::vector<Column> timing_columns() {
  std::vector<Column> columns;
  append_columns(kTimings, columns);
  return columns;
}

std::vector<Column> contact_columns() {
  std::vector<Column> columns = {
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
  columns.push_back(FlatTable::real("delta_R", "1", "local indeterminacy of the normal force"));
  columns.push_back(FlatTable::real("delta_T", "1", "local indeterminacy of the tangential force"));
  columns.push_back(FlatTable::real("d_R", "1", "global indeterminacy of the normal force"));
  columns.push_back(FlatTable::real("d_T", "1", "global indeterminacy of the tangential force"));
  columns.push_back(
      FlatTable::real("solver_d_R", "1", "d_R with the states that the solver happens to find"));
  columns.push_back(
      FlatTable::real("solver_d_T", "1", "d_T with the states that the solver happens to find"));
  columns.push_back(FlatTable::real("R_star", "1", "place of R in its range"));
  columns.push_back(FlatTable::real("T_star", "1", "place of T in its range"));
  for (const char* name : {"unique_R_min", "unique_R_max", "unique_T_min", "unique_T_max"})
    columns.push_back(FlatTable::integer(name, "1 if only one state attains the value"));
  for (Column& column : uniform_contact_columns()) columns.push_back(std::move(column));
  return columns;
}

/// One packing as read from its file, in units of mg.
struct MemberFile {
  Packing packing;
  std::map<std::string, std::vector<double>> columns;  ///< Of /ranges and /ensemble.
  std::vector<std::uint8_t> unique;
  std::map<std::pair<int, int>, Eigen::Vector2d> forces;  ///< By bodies.
};

std::pair<int, int> bodies(const Contact& contact) {
  const int a = contact.a.value();
  const int b = contact.b.code();
  return {std::min(a, b), std::max(a, b)};
}

/// Distance of two states of the same disks in units of force; where one has no contact its forces are 0. R
/// and T do not change if a contact's bodies change places.
double distance(const MemberFile& a, const MemberFile& b) {
  double squares = 0;
  for (const auto& [key, force] : a.forces) {
    const auto other = b.forces.find(key);
    squares += (other == b.forces.end() ? force : force - other->second).squaredNorm();
  }
  for (const auto& [key, force] : b.forces) {
    if (!a.forces.contains(key)) squares += force.squaredNorm();
  }
  return std::sqrt(squares);
}

class Collector {
 public:
  explicit Collector(EnsembleTables& tables) : tables_(tables) {}

  void add(const Member& member, const std::filesystem::path& path) {
    const Hdf5File file = open_indet_file(path);
    MemberFile content;
    content.packing = read_packing(file);
    const double mg = content.packing.force_unit();
    for (const Contact& c : content.packing.contacts) content.forces[bodies(c)] = {c.R / mg, c.T / mg};
    const std::size_t run = tables_.runs.rows();
    tables_.runs.add_rows(1);
    add_run(member, file, content, run);
    const std::size_t first_contact = tables_.contacts.rows();
    add_contacts(file, content, run);
    add_uniform_sampling(file, tables_, run, first_contact);
    add_extremal(file, "/ensemble/extremal_R", 0, run);
    add_extremal(file, "/ensemble/solver_extremal_R", 1, run);
    tables_.timings.add_rows(1);
    take_attributes(file, kTimings, run, tables_.timings);
    add_distances(member, content, run);
  }

 private:
  void add_run(const Member& member, const Hdf5File& file, const MemberFile& content, std::size_t run) {
    FlatTable& runs = tables_.runs;
    const Packing& packing = content.packing;
    const double mg = packing.force_unit();
    runs.set("member", run, member.name);
    runs.set("protocol", run, std::string(to_string(member.protocol)));
    runs.set("seed", run, static_cast<double>(member.seed));
    runs.set("disks", run, packing.disk_count());
    runs.set("contacts", run, packing.contact_count());
    runs.set("lower_bound", run, 2 * packing.contact_count() - 3 * packing.disk_count());
    runs.set("mg", run, mg);
    runs.set("status", run, file.string_attribute("/equilibrium", "status"));
    if (file.has("/simulation")) runs.set("ending", run, file.string_attribute("/simulation", "ending"));
    for (const auto& [name, long_name] : kEquilibrium)
      runs.set(name, run, static_cast<double>(file.integer_attribute("/equilibrium", name)));
    for (const char* name : {"worst_primal_residual", "worst_dual_residual"})
      runs.set(name, run, file.double_attribute("/equilibrium", name));
    const std::vector<std::uint8_t> unique =
        file.read_bytes("/ranges/unique", {static_cast<std::size_t>(packing.contact_count()), 4});
    runs.set("unique", run, static_cast<double>(std::count(unique.begin(), unique.end(), 1)));
    const std::vector<double> norms = file.read_doubles("/extremal/norm", file.shape("/extremal/norm", 1));
    runs.set("states", run, static_cast<double>(norms.size()));
    if (!norms.empty()) runs.set("largest_norm", run, *std::max_element(norms.begin(), norms.end()) / mg);
    if (packing.has_simulated_forces() && packing.contact_count() > 0) {
      double sum = 0;
      for (const Contact& c : packing.contacts) sum += c.R / mg;
      runs.set("mean_R", run, sum / packing.contact_count());
      runs.set("norm", run, packing.simulated_forces().value().norm() / mg);
    }
    take_attributes(file, kAttributes, run, runs);
  }

  void add_contacts(const Hdf5File& file, const MemberFile& content, std::size_t run) {
    FlatTable& table = tables_.contacts;
    const Packing& packing = content.packing;
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
    for (const char* name : {"delta_R", "delta_T", "d_R", "d_T", "R_star", "T_star"})
      take(fmt::format("/ranges/{}", name), name, 1);
    for (const char* name : {"solver_d_R", "solver_d_T"}) take(fmt::format("/ensemble/{}", name), name, 1);
    const std::vector<std::uint8_t> unique = file.read_bytes("/ranges/unique", {m, 4});
    for (std::size_t i = 0; i < m; ++i) {
      for (std::size_t k = 0; k < 4; ++k)
        table.set(fmt::format("unique_{}", kObjectives[k]), first + i, unique[4 * i + k]);
    }
  }

  void add_extremal(const Hdf5File& file, const std::string& dataset, int choice, std::size_t run) {
    if (!file.has(dataset)) return;
    const Shape shape = file.shape(dataset, 2);
    const std::vector<std::int32_t> counts = file.read_integers(dataset, shape);
    FlatTable& table = tables_.extremal;
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

  /// Distances between the states of one seed, whichever comes first.
  void add_distances(const Member& member, MemberFile& content, std::size_t run) {
    using sim::Protocol;
    if (member.protocol == Protocol::kFile || !content.packing.has_simulated_forces()) return;
    for (const auto& [protocol, other] : of_seed_[member.seed]) {
      const double d = distance(content, other.second);
      if (protocol == Protocol::kMd1 || member.protocol == Protocol::kMd1) continue;  // other positions
      if (protocol == Protocol::kCd1) tables_.runs.set("distance_cd1", run, d);
      if (protocol == Protocol::kCd2) tables_.runs.set("distance_cd2", run, d);
      if (member.protocol == Protocol::kCd1) tables_.runs.set("distance_cd1", other.first, d);
      if (member.protocol == Protocol::kCd2) tables_.runs.set("distance_cd2", other.first, d);
    }
    content.packing = Packing{};
    of_seed_[member.seed][member.protocol] = {run, std::move(content)};
  }

  EnsembleTables& tables_;
  std::map<std::int64_t, std::map<sim::Protocol, std::pair<std::size_t, MemberFile>>> of_seed_;
};

}  // namespace

EnsembleTables::EnsembleTables()
    : runs(run_columns()),
      contacts(contact_columns()),
      extremal(
          {FlatTable::integer("run", "row of the packing in /table/runs"),
           FlatTable::integer("choice", "0: canonical states, 1: states that the solver happens to find"),
           FlatTable::integer("objective", "states of 0: R_min, 1: R_max, 2: T_min, 3: T_max"),
           FlatTable::integer("bin", "R in [bin, bin+1) mg"),
           FlatTable::integer("count", "contacts with such a force")}),
      sampled(sampled_columns()),
      timings(timing_columns()) {}

std::vector<sim::Protocol> protocols_of(const FlatTable& runs) {
  std::vector<sim::Protocol> protocols;
  for (std::size_t run = 0; run < runs.rows(); ++run) {
    const auto protocol = sim::protocol_from(runs.text("protocol", run));
    if (!protocol) {
      throw InputError(
          fmt::format("/table/runs/protocol: \"{}\" is no protocol", runs.text("protocol", run)));
    }
    protocols.push_back(*protocol);
  }
  return protocols;
}

Collection collect_members(const Plan& plan, const std::vector<std::filesystem::path>& folders,
                           const ProgressCallback& progress) {
  Collection collection;
  Collector collector(collection.tables);
  for (const Member& member : plan.members) {
    if (progress && !progress({.stage = "collecting",
                               .done = member.number,
                               .total = static_cast<std::int64_t>(plan.members.size()),
                               .details = {}}))
      throw Interrupted();
    std::filesystem::path found;
    for (const std::filesystem::path& folder : folders) {
      const std::filesystem::path path = member_path(folder, member.name);
      if (!member_is_done(path, member)) continue;
      if (!found.empty() && !std::filesystem::equivalent(path, found)) {
        throw InputError(
            fmt::format("{} is in two parts: {} and {}", member.name, found.string(), path.string()));
      }
      found = path;
    }
    if (found.empty()) {
      collection.missing.push_back(member.name);
    } else {
      collector.add(member, found);
    }
  }
  return collection;
}

void read_member(const std::filesystem::path& path) {
  EnsembleTables tables;
  Collector(tables).add(Member{}, path);
}

}  // namespace indet
