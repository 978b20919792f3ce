#include "libindet/io/hdf5_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "libindet/io/sha256.h"
#include "libindet/io/whole_file.h"

namespace indet {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kCompressAbove = 64 * 1024;  // bytes
constexpr std::size_t kChunkBytes = 1024 * 1024;
constexpr std::size_t kDeflateRatio = 1100;  // deflate compresses 1032:1 at most
constexpr std::size_t kLongestString = 16 * 1024 * 1024;
constexpr int kDeepest = 8;  // levels of groups

/// Keeps the HDF5 library from printing its error stack while it lives.
class Silence {
 public:
  Silence() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// Owns one HDF5 identifier of any kind.
class Id {
 public:
  Id() = default;
  explicit Id(hid_t id) : id_(id) {}
  Id(Id&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
  Id& operator=(Id&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  Id(const Id&) = delete;
  Id& operator=(const Id&) = delete;
  ~Id() {
    if (id_ >= 0) H5Idec_ref(id_);
  }
  hid_t get() const { return id_; }
  hid_t release() { return std::exchange(id_, H5I_INVALID_HID); }

 private:
  hid_t id_ = H5I_INVALID_HID;
};

/// The innermost message of the error stack: the cause.
std::string library_message() {
  std::string message;
  const auto take_first = [](unsigned, const H5E_error2_t* error, void* data) -> herr_t {
    auto& text = *static_cast<std::string*>(data);
    if (text.empty() && error->desc != nullptr) text = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first, &message);
  H5Eclear2(H5E_DEFAULT);
  return message.empty() ? "unknown cause" : message;
}

/// The path of the object that holds `path`, and each object on the way to it, from the top.
std::vector<std::string> ancestors(const std::string& path) {
  std::vector<std::string> found;
  for (std::size_t slash = path.find('/', 1); slash != std::string::npos; slash = path.find('/', slash + 1)) {
    found.push_back(path.substr(0, slash));
  }
  return found;
}

void append_integer(std::vector<unsigned char>& bytes, std::int64_t value) {
  const auto bits = static_cast<std::uint64_t>(value);
  for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<unsigned char>(bits >> (8 * i)));
}

}  // namespace

struct Hdf5File::State {
  fs::path path;
  fs::path temporary;  ///< Empty when reading.
  Id file;
  std::size_t file_size = 0;

  [[noreturn]] void fail(const std::string& object, const std::string& reason) const {
    const std::string message = fmt::format("{}: {}: {}", path.string(), object, reason);
    if (temporary.empty()) throw Hdf5ReadError(message);
    throw Hdf5WriteError(message);
  }

  /// Turns a failed identifier into an exception.
  Id own(hid_t id, const std::string& object) const {
    if (id < 0) fail(object, library_message());
    return Id(id);
  }
  void check(herr_t status, const std::string& object) const {
    if (status < 0) fail(object, library_message());
  }

  // Types and spaces.

  Id string_type() const {
    Id type = own(H5Tcopy(H5T_C_S1), "text");
    check(H5Tset_size(type.get(), H5T_VARIABLE), "text");
    check(H5Tset_cset(type.get(), H5T_CSET_UTF8), "text");
    return type;
  }

  Id enum_type(const EnumNames& names, const std::string& path_of) const {
    Id type = own(H5Tenum_create(H5T_STD_U8LE), path_of);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto value = static_cast<std::uint8_t>(i);
      check(H5Tenum_insert(type.get(), names[i].c_str(), &value), path_of);
    }
    return type;
  }

  Id space(const Shape& shape) const {
    if (shape.empty()) return own(H5Screate(H5S_SCALAR), "shape");
    const std::vector<hsize_t> dims(shape.begin(), shape.end());
    return own(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), "shape");
  }

  // Writing.

