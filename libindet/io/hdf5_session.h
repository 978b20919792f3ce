#pragma once

#include <hdf5.h>

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <utility>

#include "libindet/io/hdf5_file.h"

/// The HDF5 library behind Hdf5File. Only the files that implement Hdf5File include this header.
namespace indet::hdf5 {

/// Keeps the HDF5 library from printing its error stack while it lives.
class Silence {
 public:
  Silence();
  ~Silence();
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// Owns one HDF5 identifier of any kind.
class Handle {
 public:
  Handle() = default;
  explicit Handle(hid_t id) : id_(id) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) H5Idec_ref(id_);
  }
  hid_t get() const { return id_; }
  /// Another owner of the same identifier.
  Handle share() const {
    H5Iinc_ref(id_);
    return Handle(id_);
  }
  hid_t release() { return std::exchange(id_, H5I_INVALID_HID); }

 private:
  hid_t id_ = H5I_INVALID_HID;
};

/// The innermost message of the error stack: the cause. Clears the stack.
std::string library_message();

/// One open file. What calls return becomes a Handle, or an exception that names the file and the object.
struct Session {
  std::filesystem::path path;
  bool is_written = false;  ///< Failures are Hdf5WriteError; else Hdf5ReadError.
  Handle file;
  std::size_t file_size = 0;  ///< Bytes, of a file that is read.
  /// Paths that are hard links. To follow one from the root takes the library longer than to read a number.
  mutable std::set<std::string> known;
  /// The object that was opened last: its attributes are read one after the other.
  mutable std::string last_path;
  mutable Handle last;

  [[noreturn]] void fail(const std::string& object, const std::string& reason) const;
  Handle own(hid_t id, const std::string& object) const;
  void check(herr_t status, const std::string& object) const;

  Handle string_type() const;  ///< UTF-8 of variable length.
  Handle enum_type(const EnumNames& names, const std::string& object) const;
  Handle space(const Shape& shape) const;  ///< A scalar if `shape` is empty.
};

std::size_t item_count(const Shape& shape);

}  // namespace indet::hdf5
