#pragma once

#include <string>
#include <vector>

#include "libindet/io/hdf5_session.h"

/// Datasets, groups and attributes of a file that is being written. Same contents, same bytes: no object has
/// a time. All functions throw Hdf5WriteError.
namespace indet::hdf5 {

/// Types of the items of a dataset.
struct ItemType {
  hid_t in_file;
  hid_t in_memory;
  std::size_t size;  ///< Bytes that decide about compression.
};

void make_group(const Session& session, const std::string& object);
/// The groups on the way to `object` that are not there yet.
void make_parents(const Session& session, const std::string& object);

/// Throws if `count` values do not fill the shape.
void write(const Session& session, const std::string& object, const void* values, std::size_t count,
           const ItemType& type, const Shape& shape, const Label& label);

void set_raw(const Session& session, const std::string& object, const std::string& name, hid_t file_type,
             hid_t memory_type, const Shape& shape, const void* values);
void set_text(const Session& session, const std::string& object, const std::string& name,
              const std::string& value);
void set_texts(const Session& session, const std::string& object, const std::string& name,
               const std::vector<std::string>& values);

/// Text of fixed length in ASCII.
void set_fixed_text(const Session& session, const std::string& object, const std::string& name,
                    const std::string& value);
/// A second name, `path`, for `object`.
void link(const Session& session, const std::string& object, const std::string& path);

/// The bytes of the file, whose handle is closed.
std::vector<unsigned char> close_to_bytes(Session& session);

}  // namespace indet::hdf5