  Id creation_properties(const Shape& shape, std::size_t item_size) const {
    Id properties = own(H5Pcreate(H5P_DATASET_CREATE), "properties");
    check(H5Pset_obj_track_times(properties.get(), false), "properties");
    std::size_t count = 1;
    for (const std::size_t extent : shape) count *= extent;
    if (count * item_size <= kCompressAbove) return properties;
    // Whole rows, as many as fit into a chunk; a row that does not is cut.
    std::vector<hsize_t> chunk(shape.begin(), shape.end());
    std::size_t bytes = count * item_size;
    for (hsize_t& extent : chunk) {
      const std::size_t below = bytes / extent;
      extent = std::clamp<hsize_t>(kChunkBytes / std::max<std::size_t>(below, 1), 1, extent);
      bytes = below;
      if (extent > 1) break;
    }
    check(H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()), "properties");
    check(H5Pset_shuffle(properties.get()), "properties");
    check(H5Pset_deflate(properties.get(), 4), "properties");
    check(H5Pset_fletcher32(properties.get()), "properties");
    return properties;
  }

  void write(const std::string& object, const void* values, std::size_t count, hid_t file_type,
             hid_t memory_type, std::size_t item_size, const Shape& shape, const Label& label) {
    std::size_t expected = 1;
    for (const std::size_t extent : shape) expected *= extent;
    if (count != expected) {
      fail(object, fmt::format("{} values do not fill the shape [{}]", count, fmt::join(shape, ", ")));
    }
    make_parents(object);
    const Id dataset = own(H5Dcreate2(file.get(), object.c_str(), file_type, space(shape).get(), H5P_DEFAULT,
                                      creation_properties(shape, item_size).get(), H5P_DEFAULT),
                           object);
    if (count > 0) {
      check(H5Dwrite(dataset.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), object);
    }
    set_strings(object, "unit", {label.unit}, true);
    set_strings(object, "long_name", {label.long_name}, true);
  }

  void make_group(const std::string& object) {
    const Id properties = own(H5Pcreate(H5P_GROUP_CREATE), object);
    check(H5Pset_obj_track_times(properties.get(), false), object);
    own(H5Gcreate2(file.get(), object.c_str(), H5P_DEFAULT, properties.get(), H5P_DEFAULT), object);
  }

  void make_parents(const std::string& object) {
    for (const std::string& parent : ancestors(object)) {
      if (H5Lexists(file.get(), parent.c_str(), H5P_DEFAULT) <= 0) make_group(parent);
    }
  }

  void set_raw(const std::string& object, const std::string& name, hid_t file_type, hid_t memory_type,
               const Shape& shape, const void* values) {
    const std::string place = object + "@" + name;
    const Id holder = own(H5Oopen(file.get(), object.c_str(), H5P_DEFAULT), object);
    const Id attribute =
        own(H5Acreate2(holder.get(), name.c_str(), file_type, space(shape).get(), H5P_DEFAULT, H5P_DEFAULT),
            place);
    if (H5Aget_storage_size(attribute.get()) == 0) return;
    check(H5Awrite(attribute.get(), memory_type, values), place);
  }

  void set_strings(const std::string& object, const std::string& name, const std::vector<std::string>& values,
                   bool scalar) {
    std::vector<const char*> pointers;
    for (const std::string& value : values) pointers.push_back(value.c_str());
    const Id type = string_type();
    set_raw(object, name, type.get(), type.get(), scalar ? Shape{} : Shape{values.size()}, pointers.data());
  }

  // Reading.

  /// Every link on the way must be a hard one: others lead out of the file or in circles.
  bool exists(const std::string& object) const {
    if (object == "/") return true;
    std::vector<std::string> links = ancestors(object);
    links.push_back(object);
    for (const std::string& link : links) {
      if (H5Lexists(file.get(), link.c_str(), H5P_DEFAULT) <= 0) return false;
      H5L_info_t info;
      check(H5Lget_info(file.get(), link.c_str(), &info, H5P_DEFAULT), link);
      if (info.type != H5L_TYPE_HARD) fail(link, "is a link to elsewhere, which is not followed");
    }
    return true;
  }

  Id open_object(const std::string& object) const {
    if (!exists(object)) fail(object, "is missing");
    return own(H5Oopen(file.get(), object.c_str(), H5P_DEFAULT), object);
  }

  Id open_dataset(const std::string& object) const {
    Id dataset = open_object(object);
    if (H5Iget_type(dataset.get()) != H5I_DATASET) fail(object, "is not a dataset");
    return dataset;
  }

  Shape extent(hid_t space_id, const std::string& object) const {
    if (H5Sget_simple_extent_type(space_id) == H5S_NULL) fail(object, "is empty");
    const int rank = H5Sget_simple_extent_ndims(space_id);
    check(rank, object);
    std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
    check(H5Sget_simple_extent_dims(space_id, dims.data(), nullptr), object);
    return {dims.begin(), dims.end()};
  }

  /// Throws unless what the header announces can come out of a file of this size.
  void check_storage(hid_t dataset, const Shape& shape, const std::string& object) const {
    if (!temporary.empty()) return;  // our own data, part of them not in the file yet
    const Id type = own(H5Dget_type(dataset), object);
    const Id properties = own(H5Dget_create_plist(dataset), object);
    std::size_t bytes = H5Tget_size(type.get());
    for (const std::size_t size : shape) {
      if (__builtin_mul_overflow(bytes, size, &bytes)) fail(object, "announces an impossible size");
    }
    if (H5Pget_external_count(properties.get()) != 0) fail(object, "keeps its data in another file");
    bool deflated = false;
    const int filters = H5Pget_nfilters(properties.get());
    for (int i = 0; i < filters; ++i) {
      unsigned flags = 0;
      std::size_t values = 0;
      const H5Z_filter_t filter = H5Pget_filter2(properties.get(), static_cast<unsigned>(i), &flags, &values,
                                                 nullptr, 0, nullptr, nullptr);
      if (filter != H5Z_FILTER_SHUFFLE && filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_FLETCHER32) {
        fail(object, fmt::format("uses filter {}, which is not supported", filter));
      }
      deflated = deflated || filter == H5Z_FILTER_DEFLATE;
    }
    const std::size_t stored = H5Dget_storage_size(dataset);
    const H5D_layout_t layout = H5Pget_layout(properties.get());
    if (layout != H5D_COMPACT && layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED) {
      fail(object, "is a virtual dataset, which is not supported");
    }
    if (layout == H5D_CHUNKED) {
      std::vector<hsize_t> chunk(shape.size());
      check(H5Pget_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()), object);
      for (std::size_t i = 0; i < chunk.size(); ++i) {
        if (chunk[i] > std::max<std::size_t>(shape[i], 1)) fail(object, "has chunks larger than itself");
      }
    }
    const std::size_t ratio = deflated ? kDeflateRatio : 1;
    if (stored > file_size || bytes / ratio > stored) {
      fail(object, fmt::format("announces {} bytes, but the file of {} bytes stores {} for it", bytes,
                               file_size, stored));
    }
  }

  /// Opens a dataset that must have this class of type and this shape.
  Id open_checked(const std::string& object, H5T_class_t expected, const char* class_name,
                  std::size_t largest_item, const Shape& shape) const {
    Id dataset = open_dataset(object);
    const Id type = own(H5Dget_type(dataset.get()), object);
    if (H5Tget_class(type.get()) != expected || H5Tget_size(type.get()) > largest_item) {
      fail(object, fmt::format("must hold {}", class_name));
    }
    const Id data_space = own(H5Dget_space(dataset.get()), object);
    const Shape found = extent(data_space.get(), object);
    if (found != shape) {
      fail(object,
           fmt::format("has shape [{}] instead of [{}]", fmt::join(found, ", "), fmt::join(shape, ", ")));
    }
    check_storage(dataset.get(), shape, object);
    return dataset;
  }

  template <class T>
  std::vector<T> read_all(const Id& dataset, hid_t memory_type, const Shape& shape,
                          const std::string& object) const {
    std::size_t count = 1;
    for (const std::size_t size : shape) count *= size;
    std::vector<T> values(count);
    if (count > 0) {
      check(H5Dread(dataset.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), object);
    }
    return values;
  }

  Id open_attribute(const std::string& object, const std::string& name) const {
    const Id holder = open_object(object);
    if (H5Aexists(holder.get(), name.c_str()) <= 0) fail(object + "@" + name, "is missing");
    return own(H5Aopen(holder.get(), name.c_str(), H5P_DEFAULT), object + "@" + name);
  }

  /// An attribute of numbers with at most `most` of them.
  std::vector<double> attribute_numbers(const Id& attribute, const std::string& place,
                                        std::size_t most) const {
    const Id type = own(H5Aget_type(attribute.get()), place);
    const H5T_class_t kind = H5Tget_class(type.get());
    if (kind != H5T_FLOAT && kind != H5T_INTEGER) fail(place, "must be a number");
    std::vector<double> values(attribute_count(attribute, place, most));
    check(H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, values.data()), place);
    return values;
  }

  std::size_t attribute_count(const Id& attribute, const std::string& place, std::size_t most) const {
    const Id data_space = own(H5Aget_space(attribute.get()), place);
    std::size_t count = 1;
    for (const std::size_t size : extent(data_space.get(), place)) {
      if (__builtin_mul_overflow(count, size, &count) || count > most) fail(place, "has too many values");
    }
    return count;
  }

  std::vector<std::string> attribute_names(const std::string& object) const {
    const Id holder = open_object(object);
    std::vector<std::string> names;
    const auto collect = [](hid_t, const char* name, const H5A_info_t*, void* data) -> herr_t {
      static_cast<std::vector<std::string>*>(data)->emplace_back(name);
      return 0;
    };
    hsize_t position = 0;
    check(H5Aiterate2(holder.get(), H5_INDEX_NAME, H5_ITER_INC, &position, collect, &names), object);
    return names;
  }

  std::vector<std::string> children(const std::string& group) const {
    const Id holder = open_object(group);
    if (H5Iget_type(holder.get()) != H5I_GROUP) return {};
    std::vector<std::string> names;
    const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* data) -> herr_t {
      static_cast<std::vector<std::string>*>(data)->emplace_back(name);
      return 0;
    };
    hsize_t position = 0;
    check(H5Literate(holder.get(), H5_INDEX_NAME, H5_ITER_INC, &position, collect, &names), group);
    for (std::string& name : names) name = (group == "/" ? "/" : group + "/") + name;
    std::sort(names.begin(), names.end());
    return names;
  }

  /// `object` and everything below it.
  void collect_objects(const std::string& object, int depth, std::vector<std::string>& found) const {
    if (depth > kDeepest) fail(object, "the groups are nested too deeply");
    found.push_back(object);
    for (const std::string& child : children(object)) collect_objects(child, depth + 1, found);
  }

  bool is_dataset(const std::string& object) const {
    return H5Iget_type(open_object(object).get()) == H5I_DATASET;
  }

  void hash_values(Sha256& hash, const std::string& key, const Shape& shape, const std::vector<double>& reals,
                   const std::vector<std::int64_t>& integers) const {
    std::vector<unsigned char> bytes(key.begin(), key.end());
    bytes.push_back(0);
    append_integer(bytes, static_cast<std::int64_t>(shape.size()));
    for (const std::size_t size : shape) append_integer(bytes, static_cast<std::int64_t>(size));
    for (const double value : reals) append_integer(bytes, std::bit_cast<std::int64_t>(value));
    for (const std::int64_t value : integers) append_integer(bytes, value);
    hash.update(bytes.data(), bytes.size());
  }

  void hash_dataset(Sha256& hash, const std::string& object) const {
    const Id dataset = open_dataset(object);
    const Id type = own(H5Dget_type(dataset.get()), object);
    const Id data_space = own(H5Dget_space(dataset.get()), object);
    const Shape shape = extent(data_space.get(), object);
    const H5T_class_t kind = H5Tget_class(type.get());
    if (kind == H5T_STRING) return;
    check_storage(dataset.get(), shape, object);
    if (kind == H5T_FLOAT) {
      hash_values(hash, object, shape, read_all<double>(dataset, H5T_NATIVE_DOUBLE, shape, object), {});
    } else if (kind == H5T_INTEGER) {
      hash_values(hash, object, shape, {}, read_all<std::int64_t>(dataset, H5T_NATIVE_INT64, shape, object));
    } else if (kind == H5T_ENUM && H5Tget_size(type.get()) == 1) {
      const auto bytes = read_all<std::uint8_t>(dataset, type.get(), shape, object);
      hash_values(hash, object, shape, {}, {bytes.begin(), bytes.end()});
    } else {
      fail(object, "has a type that indet does not write");
    }
  }

  void hash_attribute(Sha256& hash, const std::string& object, const std::string& name) const {
    const std::string place = object + "@" + name;
    const Id attribute = open_attribute(object, name);
    const Id type = own(H5Aget_type(attribute.get()), place);
    const Id data_space = own(H5Aget_space(attribute.get()), place);
    const H5T_class_t kind = H5Tget_class(type.get());
    const std::size_t count = attribute_count(attribute, place, kCompressAbove);
    if (kind == H5T_FLOAT) {
      hash_values(hash, place, extent(data_space.get(), place), attribute_numbers(attribute, place, count),
                  {});
    } else if (kind == H5T_INTEGER) {
      std::vector<std::int64_t> values(count);
      check(H5Aread(attribute.get(), H5T_NATIVE_INT64, values.data()), place);
      hash_values(hash, place, extent(data_space.get(), place), {}, values);
    }
  }
};

