#include "libindet/io/hdf5_guard.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>

namespace indet::hdf5 {
namespace {

constexpr std::size_t kDeflateRatio = 1100;  // deflate compresses 1032:1 at most
constexpr std::size_t kLongestString = 16 * 1024 * 1024;
constexpr int kDeepest = 8;  // levels of groups

/// Whether the data are deflated; filters that indet does not use are refused.
bool check_filters(const Session& session, const Handle& properties, const std::string& object) {
  bool deflated = false;
  const int filters = H5Pget_nfilters(properties.get());
  for (int i = 0; i < filters; ++i) {
    unsigned flags = 0;
    std::size_t values = 0;
    const H5Z_filter_t filter = H5Pget_filter2(properties.get(), static_cast<unsigned>(i), &flags, &values,
                                               nullptr, 0, nullptr, nullptr);
    if (filter != H5Z_FILTER_SHUFFLE && filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_FLETCHER32) {
      session.fail(object, fmt::format("uses filter {}, which is not supported", filter));
    }
    deflated = deflated || filter == H5Z_FILTER_DEFLATE;
  }
  return deflated;
}

void check_chunks(const Session& session, const Handle& properties, const Shape& shape,
                  const std::string& object) {
  std::vector<hsize_t> chunk(shape.size());
  session.check(H5Pget_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()), object);
  for (std::size_t i = 0; i < chunk.size(); ++i) {
    if (chunk[i] > std::max<std::size_t>(shape[i], 1)) {
      session.fail(object, "has chunks larger than itself");
    }
  }
}

void collect(const Session& session, const std::string& object, int depth, std::vector<std::string>& found) {
  if (depth > kDeepest) session.fail(object, "the groups are nested too deeply");
  found.push_back(object);
  for (const std::string& child : children(session, object)) collect(session, child, depth + 1, found);
}

}  // namespace

std::vector<std::string> ancestors(const std::string& path) {
  std::vector<std::string> found;
  for (std::size_t slash = path.find('/', 1); slash != std::string::npos; slash = path.find('/', slash + 1)) {
    found.push_back(path.substr(0, slash));
  }
  return found;
}

bool exists(const Session& session, const std::string& object) {
  if (object == "/" || session.known.contains(object)) return true;
  std::vector<std::string> links = ancestors(object);
  links.push_back(object);
  for (const std::string& link : links) {
    if (session.known.contains(link)) continue;
    if (H5Lexists(session.file.get(), link.c_str(), H5P_DEFAULT) <= 0) return false;
    H5L_info_t info;
    session.check(H5Lget_info(session.file.get(), link.c_str(), &info, H5P_DEFAULT), link);
    if (info.type != H5L_TYPE_HARD) session.fail(link, "is a link to elsewhere, which is not followed");
    session.known.insert(link);
  }
  return true;
}

Handle open_object(const Session& session, const std::string& object) {
  if (session.last_path == object) return session.last.share();
  if (!exists(session, object)) session.fail(object, "is missing");
  session.last_path.clear();
  session.last = session.own(H5Oopen(session.file.get(), object.c_str(), H5P_DEFAULT), object);
  session.last_path = object;
  return session.last.share();
}

Handle open_dataset(const Session& session, const std::string& object) {
  Handle dataset = open_object(session, object);
  if (H5Iget_type(dataset.get()) != H5I_DATASET) session.fail(object, "is not a dataset");
  return dataset;
}

Handle open_attribute(const Session& session, const std::string& object, const std::string& name) {
  const Handle holder = open_object(session, object);
  if (H5Aexists(holder.get(), name.c_str()) <= 0) session.fail(object + "@" + name, "is missing");
  return session.own(H5Aopen(holder.get(), name.c_str(), H5P_DEFAULT), object + "@" + name);
}

Shape extent(const Session& session, hid_t space, const std::string& object) {
  if (H5Sget_simple_extent_type(space) == H5S_NULL) session.fail(object, "is empty");
  const int rank = H5Sget_simple_extent_ndims(space);
  session.check(rank, object);
  std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
  session.check(H5Sget_simple_extent_dims(space, dims.data(), nullptr), object);
  return {dims.begin(), dims.end()};
}

void check_storage(const Session& session, hid_t dataset, const Shape& shape, const std::string& object) {
  if (session.is_written) return;  // our own data, part of them not in the file yet
  const Handle type = session.own(H5Dget_type(dataset), object);
  const Handle properties = session.own(H5Dget_create_plist(dataset), object);
  std::size_t bytes = H5Tget_size(type.get());
  for (const std::size_t size : shape) {
    if (__builtin_mul_overflow(bytes, size, &bytes)) session.fail(object, "announces an impossible size");
  }
  if (H5Pget_external_count(properties.get()) != 0) session.fail(object, "keeps its data in another file");
  const bool deflated = check_filters(session, properties, object);
  const std::size_t stored = H5Dget_storage_size(dataset);
  const H5D_layout_t layout = H5Pget_layout(properties.get());
  if (layout != H5D_COMPACT && layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED) {
    session.fail(object, "is a virtual dataset, which is not supported");
  }
  if (layout == H5D_CHUNKED) check_chunks(session, properties, shape, object);
  const std::size_t ratio = deflated ? kDeflateRatio : 1;
  if (stored > session.file_size || bytes / ratio > stored) {
    session.fail(object, fmt::format("announces {} bytes, but the file of {} bytes stores {} for it", bytes,
                                     session.file_size, stored));
  }
}

