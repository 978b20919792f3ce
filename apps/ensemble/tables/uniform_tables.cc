#include "apps/ensemble/tables/uniform_tables.h"

#include <array>
#include <string>

namespace indet {
namespace {

/// Attributes of /uniform and /bias.
constexpr std::array<AttributeColumn, 26> kUniformAttributes = {{
    {"uniform_r", "/uniform", "r", "mg", "radius of the uniform distribution [38]"},
    {"uniform_r_error", "/uniform", "r_error", "mg", "its standard error"},
    {"uniform_spread", "/uniform", "spread", "mg", "standard deviation of the distance from its centre"},
    {"uniform_ess", "/uniform", "ess", "1", "fewest effective samples of any R, T or the norm"},
    {"uniform_rhat", "/uniform", "rhat", "1", "largest R-hat of any R, T or the norm"},
    {"uniform_distance", "/uniform", "start_distance", "mg",
     "distance of the simulated state from its centre"},
    {"uniform_distance_percentile", "/uniform", "start_distance_percentile", "1",
     "percentile of that distance"},
    {"uniform_norm_percentile", "/uniform", "start_norm_percentile", "1", "percentile of the simulated norm"},
    {"uniform_normal_force_percentile", "/uniform", "start_normal_force_percentile", "1",
     "percentile of the simulated sum of R"},
    {"uniform_mobilisation_percentile", "/uniform", "start_mobilisation_percentile", "1",
     "percentile of the simulated mean of |T|/(mu R)"},
    {"uniform_R_star_percentile", "/uniform", "start_R_star_percentile", "1",
     "percentile of the simulated mean of R*"},
    {"uniform_sliding_percentile", "/uniform", "start_sliding_percentile", "1",
     "percentile of the simulated number of sliding contacts"},
    {"uniform_most_sliding", "/uniform", "most_sliding", "1", "most sliding contacts of a sample"},
    {"uniform_central_R", "/uniform", "start_central_fraction_R", "1",
     "contacts whose simulated R lies between the quantiles 5 % and 95 %"},
    {"bias_states", "/bias", "states", "1", "states of perturb-and-resolve that were compared"},
    {"bias_r_error", "/bias", "r_error", "mg", "standard error of r, from effective states"},
    {"bias_ratio", "/bias", "ratio", "1", "r / uniform_r"},
    {"bias_ratio_error", "/bias", "ratio_error", "1", "its standard error"},
    {"bias_shift", "/bias", "center_shift", "mg", "distance of the two centres, noise taken away"},
    {"bias_shift_error", "/bias", "center_shift_error", "mg", "its standard error"},
    {"bias_noise", "/bias", "center_noise", "mg", "distance that noise alone would cause"},
    {"bias_tested", "/bias", "tested", "1", "contacts with enough effective states for tests"},
    {"bias_means", "/bias", "means", "1", "contacts whose means of R differ (false discoveries: 5 %)"},
    {"bias_distributions", "/bias", "distributions", "1", "contacts whose distributions of R differ"},
    {"control_means", "/bias", "control_means", "1", "the same for two halves of the uniform sample"},
    {"control_distributions", "/bias", "control_distributions", "1",
     "the same for two halves of the uniform sample"},
}};

/// A column of the contacts that is a dataset of the member file.
struct TakenContacts {
  const char* column;
  const char* dataset;
  const char* unit;
  const char* long_name;
};
constexpr std::array<TakenContacts, 8> kTakenContacts = {{
    {"uniform_R_percentile", "/uniform/percentile_R", "1", "percentage of uniform samples with a smaller R"},
    {"perturb_R", "/bias/mean_R", "mg", "mean R of perturb-and-resolve"},
    {"perturb_R_deviation", "/bias/deviation_R", "mg", "its standard deviation over the states"},
    {"perturb_R_effective", "/bias/effective_R", "1", "effective states of perturb-and-resolve"},
    {"p_mean", "/bias/p_mean", "1", "p-value: the mean R is that of the uniform distribution"},
    {"p_distribution", "/bias/p_distribution", "1", "p-value: so is the distribution of R"},
    {"p_mean_control", "/bias/control_p_mean", "1", "the same for two halves of the uniform sample"},
    {"p_distribution_control", "/bias/control_p_distribution", "1",
     "the same for two halves of the uniform sample"},
}};

/// R of each contact from a dataset of R and T in turn, in mg.
void take_normal_forces(const Hdf5File& file, const std::string& dataset, const char* column, double mg,
                        FlatTable& contacts, std::size_t first) {
  const std::vector<double> values = file.read_doubles(dataset, {2 * (contacts.rows() - first)});
  for (std::size_t i = 0; 2 * i < values.size(); ++i) contacts.set(column, first + i, values[2 * i] / mg);
}

void add_bins(const Hdf5File& file, const std::string& group, const char* quantity, int sampling,
              std::size_t run, FlatTable& table) {
  const std::string path = group + "/" + quantity;
  const auto first = file.integer_attribute(path, "first");
  const double width = file.double_attribute(path, "width");
  const double states = file.double_attribute(group, "states");
  const std::vector<std::int32_t> counts = file.read_integers(path, file.shape(path, 1));
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (counts[k] == 0) continue;
    const std::size_t row = table.rows();
    table.add_rows(1);
    table.set("run", row, static_cast<double>(run));
    table.set("sampling", row, sampling);
    table.set("quantity", row, std::string(quantity));
    table.set("low", row, width * (static_cast<double>(first) + static_cast<double>(k)));
    table.set("width", row, width);
    table.set("contacts", row, counts[k] / states);
  }
}

}  // namespace

