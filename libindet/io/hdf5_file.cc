#include "libindet/io/hdf5_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <system_error>
#include <utility>

#include "libindet/io/content_digest.h"
#include "libindet/io/hdf5_guard.h"
#include "libindet/io/hdf5_session.h"
#include "libindet/io/hdf5_writing.h"
#include "libindet/io/whole_file.h"

namespace indet {

namespace fs = std::filesystem;
using hdf5::Handle;
using hdf5::Silence;

struct Hdf5File::State {
  hdf5::Session session;
  std::optional<WholeFile> target;  ///< Of a file that is being written.
};

Hdf5File::Hdf5File(std::unique_ptr<State> state) : state_(std::move(state)) {}
Hdf5File::Hdf5File(Hdf5File&&) noexcept = default;
Hdf5File& Hdf5File::operator=(Hdf5File&&) noexcept = default;

Hdf5File::~Hdf5File() {
  if (!state_) return;
  const Silence silence;
  state_.reset();
}

Hdf5File Hdf5File::open(const fs::path& path) {
  const Silence silence;
  auto state = std::make_unique<State>();
  hdf5::Session& session = state->session;
  session.path = path;
  std::error_code error;
  if (!fs::exists(path, error)) throw Hdf5ReadError(fmt::format("{}: there is no such file", path.string()));
  if (!fs::is_regular_file(path, error)) throw Hdf5ReadError(fmt::format("{}: is not a file", path.string()));
  session.file_size = static_cast<std::size_t>(fs::file_size(path, error));
  const Handle access = session.own(H5Pcreate(H5P_FILE_ACCESS), "access");
  session.check(H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG), "access");
  // A file that has its name is whole and is never changed: no lock, which many network file systems refuse.
  session.check(H5Pset_file_locking(access.get(), false, true), "access");
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get());
  if (file < 0) {
    throw Hdf5ReadError(
        fmt::format("{}: cannot be opened as an HDF5 file ({})", path.string(), hdf5::library_message()));
  }
  session.file = Handle(file);
  return Hdf5File(std::move(state));
}

Hdf5File Hdf5File::create(const fs::path& path) {
  const Silence silence;
  auto state = std::make_unique<State>();
  hdf5::Session& session = state->session;
  session.path = path;
  session.is_written = true;
  state->target.emplace(path);
  const Handle creation = session.own(H5Pcreate(H5P_FILE_CREATE), "properties");
  session.check(H5Pset_obj_track_times(creation.get(), false), "properties");
  // The file grows in memory and is written in one piece by commit(): when a write of its own fails (a full
  // disk), HDF5 1.10 leaves a file that it cannot close, and crashes as the process ends.
  constexpr std::size_t kGrowth = 1U << 20U;
  const Handle access = session.own(H5Pcreate(H5P_FILE_ACCESS), "access");
  session.check(H5Pset_fapl_core(access.get(), kGrowth, false), "access");
  // HDF5 reads a file that has the name already, and waits for ever at a FIFO.
  const hid_t file = H5Fcreate(temporary_name(path).c_str(), H5F_ACC_TRUNC, creation.get(), access.get());
  if (file < 0) session.fail("create", hdf5::library_message());
  session.file = Handle(file);
  return Hdf5File(std::move(state));
}

const fs::path& Hdf5File::path() const { return state_->session.path; }

void Hdf5File::make_group(const std::string& path) {
  const Silence silence;
  hdf5::make_parents(state_->session, path);
  hdf5::make_group(state_->session, path);
}

void Hdf5File::write(const std::string& path, std::span<const double> values, const Shape& shape,
                     const Label& label) {
  const Silence silence;
  hdf5::write(state_->session, path, values.data(), values.size(), {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 8},
              shape, label);
}

void Hdf5File::write(const std::string& path, std::span<const std::int32_t> values, const Shape& shape,
                     const Label& label) {
  const Silence silence;
  hdf5::write(state_->session, path, values.data(), values.size(), {H5T_STD_I32LE, H5T_NATIVE_INT32, 4},
              shape, label);
}

void Hdf5File::write(const std::string& path, std::span<const std::int64_t> values, const Shape& shape,
                     const Label& label) {
  const Silence silence;
  hdf5::write(state_->session, path, values.data(), values.size(), {H5T_STD_I64LE, H5T_NATIVE_INT64, 8},
              shape, label);
}

void Hdf5File::write(const std::string& path, std::span<const std::uint8_t> values, const Shape& shape,
                     const Label& label) {
  const Silence silence;
  hdf5::write(state_->session, path, values.data(), values.size(), {H5T_STD_U8LE, H5T_NATIVE_UINT8, 1}, shape,
              label);
}