namespace {

/// Writes into a file that exists, and syncs it; 0, or the error number.
int write_synced(const fs::path& path, std::span<const unsigned char> bytes) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  if (descriptor < 0) return errno;
  int error = 0;
  while (!bytes.empty() && error == 0) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      error = errno;
    }
  }
  if (error == 0 && ::fsync(descriptor) != 0) error = errno;
  if (::close(descriptor) != 0 && error == 0) error = errno;
  return error;
}

}  // namespace

Hdf5File::Hdf5File(std::unique_ptr<State> state) : state_(std::move(state)) {}
Hdf5File::Hdf5File(Hdf5File&&) noexcept = default;
Hdf5File& Hdf5File::operator=(Hdf5File&&) noexcept = default;

Hdf5File::~Hdf5File() {
  if (!state_ || state_->temporary.empty()) return;
  const Silence silence;
  state_->file = Id();
  std::error_code ignored;
  fs::remove(state_->temporary, ignored);
}

Hdf5File Hdf5File::open(const fs::path& path) {
  const Silence silence;
  auto state = std::make_unique<State>();
  state->path = path;
  std::error_code error;
  if (!fs::exists(path, error)) throw Hdf5ReadError(fmt::format("{}: there is no such file", path.string()));
  if (!fs::is_regular_file(path, error)) throw Hdf5ReadError(fmt::format("{}: is not a file", path.string()));
  state->file_size = static_cast<std::size_t>(fs::file_size(path, error));
  const Id access = state->own(H5Pcreate(H5P_FILE_ACCESS), "access");
  state->check(H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG), "access");
  // A read-only file system cannot lock.
  state->check(H5Pset_file_locking(access.get(), true, true), "access");
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get());
  if (file < 0) {
    throw Hdf5ReadError(
        fmt::format("{}: cannot be opened as an HDF5 file ({})", path.string(), library_message()));
  }
  state->file = Id(file);
  return Hdf5File(std::move(state));
}