Handle open_checked(const Session& session, const std::string& object, const Expectation& expected,
                    const Shape& shape) {
  Handle dataset = open_dataset(session, object);
  const Handle type = session.own(H5Dget_type(dataset.get()), object);
  if (H5Tget_class(type.get()) != expected.type_class || H5Tget_size(type.get()) > expected.largest_item) {
    session.fail(object, fmt::format("must hold {}", expected.name));
  }
  const Handle space = session.own(H5Dget_space(dataset.get()), object);
  const Shape found = extent(session, space.get(), object);
  if (found != shape) {
    session.fail(object, fmt::format("has shape [{}] instead of [{}]", fmt::join(found, ", "),
                                     fmt::join(shape, ", ")));
  }
  check_storage(session, dataset.get(), shape, object);
  return dataset;
}

std::size_t attribute_count(const Session& session, const Handle& attribute, const std::string& place,
                            std::size_t most) {
  const Handle space = session.own(H5Aget_space(attribute.get()), place);
  std::size_t count = 1;
  for (const std::size_t size : extent(session, space.get(), place)) {
    if (__builtin_mul_overflow(count, size, &count) || count > most) {
      session.fail(place, "has too many values");
    }
  }
  return count;
}

std::vector<double> attribute_numbers(const Session& session, const Handle& attribute,
                                      const std::string& place, std::size_t most) {
  const Handle type = session.own(H5Aget_type(attribute.get()), place);
  const H5T_class_t kind = H5Tget_class(type.get());
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) session.fail(place, "must be a number");
  std::vector<double> values(attribute_count(session, attribute, place, most));
  session.check(H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, values.data()), place);
  return values;
}

std::vector<std::string> attribute_texts(const Session& session, const Handle& attribute,
                                         const std::string& place, std::size_t most) {
  const Handle found = session.own(H5Aget_type(attribute.get()), place);
  if (H5Tget_class(found.get()) != H5T_STRING) session.fail(place, "must be text");
  const std::size_t count = attribute_count(session, attribute, place, most);
  std::vector<std::string> values;
  if (H5Tis_variable_str(found.get()) > 0) {
    const Handle type = session.string_type();
    const Handle space = session.own(H5Aget_space(attribute.get()), place);
    std::vector<char*> pointers(count, nullptr);
    session.check(H5Aread(attribute.get(), type.get(), static_cast<void*>(pointers.data())), place);
    for (const char* pointer : pointers) values.emplace_back(pointer == nullptr ? "" : pointer);
    H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, static_cast<void*>(pointers.data()));
    return values;
  }
  const std::size_t size = H5Tget_size(found.get());
  const std::size_t most_bytes =
      session.is_written ? kLongestString : std::min(kLongestString, session.file_size);
  if (count > 0 && size > most_bytes / count) session.fail(place, "is too long");
  std::string all(size * count, '\0');
  session.check(H5Aread(attribute.get(), found.get(), all.data()), place);
  for (std::size_t i = 0; i < count; ++i) values.emplace_back(all.substr(i * size, size).c_str());
  return values;
}

std::string attribute_text(const Session& session, const Handle& attribute, const std::string& place) {
  const std::vector<std::string> values = attribute_texts(session, attribute, place, 1);
  if (values.size() != 1) session.fail(place, "must be one text");
  return values.front();
}

std::vector<std::string> dataset_texts(const Session& session, const std::string& object, std::size_t count) {
  const Handle dataset = open_checked(session, object, {H5T_STRING, "text", 64}, {count});
  const Handle found = session.own(H5Dget_type(dataset.get()), object);
  if (H5Tis_variable_str(found.get()) <= 0) session.fail(object, "must hold text of variable length");
  const Handle type = session.string_type();
  const Handle space = session.own(H5Dget_space(dataset.get()), object);
  std::vector<char*> pointers = read_all<char*>(session, dataset, type.get(), {count}, object);
  std::vector<std::string> values;
  for (const char* pointer : pointers) values.emplace_back(pointer == nullptr ? "" : pointer);
  H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, static_cast<void*>(pointers.data()));
  return values;
}

std::vector<std::string> attribute_names(const Session& session, const std::string& object) {
  const Handle holder = open_object(session, object);
  std::vector<std::string> names;
  const auto append = [](hid_t, const char* name, const H5A_info_t*, void* data) -> herr_t {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
  };
  hsize_t position = 0;
  session.check(H5Aiterate2(holder.get(), H5_INDEX_NAME, H5_ITER_INC, &position, append, &names), object);
  return names;
}

std::vector<std::string> children(const Session& session, const std::string& group) {
  const Handle holder = open_object(session, group);
  if (H5Iget_type(holder.get()) != H5I_GROUP) return {};
  std::vector<std::string> names;
  const auto append = [](hid_t, const char* name, const H5L_info_t*, void* data) -> herr_t {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
  };
  hsize_t position = 0;
  session.check(H5Literate(holder.get(), H5_INDEX_NAME, H5_ITER_INC, &position, append, &names), group);
  for (std::string& name : names) name = (group == "/" ? "/" : group + "/") + name;
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> tree(const Session& session, const std::string& object) {
  std::vector<std::string> found;
  collect(session, object, 0, found);
  return found;
}

bool is_dataset(const Session& session, const std::string& object) {
  return H5Iget_type(open_object(session, object).get()) == H5I_DATASET;
}

bool is_same(const Session& session, const std::string& object, const std::string& other) {
  const auto address = [&](const std::string& path) {
    H5O_info_t info;
    session.check(H5Oget_info(open_object(session, path).get(), &info), path);
    return info.addr;
  };
  return address(object) == address(other);
}

}  // namespace indet::hdf5