std::vector<FlatTable::Column> uniform_run_columns() {
  std::vector<FlatTable::Column> columns = {FlatTable::text(
      "uniform", "uniform sampling: converged, limit; unbounded, point, empty; nothing if not asked for")};
  append_columns(kUniformAttributes, columns);
  return columns;
}

std::vector<FlatTable::Column> uniform_contact_columns() {
  std::vector<FlatTable::Column> columns = {
      FlatTable::real("uniform_R", "mg", "mean R of the uniform distribution"),
      FlatTable::real("uniform_R_deviation", "mg", "its standard deviation over the states")};
  for (const TakenContacts& t : kTakenContacts)
    columns.push_back(FlatTable::real(t.column, t.unit, t.long_name));
  return columns;
}

std::vector<FlatTable::Column> sampled_columns() {
  return {FlatTable::integer("run", "row of the packing in /table/runs"),
          FlatTable::integer("sampling", "0: uniform, 1: perturb-and-resolve"),
          FlatTable::text("quantity",
                          "R (mg); standard_R: (R - mean)/deviation, of the uniform distribution; R_star"),
          FlatTable::real("low", "1", "lower end of the bin"),
          FlatTable::real("width", "1", "its width"),
          FlatTable::real("contacts", "1", "contacts in the bin, mean over the states")};
}

void add_uniform_sampling(const Hdf5File& file, EnsembleTables& tables, std::size_t run,
                          std::size_t first_contact) {
  if (!file.has("/uniform")) return;
  tables.runs.set("uniform", run, file.string_attribute("/uniform", "outcome"));
  take_attributes(file, kUniformAttributes, run, tables.runs);
  FlatTable& contacts = tables.contacts;
  const double mg = tables.runs.number("mg", run);
  if (file.has("/uniform/center")) {
    take_normal_forces(file, "/uniform/center", "uniform_R", mg, contacts, first_contact);
    take_normal_forces(file, "/uniform/deviation", "uniform_R_deviation", mg, contacts, first_contact);
  }
  for (const TakenContacts& t : kTakenContacts) {
    if (!file.has(t.dataset)) continue;
    const std::vector<double> values = file.read_doubles(t.dataset, {contacts.rows() - first_contact});
    for (std::size_t i = 0; i < values.size(); ++i) contacts.set(t.column, first_contact + i, values[i]);
  }
  if (!file.has("/bias")) return;
  for (const char* quantity : {"R", "standard_R", "R_star"}) {
    add_bins(file, "/bias/uniform", quantity, 0, run, tables.sampled);
    add_bins(file, "/bias/perturb", quantity, 1, run, tables.sampled);
  }
}

}  // namespace indet