Hdf5File Hdf5File::create(const fs::path& path) {
  const Silence silence;
  auto state = std::make_unique<State>();
  state->path = path;
  std::error_code ignored;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored)) {
    throw InputError(fmt::format("{}: the folder {} does not exist", path.string(), folder.string()));
  }
  if (!path.has_filename() || fs::is_directory(path, ignored)) {
    throw InputError(fmt::format("{}: is a folder; a file can only be written beside it", path.string()));
  }
  const fs::path temporary = temporary_name(path);
  const Id creation = state->own(H5Pcreate(H5P_FILE_CREATE), "properties");
  state->check(H5Pset_obj_track_times(creation.get(), false), "properties");
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    throw InputError(
        fmt::format("{}: cannot be written ({})", path.string(), std::generic_category().message(errno)));
  }
  ::close(descriptor);
  state->temporary = temporary;
  // The file grows in memory and is written in one piece by commit(): when a write of its own fails (a full
  // disk), HDF5 1.10 leaves a file that it cannot close, and crashes as the process ends.
  constexpr std::size_t kGrowth = 1U << 20U;
  const Id access = state->own(H5Pcreate(H5P_FILE_ACCESS), "access");
  state->check(H5Pset_fapl_core(access.get(), kGrowth, false), "access");
  const hid_t file = H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, creation.get(), access.get());
  if (file < 0) state->fail("create", library_message());
  state->file = Id(file);
  return Hdf5File(std::move(state));
}

