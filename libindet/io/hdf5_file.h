#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "libindet/base/error.h"

namespace indet {

/// The file cannot be read: missing, damaged, or not laid out as expected.
class Hdf5ReadError : public InputError {
 public:
  using InputError::InputError;
};

/// The file cannot be written. Nothing is left of it.
class Hdf5WriteError : public LibraryError {
 public:
  using LibraryError::LibraryError;
};

using Shape = std::vector<std::size_t>;

/// The unit and the long_name that every dataset carries.
struct Label {
  std::string unit;  ///< "1" for pure numbers.
  std::string long_name;
};

/// The names of an enumeration, in the order of their values 0, 1, …
using EnumNames = std::vector<std::string>;

/// One HDF5 file, open for reading or being written. Paths of objects are absolute ("/ranges/R_min").
/// Errors become Hdf5ReadError and Hdf5WriteError with the file, the object and the message of the HDF5
/// library, whose own error stack stays silent. One thread at a time.
///
/// Writing: the file grows in memory, and commit() writes it as a WholeFile: one that exists is whole, and
/// one that was not committed leaves nothing behind. Datasets above 64 KiB are chunked, shuffled, deflated
/// and carry Fletcher-32 checksums.
///
/// Reading: nothing in the file is trusted. Type, rank and shape are compared with what the caller expects
/// and with the size of the file before memory is allocated; soft, external and virtual objects are refused.
class Hdf5File {
 public:
  static Hdf5File open(const std::filesystem::path& path);
  static Hdf5File create(const std::filesystem::path& path);
  Hdf5File(Hdf5File&&) noexcept;
  Hdf5File& operator=(Hdf5File&&) noexcept;
  ~Hdf5File();

  const std::filesystem::path& path() const;

  // Writing.
  void make_group(const std::string& path);
  void write(const std::string& path, std::span<const double> values, const Shape& shape, const Label& label);
  void write(const std::string& path, std::span<const std::int32_t> values, const Shape& shape,
             const Label& label);
  void write(const std::string& path, std::span<const std::int64_t> values, const Shape& shape,
             const Label& label);
  void write(const std::string& path, std::span<const std::uint8_t> values, const Shape& shape,
             const Label& label);
  void write_enum(const std::string& path, std::span<const std::uint8_t> values, const Shape& shape,
                  const EnumNames& names, const Label& label);
  void write_strings(const std::string& path, const std::vector<std::string>& values, const Label& label);
  void set_attribute(const std::string& object, const std::string& name, const std::string& value);
  void set_attribute(const std::string& object, const std::string& name, const char* value);
  void set_attribute(const std::string& object, const std::string& name,
                     const std::vector<std::string>& values);
  void set_attribute(const std::string& object, const std::string& name, double value);
  void set_attribute(const std::string& object, const std::string& name, std::int64_t value);
  void set_attribute(const std::string& object, const std::string& name, int value);
  void set_attribute(const std::string& object, const std::string& name, std::span<const double> values);
  void set_attribute(const std::string& object, const std::string& name,
                     std::span<const std::int64_t> values);
  /// Text of fixed length, in ASCII: other formats ask for it.
  void set_fixed_text(const std::string& object, const std::string& name, const std::string& value);
  /// A second name, `path`, for an object that is there.
  void link(const std::string& object, const std::string& path);
  /// The file takes its name; this object can only be destroyed afterwards. Throws LibraryError if writing
  /// fails (a full disk).
  void commit();

  // Reading.
  bool has(const std::string& path) const;
  /// The shape of a dataset, whose rank must be `rank`.
  Shape shape(const std::string& path, std::size_t rank) const;
  std::vector<double> read_doubles(const std::string& path, const Shape& shape) const;
  std::vector<std::int32_t> read_integers(const std::string& path, const Shape& shape) const;
  std::vector<std::int64_t> read_long_integers(const std::string& path, const Shape& shape) const;
  std::vector<std::uint8_t> read_bytes(const std::string& path, const Shape& shape) const;
  /// Also checks that the enumeration has these names, or the first of them, and that every value is one of
  /// them.
  std::vector<std::uint8_t> read_enum(const std::string& path, const Shape& shape,
                                      const EnumNames& names) const;
  std::vector<std::string> read_strings(const std::string& path, std::size_t count) const;
  bool has_attribute(const std::string& object, const std::string& name) const;
  std::string string_attribute(const std::string& object, const std::string& name) const;
  double double_attribute(const std::string& object, const std::string& name) const;
  std::int64_t integer_attribute(const std::string& object, const std::string& name) const;
  std::vector<double> doubles_attribute(const std::string& object, const std::string& name,
                                        std::size_t count) const;
  /// Whether two paths lead to one object.
  bool is_same(const std::string& path, const std::string& other) const;
  /// The attributes of an object that are single numbers.
  std::map<std::string, double> number_attributes(const std::string& object) const;

  /// The absolute paths of the objects directly below the root, sorted.
  std::vector<std::string> top_objects() const;
  /// The absolute paths of all datasets below an object (or the object itself), sorted.
  std::vector<std::string> datasets(const std::string& object) const;

  /// SHA-256 (64 hexadecimal digits) over all numbers below `objects`, as docs/file-format.md defines it.
  std::string sha256(const std::vector<std::string>& objects) const;
  /// The same over all texts there, and the attributes of the root but for its digests.
  std::string text_sha256(const std::vector<std::string>& objects) const;

 private:
  struct State;
  explicit Hdf5File(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// The version of the HDF5 library.
std::string hdf5_version();

}  // namespace indet
