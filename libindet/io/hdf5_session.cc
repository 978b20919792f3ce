#include "libindet/io/hdf5_session.h"

#include <fmt/format.h>

#include <functional>
#include <numeric>
#include <vector>

namespace indet::hdf5 {

Silence::Silence() {
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Silence::~Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

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

void Session::fail(const std::string& object, const std::string& reason) const {
  const std::string message = fmt::format("{}: {}: {}", path.string(), object, reason);
  if (is_written) throw Hdf5WriteError(message);
  throw Hdf5ReadError(message);
}

Handle Session::own(hid_t id, const std::string& object) const {
  if (id < 0) fail(object, library_message());
  return Handle(id);
}

void Session::check(herr_t status, const std::string& object) const {
  if (status < 0) fail(object, library_message());
}

Handle Session::string_type() const {
  Handle type = own(H5Tcopy(H5T_C_S1), "text");
  check(H5Tset_size(type.get(), H5T_VARIABLE), "text");
  check(H5Tset_cset(type.get(), H5T_CSET_UTF8), "text");
  return type;
}

Handle Session::enum_type(const EnumNames& names, const std::string& object) const {
  Handle type = own(H5Tenum_create(H5T_STD_U8LE), object);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto value = static_cast<std::uint8_t>(i);
    check(H5Tenum_insert(type.get(), names[i].c_str(), &value), object);
  }
  return type;
}

Handle Session::space(const Shape& shape) const {
  if (shape.empty()) return own(H5Screate(H5S_SCALAR), "shape");
  const std::vector<hsize_t> dims(shape.begin(), shape.end());
  return own(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), "shape");
}

std::size_t item_count(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

}  // namespace indet::hdf5
