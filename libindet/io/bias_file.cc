#include "libindet/io/bias_file.h"

namespace indet {
namespace {

BiasRecord::Histogram read_histogram(const Hdf5File& file, const std::string& path) {
  return {.width = file.double_attribute(path, "width"),
          .first = file.integer_attribute(path, "first"),
          .counts = file.read_integers(path, file.shape(path, 1))};
}

BiasRecord::SampledForces read_forces(const Hdf5File& file, const std::string& group) {
  return {.states = file.integer_attribute(group, "states"),
          .force = read_histogram(file, group + "/R"),
          .standard = read_histogram(file, group + "/standard_R"),
          .place = read_histogram(file, group + "/R_star")};
}

}  // namespace

std::optional<BiasRecord> read_bias(const Hdf5File& file) {
  if (!file.has("/bias")) return std::nullopt;
  BiasRecord record;
  record.numbers = file.number_attributes("/bias");
  const std::size_t contacts = file.shape("/contacts/body_a", 1)[0];
  for (const char* name : {"mean_R", "deviation_R", "effective_R", "uniform_effective_R", "p_mean",
                           "p_distribution", "control_p_mean", "control_p_distribution"}) {
    const std::string dataset = std::string("/bias/") + name;
    if (!file.has(dataset)) continue;
    const std::vector<double> values = file.read_doubles(dataset, {contacts});
    record.contacts[name] =
        Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  }
  record.uniform = read_forces(file, "/bias/uniform");
  record.perturb = read_forces(file, "/bias/perturb");
  return record;
}

}  // namespace indet
