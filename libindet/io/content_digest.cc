#include "libindet/io/content_digest.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include "libindet/io/hdf5_guard.h"
#include "libindet/io/sha256.h"

namespace indet::hdf5 {
namespace {

void append_integer(std::vector<unsigned char>& bytes, std::int64_t value) {
  const auto bits = static_cast<std::uint64_t>(value);
  for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<unsigned char>(bits >> (8 * i)));
}

void hash_values(Sha256& hash, const std::string& key, const Shape& shape, const std::vector<double>& reals,
                 const std::vector<std::int64_t>& integers) {
  std::vector<unsigned char> bytes(key.begin(), key.end());
  bytes.push_back(0);
  append_integer(bytes, static_cast<std::int64_t>(shape.size()));
  for (const std::size_t size : shape) append_integer(bytes, static_cast<std::int64_t>(size));
  for (const double value : reals) append_integer(bytes, std::bit_cast<std::int64_t>(value));
  for (const std::int64_t value : integers) append_integer(bytes, value);
  hash.update(bytes.data(), bytes.size());
}

void hash_dataset(const Session& session, Sha256& hash, const std::string& object) {
  const Handle dataset = open_dataset(session, object);
  const Handle type = session.own(H5Dget_type(dataset.get()), object);
  const Handle space = session.own(H5Dget_space(dataset.get()), object);
  const Shape shape = extent(session, space.get(), object);
  const H5T_class_t kind = H5Tget_class(type.get());
  if (kind == H5T_STRING) return;
  check_storage(session, dataset.get(), shape, object);
  if (kind == H5T_FLOAT) {
    hash_values(hash, object, shape, read_all<double>(session, dataset, H5T_NATIVE_DOUBLE, shape, object),
                {});
  } else if (kind == H5T_INTEGER) {
    hash_values(hash, object, shape, {},
                read_all<std::int64_t>(session, dataset, H5T_NATIVE_INT64, shape, object));
  } else if (kind == H5T_ENUM && H5Tget_size(type.get()) == 1) {
    const auto bytes = read_all<std::uint8_t>(session, dataset, type.get(), shape, object);
    hash_values(hash, object, shape, {}, {bytes.begin(), bytes.end()});
  } else {
    session.fail(object, "has a type that indet does not write");
  }
}

void hash_attribute(const Session& session, Sha256& hash, const std::string& object,
                    const std::string& name) {
  const std::string place = object + "@" + name;
  const Handle attribute = open_attribute(session, object, name);
  const Handle type = session.own(H5Aget_type(attribute.get()), place);
  const Handle space = session.own(H5Aget_space(attribute.get()), place);
  const H5T_class_t kind = H5Tget_class(type.get());
  const std::size_t count = attribute_count(session, attribute, place, kMostAttributeValues);
  if (kind == H5T_FLOAT) {
    hash_values(hash, place, extent(session, space.get(), place),
                attribute_numbers(session, attribute, place, count), {});
  } else if (kind == H5T_INTEGER) {
    std::vector<std::int64_t> values(count);
    session.check(H5Aread(attribute.get(), H5T_NATIVE_INT64, values.data()), place);
    hash_values(hash, place, extent(session, space.get(), place), {}, values);
  }
}

}  // namespace

std::string sha256(const Session& session, const std::vector<std::string>& roots) {
  std::vector<std::pair<std::string, std::string>> items;  // object, attribute ("" for the data)
  for (const std::string& root : roots) {
    for (const std::string& object : tree(session, root)) {
      if (is_dataset(session, object)) items.emplace_back(object, "");
      for (const std::string& name : attribute_names(session, object)) items.emplace_back(object, name);
    }
  }
  const auto key = [](const std::pair<std::string, std::string>& item) {
    return item.second.empty() ? item.first : item.first + "@" + item.second;
  };
  std::sort(items.begin(), items.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  Sha256 hash;
  for (const auto& [object, attribute] : items) {
    if (attribute.empty()) {
      hash_dataset(session, hash, object);
    } else {
      hash_attribute(session, hash, object, attribute);
    }
  }
  return hash.hex();
}

}  // namespace indet::hdf5
