#include "libindet/io/content_digest.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "libindet/io/hdf5_guard.h"
#include "libindet/io/sha256.h"

namespace indet::hdf5 {
namespace {

void append_integer(std::vector<unsigned char>& bytes, std::int64_t value) {
  const auto bits = static_cast<std::uint64_t>(value);
  for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<unsigned char>(bits >> (8 * i)));
}

/// What an item begins with: its key and its shape.
std::vector<unsigned char> head(const std::string& key, const Shape& shape) {
  std::vector<unsigned char> bytes(key.begin(), key.end());
  bytes.push_back(0);
  append_integer(bytes, static_cast<std::int64_t>(shape.size()));
  for (const std::size_t size : shape) append_integer(bytes, static_cast<std::int64_t>(size));
  return bytes;
}

void hash_values(Sha256& hash, const std::string& key, const Shape& shape, const std::vector<double>& reals,
                 const std::vector<std::int64_t>& integers) {
  std::vector<unsigned char> bytes = head(key, shape);
  for (const double value : reals) append_integer(bytes, std::bit_cast<std::int64_t>(value));
  for (const std::int64_t value : integers) append_integer(bytes, value);
  hash.update(bytes.data(), bytes.size());
}

void hash_texts(Sha256& hash, const std::string& key, const Shape& shape,
                const std::vector<std::string>& texts) {
  std::vector<unsigned char> bytes = head(key, shape);
  for (const std::string& text : texts) {
    append_integer(bytes, static_cast<std::int64_t>(text.size()));
    bytes.insert(bytes.end(), text.begin(), text.end());
  }
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

void hash_text_dataset(const Session& session, Sha256& hash, const std::string& object) {
  const Handle dataset = open_dataset(session, object);
  const Handle type = session.own(H5Dget_type(dataset.get()), object);
  if (H5Tget_class(type.get()) != H5T_STRING) return;
  const Handle space = session.own(H5Dget_space(dataset.get()), object);
  const Shape shape = extent(session, space.get(), object);
  if (shape.size() != 1) session.fail(object, "has a shape that indet does not write");
  hash_texts(hash, object, shape, dataset_texts(session, object, shape[0]));
}

void hash_text_attribute(const Session& session, Sha256& hash, const std::string& object,
                         const std::string& name) {
  const std::string place = object + "@" + name;
  const Handle attribute = open_attribute(session, object, name);
  const Handle type = session.own(H5Aget_type(attribute.get()), place);
  if (H5Tget_class(type.get()) != H5T_STRING) return;
  const Handle space = session.own(H5Aget_space(attribute.get()), place);
  hash_texts(hash, place, extent(session, space.get(), place),
             attribute_texts(session, attribute, place, kMostAttributeValues));
}

struct Item {
  std::string object;
  std::string attribute;  ///< Empty for the data.

  std::string key() const { return attribute.empty() ? object : object + "@" + attribute; }
};

std::vector<Item> items_below(const Session& session, const std::vector<std::string>& roots) {
  std::vector<Item> items;
  for (const std::string& root : roots) {
    for (const std::string& object : tree(session, root)) {
      if (is_dataset(session, object)) items.push_back({object, ""});
      for (const std::string& name : attribute_names(session, object)) items.push_back({object, name});
    }
  }
  return items;
}

void sort_by_key(std::vector<Item>& items) {
  std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.key() < b.key(); });
}

}  // namespace

std::string sha256(const Session& session, const std::vector<std::string>& roots) {
  std::vector<Item> items = items_below(session, roots);
  sort_by_key(items);
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

std::string text_sha256(const Session& session, const std::vector<std::string>& roots) {
  std::vector<Item> items = items_below(session, roots);
  for (const std::string& name : attribute_names(session, "/")) items.push_back({"/", name});
  std::erase_if(items, [](const Item& item) {
    return item.attribute == "sha256" || item.attribute == "content_sha256" ||
           item.attribute == "text_sha256" || item.attribute == "complete";
  });
  sort_by_key(items);
  Sha256 hash;
  for (const auto& [object, attribute] : items) {
    if (attribute.empty()) {
      hash_text_dataset(session, hash, object);
    } else {
      hash_text_attribute(session, hash, object, attribute);
      if (object == "/") hash_attribute(session, hash, object, attribute);  // the version
    }
  }
  return hash.hex();
}

}  // namespace indet::hdf5