const fs::path& Hdf5File::path() const { return state_->path; }

void Hdf5File::make_group(const std::string& path) {
  const Silence silence;
  state_->make_parents(path);
  state_->make_group(path);
}

void Hdf5File::write(const std::string& path, std::span<const double> values, const Shape& shape,
                     const Label& label) {
  const Silence silence;
  state_->write(path, values.data(), values.size(), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 8, shape, label);
}

void Hdf5File::write(const std::string& path, std::span<const std::int32_t> values, const Shape& shape,
                     const Label& label) {
  const Silence silence;
  state_->write(path, values.data(), values.size(), H5T_STD_I32LE, H5T_NATIVE_INT32, 4, shape, label);
}

void Hdf5File::write(const std::string& path, std::span<const std::uint8_t> values, const Shape& shape,
                     const Label& label) {
  const Silence silence;
  state_->write(path, values.data(), values.size(), H5T_STD_U8LE, H5T_NATIVE_UINT8, 1, shape, label);
}

void Hdf5File::write_enum(const std::string& path, std::span<const std::uint8_t> values, const Shape& shape,
                          const EnumNames& names, const Label& label) {
  const Silence silence;
  const Id type = state_->enum_type(names, path);
  state_->write(path, values.data(), values.size(), type.get(), type.get(), 1, shape, label);
}

