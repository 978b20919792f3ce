#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <pugixml.hpp>
#include <string_view>
#include <unordered_map>

#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/io/table.h"
#include "libindet/io/yade_scene.h"

namespace indet {
namespace {

/// An XML archive of boost. Its objects are elements "px": the first object of a class has class_id and
/// class_name, later ones class_id_reference; an object that appears again is only referred to, by
/// object_id_reference.
class Archive {
 public:
  explicit Archive(const std::filesystem::path& path) : source_(path.string()), text_(read_text(path)) {
    for (std::size_t i = text_->find('\n'); i != std::string::npos; i = text_->find('\n', i + 1)) {
      line_ends_.push_back(static_cast<std::ptrdiff_t>(i));
    }
    const pugi::xml_parse_result result = document_.load_buffer(text_->data(), text_->size());
    if (!result) {
      fail(line_at(result.offset), fmt::format("this is no XML that can be read: {}", result.description()));
    }
    scene_ = document_.child("boost_serialization").child("scene").child("px");
    if (!scene_)
      fail(1, "this is not a scene of YADE (boost_serialization with a scene, as O.save writes it)");
    Index index{*this};
    document_.traverse(index);
  }

  pugi::xml_node scene() const { return scene_; }

  /// The object that an element "px" stands for; none if it is null.
  pugi::xml_node object(const pugi::xml_node& px) const {
    if (std::string_view(px.attribute("class_id").value()) == "-1") return {};
    const std::string reference = px.attribute("object_id_reference").value();
    if (reference.empty()) return px;
    const auto found = objects_.find(reference);
    if (found == objects_.end()) fail(line_of(px), fmt::format("there is no object {}", reference));
    return found->second;
  }

  /// "yade::Sphere" without its namespace; "" for a class that is written without a name.
  std::string class_of(const pugi::xml_node& object) const {
    const char* const own = object.attribute("class_name").value();
    if (*own != '\0') return without_namespace(own);
    const auto found = classes_.find(object.attribute("class_id_reference").value());
    return found == classes_.end() ? "" : found->second;
  }

  /// The NewtonIntegrator, or none. It is written without the name of its class where another engine refers
  /// to it, so it is known by what it has.
  pugi::xml_node newton() const {
    return document_.find_node(
        [](const pugi::xml_node& node) { return node.child("gravity") && node.child("damping"); });
  }

  /// The element at `path` below `node`.
  pugi::xml_node at(const pugi::xml_node& node, const char* path) const {
    const pugi::xml_node found = node.first_element_by_path(path);
    if (!found) fail(line_of(node), fmt::format("{} is missing in {}", path, node.name()));
    return found;
  }

  double number(const pugi::xml_node& node, const char* path) const {
    const pugi::xml_node found = at(node, path);
    double value = 0;
    if (!parse_number(found.child_value(), &value)) {
      fail(line_of(found),
           fmt::format("{}: \"{}\" is not a number", found.name(), excerpt(found.child_value())));
    }
    return value;
  }

  int integer(const pugi::xml_node& node, const char* path) const {
    const pugi::xml_node found = at(node, path);
    std::int64_t value = 0;
    if (!parse_number(std::string_view(found.child_value()), &value) ||
        value != static_cast<std::int32_t>(value)) {
      fail(line_of(found), fmt::format("{}: \"{}\" is not a whole number of 32 bits", found.name(),
                                       excerpt(found.child_value())));
    }
    return static_cast<int>(value);
  }

  Eigen::Vector3d vector(const pugi::xml_node& node, const char* path) const {
    const pugi::xml_node found = at(node, path);
    return {number(found, "x"), number(found, "y"), number(found, "z")};
  }

  Place place(const pugi::xml_node& node) const { return {source_, line_of(node)}; }

 private:
  /// Notes classes and objects on the way through the document.
  struct Index : pugi::xml_tree_walker {
    explicit Index(Archive& owner) : archive(owner) {}
    bool for_each(pugi::xml_node& node) override {
      const std::string class_name = archive.class_of(node);
      if (const char* id = node.attribute("class_id").value(); *id != '\0' && !class_name.empty()) {
        archive.classes_.emplace(id, class_name);
      }
      if (const char* id = node.attribute("object_id").value(); *id != '\0')
        archive.objects_.emplace(id, node);
      return true;
    }
    Archive& archive;
  };

  static std::string without_namespace(std::string_view name) {
    const std::size_t colons = name.rfind("::");
    return std::string(colons == std::string_view::npos ? name : name.substr(colons + 2));
  }

  int line_at(std::ptrdiff_t offset) const {
    const auto after = std::lower_bound(line_ends_.begin(), line_ends_.end(), offset);
    return 1 + static_cast<int>(after - line_ends_.begin());
  }
  int line_of(const pugi::xml_node& node) const { return line_at(node.offset_debug()); }

