#include "libindet/io/indet_file.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "libindet/base/version.h"

namespace indet {
namespace {

constexpr std::int64_t kLatestMajor = 2;

std::string user_name() {
  const char* user = std::getenv("USER");
  return user != nullptr && *user != '\0' ? user : "unknown";
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

/// Everything outside /provenance.
std::string content_digest(const Hdf5File& file) {
  std::vector<std::string> objects = file.top_objects();
  std::erase(objects, "/provenance");
  return file.sha256(objects);
}

/// The same of texts, but for those of /h5md, which tell who wrote the file.
std::string text_digest(const Hdf5File& file) {
  std::vector<std::string> objects = file.top_objects();
  std::erase(objects, "/provenance");
  std::erase(objects, "/h5md");
  return file.text_sha256(objects);
}

}  // namespace

void write_header(Hdf5File& file, SchemaVersion schema) {
  file.set_attribute("/", "Conventions", fmt::format("H5MD-1.1 indet-{}", schema.major));
  const std::array<std::int64_t, 2> numbers = {schema.major, schema.minor};
  file.set_attribute("/", "schema_version", std::span<const std::int64_t>(numbers));
  const std::array<std::int64_t, 2> h5md = {1, 1};
  file.make_group("/h5md");
  file.set_attribute("/h5md", "version", std::span<const std::int64_t>(h5md));
  file.make_group("/h5md/author");
  file.set_attribute("/h5md/author", "name", user_name());
  file.make_group("/h5md/creator");
  file.set_attribute("/h5md/creator", "name", "indet");
  file.set_attribute("/h5md/creator", "version", version());
}

void write_provenance_part(Hdf5File& file, const Provenance& provenance) {
  file.make_group("/provenance");
  const auto set = [&](const std::string& name, const std::string& value) {
    file.set_attribute("/provenance", name, value);
  };
  set("version", version());
  set("git", git_revision());
  set("compiler", compiler());
  set("host", host_name());
  set("created",
      fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                  fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now()))));
  file.set_attribute("/provenance", "argv", provenance.arguments);
  set("config", provenance.config);
  if (!provenance.part_of.empty()) set("part_of", provenance.part_of);
  file.make_group("/provenance/libraries");
  std::map<std::string, std::string> libraries = provenance.libraries;
  libraries["HDF5"] = hdf5_version();
  libraries["Eigen"] = fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
  for (const auto& [name, number] : libraries) file.set_attribute("/provenance/libraries", name, number);
  file.make_group("/provenance/timings");
  for (const auto& [stage, seconds] : provenance.seconds) {
    file.set_attribute("/provenance/timings", stage, seconds);
  }
}

void seal(Hdf5File& file) {
  file.set_attribute("/", "content_sha256", content_digest(file));
  file.set_attribute("/", "text_sha256", text_digest(file));
  file.set_attribute("/", "complete", 1);
  file.commit();
}

Hdf5File open_indet_file(const std::filesystem::path& path) {
  Hdf5File file = Hdf5File::open(path);
  const auto fail = [&](const std::string& reason) {
    throw Hdf5ReadError(fmt::format("{}: {}", path.string(), reason));
  };
  if (!file.has_attribute("/", "schema_version")) fail("is an HDF5 file, but not one of indet");
  const double major = file.doubles_attribute("/", "schema_version", 2)[0];
  if (major != 1 && major != static_cast<double>(kLatestMajor)) {
    fail(fmt::format("has version {} of the format; this program reads versions 1 and {}", major,
                     kLatestMajor));
  }
  if (!file.has_attribute("/", "complete") || file.integer_attribute("/", "complete") != 1) {
    fail("was not written to its end");
  }
  return file;
}

Digests compute_digests(const Hdf5File& file) {
  Digests digests;
  digests.content = content_digest(file);
  digests.stored_content = file.string_attribute("/", "content_sha256");
  digests.texts = text_digest(file);
  if (file.has_attribute("/", "text_sha256"))
    digests.stored_texts = file.string_attribute("/", "text_sha256");
  if (file.has("/ranges")) {
    digests.ranges = file.sha256({"/extremal", "/ranges"});
    digests.stored_ranges = file.string_attribute("/ranges", "sha256");
  }
  return digests;
}

Digests compute_digests(const std::filesystem::path& path) { return compute_digests(open_indet_file(path)); }

}  // namespace indet
