#pragma once

#include <string>
#include <vector>

#include "libindet/io/hdf5_session.h"

/// Reading files that are not trusted: nothing is followed out of the file, and no memory is allocated before
/// what is announced was compared with what is expected and with the size of the file. All functions throw
/// Hdf5ReadError (on a file that is being written, Hdf5WriteError) that names the object.
namespace indet::hdf5 {

/// The path of the object that holds `path`, and each object on the way to it, from the top.
std::vector<std::string> ancestors(const std::string& path);

/// Throws where a link on the way is not a hard one: others lead out of the file or in circles.
bool exists(const Session& session, const std::string& object);

Handle open_object(const Session& session, const std::string& object);
Handle open_dataset(const Session& session, const std::string& object);
Handle open_attribute(const Session& session, const std::string& object, const std::string& name);

/// The shape of a data space; that of nothing is refused.
Shape extent(const Session& session, hid_t space, const std::string& object);

/// Throws unless what the header of a dataset announces can come out of a file of this size.
void check_storage(const Session& session, hid_t dataset, const Shape& shape, const std::string& object);

/// What a dataset must hold.
struct Expectation {
  H5T_class_t type_class;
  const char* name;          ///< In messages: "must hold NAME".
  std::size_t largest_item;  ///< Bytes.
};
/// Opens a dataset of this class of type and this shape.
Handle open_checked(const Session& session, const std::string& object, const Expectation& expected,
                    const Shape& shape);

/// All values of a dataset. Precondition: check_storage() passed.
template <class T>
std::vector<T> read_all(const Session& session, const Handle& dataset, hid_t memory_type, const Shape& shape,
                        const std::string& object) {
  std::vector<T> values(item_count(shape));
  if (!values.empty()) {
    session.check(H5Dread(dataset.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), object);
  }
  return values;
}

/// Attributes of numbers have at most this many.
inline constexpr std::size_t kMostAttributeValues = 64 * 1024;

/// The number of values of an attribute, which must be at most `most`.
std::size_t attribute_count(const Session& session, const Handle& attribute, const std::string& place,
                            std::size_t most);
/// An attribute of numbers with at most `most` of them.
std::vector<double> attribute_numbers(const Session& session, const Handle& attribute,
                                      const std::string& place, std::size_t most);
/// An attribute of texts.
std::vector<std::string> attribute_texts(const Session& session, const Handle& attribute,
                                         const std::string& place, std::size_t most);
/// An attribute that is one text.
std::string attribute_text(const Session& session, const Handle& attribute, const std::string& place);

/// A dataset of texts of variable length, of rank 1.
std::vector<std::string> dataset_texts(const Session& session, const std::string& object, std::size_t count);

/// In the order of their names.
std::vector<std::string> attribute_names(const Session& session, const std::string& object);
/// The absolute paths of what is directly in a group, sorted; nothing if it is no group.
std::vector<std::string> children(const Session& session, const std::string& group);
/// `object` and everything below it, in depth first; groups nested too deeply are refused.
std::vector<std::string> tree(const Session& session, const std::string& object);
bool is_dataset(const Session& session, const std::string& object);
/// Whether two paths lead to one object.
bool is_same(const Session& session, const std::string& object, const std::string& other);

}  // namespace indet::hdf5