void Hdf5File::write_enum(const std::string& path, std::span<const std::uint8_t> values, const Shape& shape,
                          const EnumNames& names, const Label& label) {
  const Silence silence;
  const Handle type = state_->session.enum_type(names, path);
  hdf5::write(state_->session, path, values.data(), values.size(), {type.get(), type.get(), 1}, shape, label);
}

void Hdf5File::write_strings(const std::string& path, const std::vector<std::string>& values,
                             const Label& label) {
  const Silence silence;
  const Handle type = state_->session.string_type();
  std::vector<const char*> pointers;
  for (const std::string& value : values) pointers.push_back(value.c_str());
  hdf5::write(state_->session, path, static_cast<const void*>(pointers.data()), values.size(),
              {type.get(), type.get(), 1}, {values.size()}, label);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, const std::string& value) {
  const Silence silence;
  hdf5::set_text(state_->session, object, name, value);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, const char* value) {
  set_attribute(object, name, std::string(value));
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             const std::vector<std::string>& values) {
  const Silence silence;
  hdf5::set_texts(state_->session, object, name, values);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, double value) {
  const Silence silence;
  hdf5::set_raw(state_->session, object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {}, &value);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, std::int64_t value) {
  const Silence silence;
  hdf5::set_raw(state_->session, object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, {}, &value);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, int value) {
  set_attribute(object, name, static_cast<std::int64_t>(value));
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             std::span<const double> values) {
  const Silence silence;
  hdf5::set_raw(state_->session, object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {values.size()},
                values.data());
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             std::span<const std::int64_t> values) {
  const Silence silence;
  hdf5::set_raw(state_->session, object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, {values.size()},
                values.data());
}

void Hdf5File::set_fixed_text(const std::string& object, const std::string& name, const std::string& value) {
  const Silence silence;
  hdf5::set_fixed_text(state_->session, object, name, value);
}

void Hdf5File::link(const std::string& object, const std::string& path) {
  const Silence silence;
  hdf5::link(state_->session, object, path);
}

void Hdf5File::commit() {
  const Silence silence;
  state_->target->commit(hdf5::close_to_bytes(state_->session));
}

bool Hdf5File::has(const std::string& path) const {
  const Silence silence;
  return hdf5::exists(state_->session, path);
}

Shape Hdf5File::shape(const std::string& path, std::size_t rank) const {
  const Silence silence;
  const hdf5::Session& session = state_->session;
  const Handle dataset = hdf5::open_dataset(session, path);
  const Handle space = session.own(H5Dget_space(dataset.get()), path);
  const Shape found = hdf5::extent(session, space.get(), path);
  if (found.size() != rank) {
    session.fail(path, fmt::format("has rank {} instead of {}", found.size(), rank));
  }
  hdf5::check_storage(session, dataset.get(), found, path);
  return found;
}

std::vector<double> Hdf5File::read_doubles(const std::string& path, const Shape& shape) const {
  const Silence silence;
  const hdf5::Session& session = state_->session;
  const Handle dataset = hdf5::open_checked(session, path, {H5T_FLOAT, "floating-point numbers", 8}, shape);
  return hdf5::read_all<double>(session, dataset, H5T_NATIVE_DOUBLE, shape, path);
}

std::vector<std::int32_t> Hdf5File::read_integers(const std::string& path, const Shape& shape) const {
  const Silence silence;
  const hdf5::Session& session = state_->session;
  const Handle dataset = hdf5::open_checked(session, path, {H5T_INTEGER, "integers of 32 bits", 4}, shape);
  return hdf5::read_all<std::int32_t>(session, dataset, H5T_NATIVE_INT32, shape, path);
}

std::vector<std::int64_t> Hdf5File::read_long_integers(const std::string& path, const Shape& shape) const {
  const Silence silence;
  const hdf5::Session& session = state_->session;
  const Handle dataset = hdf5::open_checked(session, path, {H5T_INTEGER, "integers of 64 bits", 8}, shape);
  return hdf5::read_all<std::int64_t>(session, dataset, H5T_NATIVE_INT64, shape, path);
}

std::vector<std::uint8_t> Hdf5File::read_bytes(const std::string& path, const Shape& shape) const {
  const Silence silence;
  const hdf5::Session& session = state_->session;
  const Handle dataset = hdf5::open_checked(session, path, {H5T_INTEGER, "integers of 8 bits", 1}, shape);
  return hdf5::read_all<std::uint8_t>(session, dataset, H5T_NATIVE_UINT8, shape, path);
}