void Hdf5File::write_strings(const std::string& path, const std::vector<std::string>& values,
                             const Label& label) {
  const Silence silence;
  const Id type = state_->string_type();
  std::vector<const char*> pointers;
  for (const std::string& value : values) pointers.push_back(value.c_str());
  state_->write(path, static_cast<const void*>(pointers.data()), values.size(), type.get(), type.get(), 1,
                {values.size()}, label);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, const std::string& value) {
  const Silence silence;
  state_->set_strings(object, name, {value}, true);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, const char* value) {
  set_attribute(object, name, std::string(value));
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             const std::vector<std::string>& values) {
  const Silence silence;
  state_->set_strings(object, name, values, false);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, double value) {
  const Silence silence;
  state_->set_raw(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {}, &value);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, std::int64_t value) {
  const Silence silence;
  state_->set_raw(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, {}, &value);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, int value) {
  set_attribute(object, name, static_cast<std::int64_t>(value));
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             std::span<const double> values) {
  const Silence silence;
  state_->set_raw(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {values.size()}, values.data());
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name,
                             std::span<const std::int64_t> values) {
  const Silence silence;
  state_->set_raw(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, {values.size()}, values.data());
}

void Hdf5File::commit() {
  const Silence silence;
  state_->check(H5Fflush(state_->file.get(), H5F_SCOPE_GLOBAL), "flush");
  const ssize_t size = H5Fget_file_image(state_->file.get(), nullptr, 0);
  if (size < 0) state_->fail("flush", library_message());
  std::vector<unsigned char> image(static_cast<std::size_t>(size));
  if (H5Fget_file_image(state_->file.get(), image.data(), image.size()) != size)
    state_->fail("flush", library_message());
  state_->check(H5Fclose(state_->file.release()), "close");
  const int reason = write_synced(state_->temporary, image);
  if (reason != 0) state_->fail("write", std::generic_category().message(reason));
  std::error_code error;
  fs::rename(state_->temporary, state_->path, error);
  if (error) state_->fail("rename", error.message());
  state_->temporary.clear();
  const fs::path folder = state_->path.has_parent_path() ? state_->path.parent_path() : fs::path(".");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool good = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int problem = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!good) state_->fail("sync", std::generic_category().message(problem));
}