  [[noreturn]] void fail(int line, const std::string& reason) const { Place{source_, line}.fail(reason); }

  std::string source_;
  std::shared_ptr<const std::string> text_;
  std::vector<std::ptrdiff_t> line_ends_;
  pugi::xml_document document_;
  pugi::xml_node scene_;
  std::unordered_map<std::string, std::string> classes_;     ///< Name of each class_id.
  std::unordered_map<std::string, pugi::xml_node> objects_;  ///< By object_id.
};

YadeBody read_body(const Archive& archive, const pugi::xml_node& node) {
  YadeBody body;
  body.place = archive.place(node);
  body.id = archive.integer(node, "id");
  const pugi::xml_node shape = archive.object(archive.at(node, "shape/px"));
  const pugi::xml_node state = archive.object(archive.at(node, "state/px"));
  const pugi::xml_node material = archive.object(archive.at(node, "material/px"));
  body.shape = shape ? archive.class_of(shape) : "body without a shape";
  if (material) {
    if (const pugi::xml_node id = material.find_node(
            [](const pugi::xml_node& child) { return std::string_view(child.name()) == "id"; })) {
      body.material = archive.integer(id.parent(), "id");
    }
  }
  body.position = archive.vector(state, "se3/position");
  body.velocity = archive.vector(state, "vel");
  body.angular_velocity = archive.vector(state, "angVel");
  body.mass = archive.number(state, "mass");
  body.inertia = archive.number(state, "inertia/z");
  body.blocked = archive.integer(state, "blockedDOFs");
  if (body.shape == "Sphere") body.radius = archive.number(shape, "radius");
  if (body.shape == "Wall") {
    body.axis = archive.integer(shape, "axis");
    body.sense = archive.integer(shape, "sense");
  }
  if (body.shape == "Box") {
    body.extents = archive.vector(shape, "extents");
    body.turned = !archive.vector(state, "se3/orientation").isZero(1e-12);  // the vector part of a quaternion
  }
  return body;
}

/// The element of this name anywhere below `node`: base classes are nested.
pugi::xml_node below(const Archive& archive, const pugi::xml_node& node, const char* name) {
  const pugi::xml_node found =
      node.find_node([&](const pugi::xml_node& child) { return std::string_view(child.name()) == name; });
  if (!found) archive.place(node).fail(fmt::format("{} is missing in {}", name, archive.class_of(node)));
  return found.parent();
}

YadeInteraction read_interaction(const Archive& archive, const pugi::xml_node& node,
                                 const pugi::xml_node& geom, const pugi::xml_node& phys) {
  YadeInteraction interaction;
  interaction.place = archive.place(node);
  interaction.first = archive.integer(node, "id1");
  interaction.second = archive.integer(node, "id2");
  interaction.normal = archive.vector(below(archive, geom, "normal"), "normal");
  interaction.normal_force = archive.vector(below(archive, phys, "normalForce"), "normalForce");
  interaction.shear_force = archive.vector(below(archive, phys, "shearForce"), "shearForce");
  interaction.friction =
      archive.number(below(archive, phys, "tangensOfFrictionAngle"), "tangensOfFrictionAngle");
  return interaction;
}

}  // namespace

YadeScene read_yade_archive(const std::filesystem::path& file) {
  const Archive archive(file);
  YadeScene scene;
  if (archive.integer(archive.scene(), "isPeriodic") != 0) {
    const pugi::xml_node size = archive.at(archive.object(archive.at(archive.scene(), "cell/px")), "hSize");
    scene.cell.emplace();
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k)
        (*scene.cell)(i, k) = archive.number(size, fmt::format("m{}{}", i, k).c_str());
    }
  }
  if (const pugi::xml_node newton = archive.newton()) {
    scene.gravity = archive.vector(newton, "gravity");
  }
  for (const pugi::xml_node& item : archive.at(archive.scene(), "bodies/px/body").children("item")) {
    const pugi::xml_node body = archive.object(archive.at(item, "px"));
    if (body) scene.bodies.push_back(read_body(archive, body));
  }
  for (const pugi::xml_node& item :
       archive.at(archive.scene(), "interactions/px/interaction").children("item")) {
    const pugi::xml_node node = archive.object(archive.at(item, "px"));
    if (!node) continue;
    const pugi::xml_node geom = archive.object(archive.at(node, "geom/px"));
    const pugi::xml_node phys = archive.object(archive.at(node, "phys/px"));
    if (geom && phys) scene.interactions.push_back(read_interaction(archive, node, geom, phys));
  }
  return scene;
}

}  // namespace indet
