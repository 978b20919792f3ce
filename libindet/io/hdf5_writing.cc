#include "libindet/io/hdf5_writing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "libindet/io/hdf5_guard.h"

namespace indet::hdf5 {
namespace {

constexpr std::size_t kCompressAbove = 64 * 1024;  // bytes
constexpr std::size_t kChunkBytes = 1024 * 1024;

Handle creation_properties(const Session& session, const Shape& shape, std::size_t item_size) {
  Handle properties = session.own(H5Pcreate(H5P_DATASET_CREATE), "properties");
  session.check(H5Pset_obj_track_times(properties.get(), false), "properties");
  std::size_t bytes = item_count(shape) * item_size;
  if (bytes <= kCompressAbove) return properties;
  // Whole rows, as many as fit into a chunk; a row that does not is cut.
  std::vector<hsize_t> chunk(shape.begin(), shape.end());
  for (hsize_t& extent : chunk) {
    const std::size_t below = bytes / extent;
    extent = std::clamp<hsize_t>(kChunkBytes / std::max<std::size_t>(below, 1), 1, extent);
    bytes = below;
    if (extent > 1) break;
  }
  session.check(H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()), "properties");
  session.check(H5Pset_shuffle(properties.get()), "properties");
  session.check(H5Pset_deflate(properties.get(), 4), "properties");
  session.check(H5Pset_fletcher32(properties.get()), "properties");
  return properties;
}

void set_strings(const Session& session, const std::string& object, const std::string& name,
                 const std::vector<std::string>& values, const Shape& shape) {
  std::vector<const char*> pointers;
  for (const std::string& value : values) pointers.push_back(value.c_str());
  const Handle type = session.string_type();
  set_raw(session, object, name, type.get(), type.get(), shape, pointers.data());
}

}  // namespace

void make_group(const Session& session, const std::string& object) {
  const Handle properties = session.own(H5Pcreate(H5P_GROUP_CREATE), object);
  session.check(H5Pset_obj_track_times(properties.get(), false), object);
  session.own(H5Gcreate2(session.file.get(), object.c_str(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
              object);
}

void make_parents(const Session& session, const std::string& object) {
  for (const std::string& parent : ancestors(object)) {
    if (H5Lexists(session.file.get(), parent.c_str(), H5P_DEFAULT) <= 0) make_group(session, parent);
  }
}

void write(const Session& session, const std::string& object, const void* values, std::size_t count,
           const ItemType& type, const Shape& shape, const Label& label) {
  if (count != item_count(shape)) {
    session.fail(object, fmt::format("{} values do not fill the shape [{}]", count, fmt::join(shape, ", ")));
  }
  make_parents(session, object);
  const Handle dataset =
      session.own(H5Dcreate2(session.file.get(), object.c_str(), type.in_file, session.space(shape).get(),
                             H5P_DEFAULT, creation_properties(session, shape, type.size).get(), H5P_DEFAULT),
                  object);
  if (count > 0) {
    session.check(H5Dwrite(dataset.get(), type.in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), object);
  }
  set_text(session, object, "unit", label.unit);
  set_text(session, object, "long_name", label.long_name);
}

void set_raw(const Session& session, const std::string& object, const std::string& name, hid_t file_type,
             hid_t memory_type, const Shape& shape, const void* values) {
  const std::string place = object + "@" + name;
  const Handle holder = session.own(H5Oopen(session.file.get(), object.c_str(), H5P_DEFAULT), object);
  const Handle attribute = session.own(
      H5Acreate2(holder.get(), name.c_str(), file_type, session.space(shape).get(), H5P_DEFAULT, H5P_DEFAULT),
      place);
  if (H5Aget_storage_size(attribute.get()) == 0) return;
  session.check(H5Awrite(attribute.get(), memory_type, values), place);
}

void set_text(const Session& session, const std::string& object, const std::string& name,
              const std::string& value) {
  set_strings(session, object, name, {value}, {});
}

void set_texts(const Session& session, const std::string& object, const std::string& name,
               const std::vector<std::string>& values) {
  set_strings(session, object, name, values, {values.size()});
}

void set_fixed_text(const Session& session, const std::string& object, const std::string& name,
                    const std::string& value) {
  const Handle type = session.own(H5Tcopy(H5T_C_S1), object);
  session.check(H5Tset_size(type.get(), value.size()), object);
  session.check(H5Tset_strpad(type.get(), H5T_STR_NULLPAD), object);
  set_raw(session, object, name, type.get(), type.get(), {}, value.data());
}

void link(const Session& session, const std::string& object, const std::string& path) {
  make_parents(session, path);
  session.check(H5Lcreate_hard(session.file.get(), object.c_str(), session.file.get(), path.c_str(),
                               H5P_DEFAULT, H5P_DEFAULT),
                path);
}

std::vector<unsigned char> close_to_bytes(Session& session) {
  session.last_path.clear();
  session.last = Handle();
  session.check(H5Fflush(session.file.get(), H5F_SCOPE_GLOBAL), "flush");
  const ssize_t size = H5Fget_file_image(session.file.get(), nullptr, 0);
  if (size < 0) session.fail("flush", library_message());
  std::vector<unsigned char> bytes(static_cast<std::size_t>(size));
  if (H5Fget_file_image(session.file.get(), bytes.data(), bytes.size()) != size) {
    session.fail("flush", library_message());
  }
  session.check(H5Fclose(session.file.release()), "close");
  return bytes;
}

}  // namespace indet::hdf5
