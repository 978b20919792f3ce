#include "libindet/io/sampling_file.h"

#include <fmt/format.h>

#include <vector>

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
  if (record.percentile_R.size() > 0) {
    file.write(group + "/percentile_R", span_of(record.percentile_R),
               {static_cast<std::size_t>(record.percentile_R.size())},
               {"1", "percentage of the samples with a smaller R than the simulated one"});
  }
}

Eigen::VectorXd read_vector(const Hdf5File& file, const std::string& path) {
  const std::vector<double> values = file.read_doubles(path, file.shape(path, 1));
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// The rows of a dataset as columns of a matrix.
Eigen::MatrixXd read_columns(const Hdf5File& file, const std::string& path) {
  const Shape shape = file.shape(path, 2);
  const std::vector<double> values = file.read_doubles(path, shape);
  return Eigen::Map<const Eigen::MatrixXd>(values.data(), static_cast<Eigen::Index>(shape[1]),
                                           static_cast<Eigen::Index>(shape[0]));
}

ComponentRecord read_components(const Hdf5File& file, const std::string& group) {
  ComponentRecord record;
  record.deviation = read_vector(file, group + "/deviation");
  record.quantile_levels = read_vector(file, group + "/quantile_levels");
  record.quantiles = read_columns(file, group + "/quantiles").transpose();
  record.rhat = read_vector(file, group + "/rhat");
  record.bulk = read_vector(file, group + "/bulk_ess");
  record.tail = read_vector(file, group + "/tail_ess");
  const Eigen::Index count = record.deviation.size();
  record.states.resize(count, 0);
  if (file.has(group + "/states")) record.states = read_columns(file, group + "/states");
  if (file.has(group + "/percentile_R")) record.percentile_R = read_vector(file, group + "/percentile_R");
  if (file.has(group + "/covariance")) record.covariance = read_columns(file, group + "/covariance");
  const auto require = [&](bool fits, const char* name) {
    if (!fits)
      throw Hdf5ReadError(
          fmt::format("{}: {}/{} does not fit {} components", file.path().string(), group, name, count));
  };
  require(record.quantiles.rows() == count && record.quantiles.cols() == record.quantile_levels.size(),
          "quantiles");
  require(record.rhat.size() == count, "rhat");
  require(record.bulk.size() == count, "bulk_ess");
  require(record.tail.size() == count, "tail_ess");
  require(record.states.rows() == count, "states");
  require(record.covariance.size() == 0 ||
              (record.covariance.rows() == count && record.covariance.cols() == count),
          "covariance");
  require(record.percentile_R.size() == 0 || 2 * record.percentile_R.size() == count, "percentile_R");
  return record;
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
  write_header(file, schema_of(packing));
  write_packing_part(file, packing);
  write_sampling_part(file, record);
  write_provenance_part(file, provenance);
  seal(file);
}

SamplingRecord read_sampling(const Hdf5File& file, const std::string& group) {
  if (!file.has(group + "/center"))
    throw InputError(fmt::format("{} has no samples in {}", file.path().string(), group));
  SamplingRecord record;
  record.method = file.string_attribute(group, "method");
  record.numbers = file.number_attributes(group);
  record.center = read_vector(file, group + "/center");
  if (file.has(group + "/deviation")) record.components = read_components(file, group);
  return record;
}

}  // namespace indet
