#include "libindet/io/sampling_file.h"

#include <fmt/format.h>

#include "libindet/base/error.h"

namespace indet {
namespace {

std::span<const double> span_of(const Eigen::VectorXd& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

/// The columns of a matrix one after the other, as rows of a dataset.
void write_columns(Hdf5File& file, const std::string& path, const Eigen::MatrixXd& matrix,
                   const Label& label) {
  const auto size = static_cast<std::size_t>(matrix.size());
  file.write(path, std::span<const double>(matrix.data(), size),
             {static_cast<std::size_t>(matrix.cols()), static_cast<std::size_t>(matrix.rows())}, label);
}

void write_components(Hdf5File& file, const ComponentRecord& record, const std::string& group) {
  const auto count = static_cast<std::size_t>(record.deviation.size());
  file.write(group + "/deviation", span_of(record.deviation), {count},
             {"force", "standard deviation of R and T of each contact in turn"});
  file.write(group + "/quantile_levels", span_of(record.quantile_levels),
             {static_cast<std::size_t>(record.quantile_levels.size())},
             {"1", "probabilities of the quantiles"});
  write_columns(file, group + "/quantiles", record.quantiles.transpose(),
                {"force", "quantiles of R and T of each contact in turn, a column a level"});
  file.write(group + "/rhat", span_of(record.rhat), {count},
             {"1", "rank-normalised split R-hat; NaN where the force is determined"});
  file.write(group + "/bulk_ess", span_of(record.bulk), {count}, {"1", "bulk effective sample size"});
  file.write(group + "/tail_ess", span_of(record.tail), {count}, {"1", "tail effective sample size"});
  if (record.states.cols() > 0)
    write_columns(file, group + "/states", record.states, {"force", "some of the samples, a row a state"});
  if (record.covariance.size() > 0) {
    write_columns(file, group + "/covariance", record.covariance,
                  {"force2", "covariances of R and T of each contact in turn"});
  }
}

}  // namespace

void write_sampling_part(Hdf5File& file, const SamplingRecord& record, const std::string& group) {
  file.make_group(group);
  file.set_attribute(group, "method", record.method);
  for (const auto& [name, value] : record.numbers) file.set_attribute(group, name, value);
  const auto size = static_cast<std::size_t>(record.center.size());
  file.write(group + "/center", std::span<const double>(record.center.data(), size), {size},
             {"force", "mean of the accepted states, R and T of each contact in turn"});
  if (record.components) write_components(file, *record.components, group);
}

void write_sampling(const std::filesystem::path& path, const Packing& packing, const SamplingRecord& record,
                    const Provenance& provenance) {
  Hdf5File file = Hdf5File::create(path);
  write_header(file);
  write_packing_part(file, packing);
  write_sampling_part(file, record);
  write_provenance_part(file, provenance);
  seal(file);
}

SamplingRecord read_sampling(const Hdf5File& file) {
  if (!file.has("/sampling")) throw InputError(fmt::format("{} has no samples", file.path().string()));
  SamplingRecord record;
  record.method = file.string_attribute("/sampling", "method");
  record.numbers = file.number_attributes("/sampling");
  const std::vector<double> center = file.read_doubles("/sampling/center", file.shape("/sampling/center", 1));
  record.center = Eigen::Map<const Eigen::VectorXd>(center.data(), static_cast<Eigen::Index>(center.size()));
  return record;
}

}  // namespace indet