std::vector<std::uint8_t> Hdf5File::read_enum(const std::string& path, const Shape& shape,
                                              const EnumNames& names) const {
  const Silence silence;
  const hdf5::Session& session = state_->session;
  const Handle dataset = hdf5::open_checked(session, path, {H5T_ENUM, "an enumeration", 1}, shape);
  const Handle found = session.own(H5Dget_type(dataset.get()), path);
  const int members = H5Tget_nmembers(found.get());
  const std::size_t known = std::min(names.size(), static_cast<std::size_t>(std::max(1, members)));
  const Handle expected =
      session.enum_type(EnumNames(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(known)), path);
  if (H5Tequal(found.get(), expected.get()) <= 0) {
    session.fail(path, fmt::format("must be an enumeration of {}", fmt::join(names, ", ")));
  }
  auto values = hdf5::read_all<std::uint8_t>(session, dataset, expected.get(), shape, path);
  for (const std::uint8_t value : values) {
    if (value >= known) session.fail(path, fmt::format("holds {}, which has no name", value));
  }
  return values;
}

std::vector<std::string> Hdf5File::read_strings(const std::string& path, std::size_t count) const {
  const Silence silence;
  return hdf5::dataset_texts(state_->session, path, count);
}

bool Hdf5File::has_attribute(const std::string& object, const std::string& name) const {
  const Silence silence;
  const hdf5::Session& session = state_->session;
  return hdf5::exists(session, object) &&
         H5Aexists(hdf5::open_object(session, object).get(), name.c_str()) > 0;
}

std::string Hdf5File::string_attribute(const std::string& object, const std::string& name) const {
  const Silence silence;
  const hdf5::Session& session = state_->session;
  return hdf5::attribute_text(session, hdf5::open_attribute(session, object, name), object + "@" + name);
}

double Hdf5File::double_attribute(const std::string& object, const std::string& name) const {
  return doubles_attribute(object, name, 1).front();
}

std::int64_t Hdf5File::integer_attribute(const std::string& object, const std::string& name) const {
  const Silence silence;
  const hdf5::Session& session = state_->session;
  const std::string place = object + "@" + name;
  const Handle attribute = hdf5::open_attribute(session, object, name);
  const Handle type = session.own(H5Aget_type(attribute.get()), place);
  if (H5Tget_class(type.get()) != H5T_INTEGER) session.fail(place, "must be an integer");
  if (hdf5::attribute_count(session, attribute, place, 1) != 1) session.fail(place, "must be one number");
  std::int64_t value = 0;
  session.check(H5Aread(attribute.get(), H5T_NATIVE_INT64, &value), place);
  return value;
}

std::vector<double> Hdf5File::doubles_attribute(const std::string& object, const std::string& name,
                                                std::size_t count) const {
  const Silence silence;
  const hdf5::Session& session = state_->session;
  const std::string place = object + "@" + name;
  auto values = hdf5::attribute_numbers(session, hdf5::open_attribute(session, object, name), place, count);
  if (values.size() != count) session.fail(place, fmt::format("must have {} values", count));
  return values;
}

bool Hdf5File::is_same(const std::string& path, const std::string& other) const {
  const Silence silence;
  return hdf5::is_same(state_->session, path, other);
}

std::map<std::string, double> Hdf5File::number_attributes(const std::string& object) const {
  const Silence silence;
  const hdf5::Session& session = state_->session;
  std::map<std::string, double> numbers;
  for (const std::string& name : hdf5::attribute_names(session, object)) {
    const std::string place = object + "@" + name;
    const Handle attribute = hdf5::open_attribute(session, object, name);
    const Handle type = session.own(H5Aget_type(attribute.get()), place);
    const H5T_class_t kind = H5Tget_class(type.get());
    if (kind != H5T_FLOAT && kind != H5T_INTEGER) continue;
    const auto values = hdf5::attribute_numbers(session, attribute, place, hdf5::kMostAttributeValues);
    if (values.size() == 1) numbers[name] = values.front();
  }
  return numbers;
}

std::vector<std::string> Hdf5File::top_objects() const {
  const Silence silence;
  return hdf5::children(state_->session, "/");
}

std::vector<std::string> Hdf5File::datasets(const std::string& object) const {
  const Silence silence;
  std::vector<std::string> objects = hdf5::tree(state_->session, object);
  std::erase_if(objects, [&](const std::string& path) { return !hdf5::is_dataset(state_->session, path); });
  std::sort(objects.begin(), objects.end());
  return objects;
}

std::string Hdf5File::text_sha256(const std::vector<std::string>& objects) const {
  const Silence silence;
  return hdf5::text_sha256(state_->session, objects);
}

std::string Hdf5File::sha256(const std::vector<std::string>& objects) const {
  const Silence silence;
  return hdf5::sha256(state_->session, objects);
}

std::string hdf5_version() {
  std::array<unsigned, 3> version{};
  H5get_libversion(&version[0], &version[1], &version[2]);
  return fmt::format("{}.{}.{}", version[0], version[1], version[2]);
}

}  // namespace indet