bool Hdf5File::has(const std::string& path) const {
  const Silence silence;
  return state_->exists(path);
}

Shape Hdf5File::shape(const std::string& path, std::size_t rank) const {
  const Silence silence;
  const Id dataset = state_->open_dataset(path);
  const Id space = state_->own(H5Dget_space(dataset.get()), path);
  const Shape found = state_->extent(space.get(), path);
  if (found.size() != rank) {
    state_->fail(path, fmt::format("has rank {} instead of {}", found.size(), rank));
  }
  state_->check_storage(dataset.get(), found, path);
  return found;
}

std::vector<double> Hdf5File::read_doubles(const std::string& path, const Shape& shape) const {
  const Silence silence;
  const Id dataset = state_->open_checked(path, H5T_FLOAT, "floating-point numbers", 8, shape);
  return state_->read_all<double>(dataset, H5T_NATIVE_DOUBLE, shape, path);
}

std::vector<std::int32_t> Hdf5File::read_integers(const std::string& path, const Shape& shape) const {
  const Silence silence;
  const Id dataset = state_->open_checked(path, H5T_INTEGER, "integers of 32 bits", 4, shape);
  return state_->read_all<std::int32_t>(dataset, H5T_NATIVE_INT32, shape, path);
}

std::vector<std::uint8_t> Hdf5File::read_bytes(const std::string& path, const Shape& shape) const {
  const Silence silence;
  const Id dataset = state_->open_checked(path, H5T_INTEGER, "integers of 8 bits", 1, shape);
  return state_->read_all<std::uint8_t>(dataset, H5T_NATIVE_UINT8, shape, path);
}

std::vector<std::uint8_t> Hdf5File::read_enum(const std::string& path, const Shape& shape,
                                              const EnumNames& names) const {
  const Silence silence;
  const Id dataset = state_->open_checked(path, H5T_ENUM, "an enumeration", 1, shape);
  const Id found = state_->own(H5Dget_type(dataset.get()), path);
  const Id expected = state_->enum_type(names, path);
  if (H5Tequal(found.get(), expected.get()) <= 0) {
    state_->fail(path, fmt::format("must be an enumeration of {}", fmt::join(names, ", ")));
  }
  auto values = state_->read_all<std::uint8_t>(dataset, expected.get(), shape, path);
  for (const std::uint8_t value : values) {
    if (value >= names.size()) state_->fail(path, fmt::format("holds {}, which has no name", value));
  }
  return values;
}

std::vector<std::string> Hdf5File::read_strings(const std::string& path, std::size_t count) const {
  const Silence silence;
  const Id dataset = state_->open_checked(path, H5T_STRING, "text", 64, {count});
  const Id found = state_->own(H5Dget_type(dataset.get()), path);
  if (H5Tis_variable_str(found.get()) <= 0) state_->fail(path, "must hold text of variable length");
  const Id type = state_->string_type();
  const Id space = state_->own(H5Dget_space(dataset.get()), path);
  std::vector<char*> pointers = state_->read_all<char*>(dataset, type.get(), {count}, path);
  std::vector<std::string> values;
  for (const char* pointer : pointers) values.emplace_back(pointer == nullptr ? "" : pointer);
  H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, static_cast<void*>(pointers.data()));
  return values;
}

bool Hdf5File::has_attribute(const std::string& object, const std::string& name) const {
  const Silence silence;
  return state_->exists(object) && H5Aexists(state_->open_object(object).get(), name.c_str()) > 0;
}

