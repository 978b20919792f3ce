#include "indet/io/sampling_file.h"

#include <fmt/format.h>

#include "indet/base/error.h"

namespace indet {

void write_sampling_part(Hdf5File& file, const SamplingRecord& record) {
  file.make_group("/sampling");
  file.set_attribute("/sampling", "method", record.method);
  for (const auto& [name, value] : record.numbers) file.set_attribute("/sampling", name, value);
  const auto size = static_cast<std::size_t>(record.center.size());
  file.write("/sampling/center", std::span<const double>(record.center.data(), size), {size},
             {"force", "mean of the accepted states, R and T of each contact in turn"});
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

SamplingRecord read_sampling(const std::filesystem::path& path) {
  const Hdf5File file = open_indet_file(path);
  if (!file.has("/sampling")) throw InputError(fmt::format("{} has no samples", path.string()));
  SamplingRecord record;
  record.method = file.string_attribute("/sampling", "method");
  record.numbers = file.number_attributes("/sampling");
  const std::vector<double> center = file.read_doubles("/sampling/center", file.shape("/sampling/center", 1));
  record.center = Eigen::Map<const Eigen::VectorXd>(center.data(), static_cast<Eigen::Index>(center.size()));
  return record;
}

}  // namespace indet
