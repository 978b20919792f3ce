#include "apps/ensemble/tables/run_table.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "apps/ensemble/tables/limit_table.h"
#include "apps/ensemble/tables/uniform_tables.h"

namespace indet {
namespace {

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

/// Attributes of other groups that become columns, mostly of another name.
constexpr std::array<AttributeColumn, 23> kAttributes = {{
    {"raw_sliding", "/simulation", "raw_sliding", "1",
     "sliding contacts of the raw state, as the paper counts them; those that transmit nothing do not count"},
    {"time", "/simulation", "time", "sqrt(r_max/g)", "simulated time"},
    {"steps", "/simulation", "steps", "1", "time steps"},
    {"kinetic_energy", "/simulation", "kinetic_energy", "mg r_max", "kinetic energy per disk at the end"},
    {"raw_residual", "/simulation", "raw_residual", "mg", "imbalance before the polish"},
    {"residual", "/simulation", "residual", "mg", "imbalance after the polish"},
    {"polish_distance", "/simulation", "distance", "mg", "distance of raw and polished forces"},
    {"mean_overlap", "/simulation", "mean_overlap", "r_max", "mean overlap"},
    {"largest_overlap", "/simulation", "largest_overlap", "r_max", "largest overlap"},
    {"r", "/sampling", "r", "mg", "radius of the ensemble of perturb-and-resolve [38]"},
    {"r_error", "/sampling", "r_error", "mg", "standard error of r over the samples"},
    {"r_spread", "/sampling", "spread", "mg", "standard deviation of the distance from the centre"},
    {"start_distance", "/sampling", "start_distance", "mg", "distance of simulated state and centre"},
    {"samples", "/sampling", "samples", "1", "solutions asked for"},
    {"accepted", "/sampling", "accepted", "1", "solutions accepted"},
    {"worst_sample_residual", "/sampling", "worst_residual", "mg",
     "imbalance of the worst accepted solution"},
    {"paper_walks", "/ensemble", "paper_walks", "1", "walks of the paper's method"},
    {"paper_failures", "/ensemble", "paper_failures", "1",
     "of these, failed ones: other than dim F constraints are active at their end"},
    {"paper_imprecise", "/ensemble", "paper_imprecise", "1", "minima and maxima that they do not prove"},
    {"d_min_known", "/ensemble", "d_min_known", "1", "smallest distances known to tolerance, of R and T"},
    {"d_min_imprecise", "/ensemble", "d_min_imprecise", "1", "smallest distances found with doubt"},
    {"d_min_failed", "/ensemble", "d_min_failed", "1", "smallest distances not found"},
    {"worst_raw_sample_residual", "/sampling", "worst_raw_residual", "mg", "the same before the polish"},
}};

/// Seconds.
constexpr std::array<AttributeColumn, 7> kTimings = {{
    {"simulate", "/provenance/timings", "simulate", "s", "simulation"},
    {"analyze", "/provenance/timings", "analyze", "s", "ranges and extremal states"},
    {"smallest_distances", "/provenance/timings", "smallest distances", "s", "smallest distances, of these"},
    {"sample", "/provenance/timings", "sample", "s", "perturb and resolve"},
    {"paper_walk", "/provenance/timings", "paper_walk", "s", "the paper's walk"},
    {"limits", "/provenance/timings", "limits", "s", "limits of tilt, load and friction"},
    {"sample_uniform", "/provenance/timings", "sample_uniform", "s", "uniform sampling, and its comparison"},
}};

}  // namespace

std::vector<FlatTable::Column> run_columns() {
  std::vector<FlatTable::Column> columns = {
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
  for (FlatTable::Column& column : limit_columns()) columns.push_back(std::move(column));
  for (FlatTable::Column& column : uniform_run_columns()) columns.push_back(std::move(column));
  return columns;
}

std::vector<FlatTable::Column> timing_columns() {
  std::vector<FlatTable::Column> columns;
  append_columns(kTimings, columns);
  return columns;
}

std::size_t add_run(const Member& member, const Hdf5File& file, const Packing& packing,
                    EnsembleTables& tables) {
  FlatTable& runs = tables.runs;
  const std::size_t run = runs.rows();
  runs.add_rows(1);
  const double mg = packing.force_unit();
  runs.set("member", run, member.name);
  runs.set("protocol", run, std::string(to_string(member.protocol)));
  runs.set("seed", run, static_cast<double>(member.seed));
  runs.set("disks", run, packing.disk_count());
  runs.set("contacts", run, packing.contact_count());
  runs.set("lower_bound", run, packing.expected_dimension());
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
  add_limits(file, packing, run, runs);
  tables.timings.add_rows(1);
  take_attributes(file, kTimings, run, tables.timings);
  return run;
}

}  // namespace indet