std::string Hdf5File::string_attribute(const std::string& object, const std::string& name) const {
  const Silence silence;
  const std::string place = object + "@" + name;
  const Id attribute = state_->open_attribute(object, name);
  const Id found = state_->own(H5Aget_type(attribute.get()), place);
  if (H5Tget_class(found.get()) != H5T_STRING) state_->fail(place, "must be text");
  if (state_->attribute_count(attribute, place, 1) != 1) state_->fail(place, "must be one text");
  if (H5Tis_variable_str(found.get()) > 0) {
    const Id type = state_->string_type();
    char* pointer = nullptr;
    state_->check(H5Aread(attribute.get(), type.get(), static_cast<void*>(&pointer)), place);
    const std::string value = pointer == nullptr ? "" : pointer;
    H5free_memory(pointer);
    return value;
  }
  const std::size_t size = H5Tget_size(found.get());
  if (size > std::min(kLongestString, state_->file_size)) state_->fail(place, "is too long");
  std::string value(size, '\0');
  state_->check(H5Aread(attribute.get(), found.get(), value.data()), place);
  value.resize(std::strlen(value.c_str()));
  return value;
}

double Hdf5File::double_attribute(const std::string& object, const std::string& name) const {
  return doubles_attribute(object, name, 1).front();
}

std::int64_t Hdf5File::integer_attribute(const std::string& object, const std::string& name) const {
  const Silence silence;
  const std::string place = object + "@" + name;
  const Id attribute = state_->open_attribute(object, name);
  const Id type = state_->own(H5Aget_type(attribute.get()), place);
  if (H5Tget_class(type.get()) != H5T_INTEGER) state_->fail(place, "must be an integer");
  if (state_->attribute_count(attribute, place, 1) != 1) state_->fail(place, "must be one number");
  std::int64_t value = 0;
  state_->check(H5Aread(attribute.get(), H5T_NATIVE_INT64, &value), place);
  return value;
}

std::vector<double> Hdf5File::doubles_attribute(const std::string& object, const std::string& name,
                                                std::size_t count) const {
  const Silence silence;
  const std::string place = object + "@" + name;
  auto values = state_->attribute_numbers(state_->open_attribute(object, name), place, count);
  if (values.size() != count) state_->fail(place, fmt::format("must have {} values", count));
  return values;
}

std::map<std::string, double> Hdf5File::number_attributes(const std::string& object) const {
  const Silence silence;
  std::map<std::string, double> numbers;
  for (const std::string& name : state_->attribute_names(object)) {
    const Id attribute = state_->open_attribute(object, name);
    const Id type = state_->own(H5Aget_type(attribute.get()), object + "@" + name);
    const H5T_class_t kind = H5Tget_class(type.get());
    if (kind != H5T_FLOAT && kind != H5T_INTEGER) continue;
    const auto values = state_->attribute_numbers(attribute, object + "@" + name, kCompressAbove);
    if (values.size() == 1) numbers[name] = values.front();
  }
  return numbers;
}

std::vector<std::string> Hdf5File::top_objects() const {
  const Silence silence;
  return state_->children("/");
}

std::vector<std::string> Hdf5File::datasets(const std::string& object) const {
  const Silence silence;
  std::vector<std::string> objects;
  state_->collect_objects(object, 0, objects);
  std::erase_if(objects, [&](const std::string& path) { return !state_->is_dataset(path); });
  std::sort(objects.begin(), objects.end());
  return objects;
}

std::string Hdf5File::sha256(const std::vector<std::string>& roots) const {
  const Silence silence;
  std::vector<std::string> objects;
  for (const std::string& root : roots) state_->collect_objects(root, 0, objects);
  std::vector<std::pair<std::string, std::string>> items;  // object, attribute ("" for the data)
  for (const std::string& object : objects) {
    if (state_->is_dataset(object)) items.emplace_back(object, "");
    for (const std::string& name : state_->attribute_names(object)) items.emplace_back(object, name);
  }
  const auto key = [](const std::pair<std::string, std::string>& item) {
    return item.second.empty() ? item.first : item.first + "@" + item.second;
  };
  std::sort(items.begin(), items.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  Sha256 hash;
  for (const auto& [object, attribute] : items) {
    if (attribute.empty()) {
      state_->hash_dataset(hash, object);
    } else {
      state_->hash_attribute(hash, object, attribute);
    }
  }
  return hash.hex();
}

std::string hdf5_version() {
  std::array<unsigned, 3> version{};
  H5get_libversion(&version[0], &version[1], &version[2]);
  return fmt::format("{}.{}.{}", version[0], version[1], version[2]);
}

}  // namespace indet
