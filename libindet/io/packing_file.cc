#include "libindet/io/packing_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/packing/validate.h"

namespace indet {
namespace {

/// One number of each item.
template <class T, class Item, class Get>
std::vector<T> column(const std::vector<Item>& items, Get get) {
  std::vector<T> values;
  values.reserve(items.size());
  for (const Item& item : items) values.push_back(get(item));
  return values;
}

/// The components of a vector of each item, [items, size].
template <class Item, class Get>
std::vector<double> rows(const std::vector<Item>& items, Get get) {
  std::vector<double> values;
  for (const Item& item : items) {
    const auto& vector = get(item);
    values.insert(values.end(), vector.data(), vector.data() + vector.size());
  }
  return values;
}

/// The friction that all contacts share; NaN if they differ or there is none.
double common_friction(const Packing& packing) {
  if (packing.contacts.empty()) return kNaN;
  const double mu = packing.contacts.front().mu;
  const bool same = std::all_of(packing.contacts.begin(), packing.contacts.end(),
                                [&](const Contact& c) { return c.mu == mu; });
  return same ? mu : kNaN;
}

void write_parameters(Hdf5File& file, const Packing& packing) {
  file.make_group("/parameters");
  file.set_attribute("/parameters", "protocol", packing.origin.protocol);
  file.set_attribute("/parameters", "seed", packing.origin.seed);
  file.set_attribute("/parameters", "config", packing.origin.config);
  file.set_attribute("/parameters", "mu", common_friction(packing));
  file.set_attribute("/parameters", "gravity",
                     std::span<const double>(packing.gravity.data(), static_cast<std::size_t>(2)));
  file.set_attribute("/parameters", "mg", packing.force_unit());
  file.set_attribute("/parameters", "force_unit", packing.named_force_unit);
  file.set_attribute("/parameters", "r_max", packing.max_radius());
  file.set_attribute("/parameters", "Lx", packing.origin.width);
  file.set_attribute("/parameters", "Ly", packing.origin.height);
}

bool is_fixed(const Disk& disk) { return disk.fixed; }

void write_disks(Hdf5File& file, const std::vector<Disk>& disks) {
  const std::string group = "/particles/disks";
  const std::size_t n = disks.size();
  file.make_group(group);
  file.write(group + "/id", column<std::int32_t>(disks, [](const Disk& d) { return d.id; }), {n},
             {"1", "name of the disk"});
  file.write(group + "/position",
             rows(
                 disks, [](const Disk& d) -> auto& { return d.position; }),
             {n, 2}, {"length", "centre x, y"});
  file.write(group + "/angle", column<double>(disks, [](const Disk& d) { return d.angle; }), {n},
             {"rad", "orientation"});
  file.write(group + "/velocity",
             rows(
                 disks, [](const Disk& d) -> auto& { return d.velocity; }),
             {n, 2}, {"length/time", "velocity x, y"});
  file.write(group + "/angular_velocity",
             column<double>(disks, [](const Disk& d) { return d.angular_velocity; }), {n},
             {"rad/time", "angular velocity"});
  file.write(group + "/radius", column<double>(disks, [](const Disk& d) { return d.radius; }), {n},
             {"length", "radius"});
  file.write(group + "/mass", column<double>(disks, [](const Disk& d) { return d.mass; }), {n},
             {"mass", "mass"});
  file.write(group + "/inertia", column<double>(disks, [](const Disk& d) { return d.inertia; }), {n},
             {"mass*length^2", "moment of inertia"});
  file.write(group + "/load",
             rows(
                 disks, [](const Disk& d) -> auto& { return d.load; }),
             {n, 3}, {"force, force, force*length", "external force x, y and torque beside gravity"});
  if (std::any_of(disks.begin(), disks.end(), is_fixed)) {
    file.write(group + "/fixed", column<std::uint8_t>(disks, is_fixed), {n},
               {"1", "1: the disk is fixed and has no equations"});
  }
}

void write_walls(Hdf5File& file, const std::vector<Wall>& walls) {
  const std::size_t n = walls.size();
  file.make_group("/walls");
  file.write("/walls/id", column<std::int32_t>(walls, [](const Wall& w) { return w.id; }), {n},
             {"1", "number of the wall in its source"});
  file.write("/walls/point",
             rows(
                 walls, [](const Wall& w) -> auto& { return w.point; }),
             {n, 2}, {"length", "a point of the wall x, y"});
  file.write("/walls/normal",
             rows(
                 walls, [](const Wall& w) -> auto& { return w.normal; }),
             {n, 2}, {"1", "unit normal into the domain x, y"});
  file.write_strings("/walls/name", column<std::string>(walls, [](const Wall& w) { return w.name; }),
                     {"1", "name of the wall"});
  if (std::none_of(walls.begin(), walls.end(), [](const Wall& w) { return w.is_loaded(); })) return;
  file.write("/walls/load", rows(walls, [](const Wall& w) { return Vector2(w.load_n, w.load_t); }), {n, 2},
             {"force", "load along the normal and the tangent, NaN where the wall is not free"});
}

void write_contacts(Hdf5File& file, const std::vector<Contact>& contacts) {
  const std::size_t n = contacts.size();
  file.make_group("/contacts");
  file.write("/contacts/body_a", column<std::int32_t>(contacts, [](const Contact& c) { return c.a.value(); }),
             {n}, {"1", "row of disk a"});
  file.write("/contacts/body_b", column<std::int32_t>(contacts, [](const Contact& c) { return c.b.code(); }),
             {n}, {"1", "row of disk b, or -(w+1) for the wall of row w"});
  file.write("/contacts/normal",
             rows(
                 contacts, [](const Contact& c) -> auto& { return c.normal; }),
             {n, 2}, {"1", "unit normal from b to a x, y"});
  file.write("/contacts/gap", column<double>(contacts, [](const Contact& c) { return c.gap; }), {n},
             {"length", "distance of the surfaces, negative where they overlap"});
  file.write("/contacts/mu", column<double>(contacts, [](const Contact& c) { return c.mu; }), {n},
             {"1", "Coulomb friction coefficient"});
  file.write("/contacts/R", column<double>(contacts, [](const Contact& c) { return c.R; }), {n},
             {"force", "normal force as simulated, NaN if unknown"});
  file.write("/contacts/T", column<double>(contacts, [](const Contact& c) { return c.T; }), {n},
             {"force", "tangential force as simulated, NaN if unknown"});
}

void write_levers(Hdf5File& file, const std::vector<Contact>& contacts) {
  const std::size_t n = contacts.size();
  file.write("/contacts/lever_a", column<double>(contacts, [](const Contact& c) { return c.lever_a; }), {n},
             {"length", "arm of the torque of T on a, NaN: the radius"});
  file.write("/contacts/lever_b", column<double>(contacts, [](const Contact& c) { return c.lever_b; }), {n},
             {"length", "arm of the torque of T on b, NaN: the radius, or a wall"});
}

void write_bounds(Hdf5File& file, const std::vector<Contact>& contacts) {
  file.write("/contacts/bounds",
             rows(contacts, [](const Contact& c) { return Eigen::Vector4d(c.R_lo, c.R_hi, c.T_lo, c.T_hi); }),
             {contacts.size(), 4},
             {"force", "R_lo, R_hi, T_lo, T_hi that the scene allows, inf where it does not"});
}

/// As H5MD has it: the directions that are periodic, and their vectors.
void write_cell(Hdf5File& file, const Cell& cell) {
  const std::string group = "/particles/disks/box";
  const auto boundary = [](const auto& vector) -> std::string { return vector ? "periodic" : "none"; };
  file.make_group(group);
  file.set_attribute(group, "dimension", 2);
  file.set_attribute(group, "boundary", std::vector<std::string>{boundary(cell.a), boundary(cell.b)});
  if (!cell.is_periodic()) return;
  const Vector2 none(kNaN, kNaN);
  const Vector2 a = cell.a.value_or(none);
  const Vector2 b = cell.b.value_or(none);
  file.write(group + "/edges", std::vector<double>{a.x(), a.y(), b.x(), b.y()}, {2, 2},
             {"length", "vectors a, b of the cell, NaN where the scene is not periodic"});
}

Cell read_cell(const Hdf5File& file) {
  Cell cell;
  const std::string name = "/particles/disks/box/edges";
  if (!file.has(name)) return cell;
  const auto edges = file.read_doubles(name, {2, 2});
  const auto is_given = [&](std::size_t k) { return !std::isnan(edges[k]) || !std::isnan(edges[k + 1]); };
  if (is_given(0)) cell.a = Vector2(edges[0], edges[1]);
  if (is_given(2)) cell.b = Vector2(edges[2], edges[3]);
  return cell;
}

void write_stress(Hdf5File& file, const Stress& stress) {
  file.make_group("/stress");
  const auto components = stress.components();
  for (std::size_t k = 0; k < components.size(); ++k)
    file.set_attribute("/stress", Stress::kNames[k], components[k]);
}

Stress read_stress(const Hdf5File& file) {
  Stress stress;
  if (!file.has("/stress")) return stress;
  for (const char* name : Stress::kNames) *stress.find(name) = file.double_attribute("/stress", name);
  return stress;
}

std::vector<std::int32_t> images(const std::vector<Contact>& contacts) {
  std::vector<std::int32_t> values;
  for (const Contact& contact : contacts)
    values.insert(values.end(), contact.image.begin(), contact.image.end());
  return values;
}

std::vector<Disk> read_disks(const Hdf5File& file) {
  const std::string group = "/particles/disks";
  const std::size_t n = file.shape(group + "/id", 1)[0];
  const auto id = file.read_integers(group + "/id", {n});
  const auto position = file.read_doubles(group + "/position", {n, 2});
  const auto angle = file.read_doubles(group + "/angle", {n});
  const auto velocity = file.read_doubles(group + "/velocity", {n, 2});
  const auto angular_velocity = file.read_doubles(group + "/angular_velocity", {n});
  const auto radius = file.read_doubles(group + "/radius", {n});
  const auto mass = file.read_doubles(group + "/mass", {n});
  const auto inertia = file.read_doubles(group + "/inertia", {n});
  const auto load = file.read_doubles(group + "/load", {n, 3});
  const auto fixed =
      file.has(group + "/fixed") ? file.read_bytes(group + "/fixed", {n}) : std::vector<std::uint8_t>(n, 0);
  std::vector<Disk> disks(n);
  for (std::size_t i = 0; i < n; ++i) {
    disks[i] = Disk{.id = id[i],
                    .position = {position[2 * i], position[2 * i + 1]},
                    .radius = radius[i],
                    .mass = mass[i],
                    .inertia = inertia[i],
                    .angle = angle[i],
                    .velocity = {velocity[2 * i], velocity[2 * i + 1]},
                    .angular_velocity = angular_velocity[i],
                    .load = {load[3 * i], load[3 * i + 1], load[3 * i + 2]},
                    .fixed = fixed[i] != 0};
  }
  return disks;
}

std::vector<Wall> read_walls(const Hdf5File& file) {
  const std::size_t n = file.shape("/walls/point", 2)[0];
  const auto id = file.read_integers("/walls/id", {n});
  const auto point = file.read_doubles("/walls/point", {n, 2});
  const auto normal = file.read_doubles("/walls/normal", {n, 2});
  const auto name = file.read_strings("/walls/name", n);
  const auto load =
      file.has("/walls/load") ? file.read_doubles("/walls/load", {n, 2}) : std::vector<double>(2 * n, kNaN);
  std::vector<Wall> walls(n);
  for (std::size_t i = 0; i < n; ++i) {
    walls[i] = Wall{.id = id[i],
                    .point = {point[2 * i], point[2 * i + 1]},
                    .normal = {normal[2 * i], normal[2 * i + 1]},
                    .name = name[i],
                    .load_n = load[2 * i],
                    .load_t = load[2 * i + 1]};
  }
  return walls;
}

std::vector<Contact> read_contacts(const Hdf5File& file) {
  const std::size_t n = file.shape("/contacts/body_a", 1)[0];
  const auto a = file.read_integers("/contacts/body_a", {n});
  const auto b = file.read_integers("/contacts/body_b", {n});
  const auto normal = file.read_doubles("/contacts/normal", {n, 2});
  const auto gap = file.read_doubles("/contacts/gap", {n});
  const auto mu = file.read_doubles("/contacts/mu", {n});
  const auto r = file.read_doubles("/contacts/R", {n});
  const auto t = file.read_doubles("/contacts/T", {n});
  const auto lever = [&](const std::string& name) {
    return file.has(name) ? file.read_doubles(name, {n}) : std::vector<double>(n, kNaN);
  };
  const auto lever_a = lever("/contacts/lever_a");
  const auto lever_b = lever("/contacts/lever_b");
  const auto bounds =
      file.has("/contacts/bounds") ? file.read_doubles("/contacts/bounds", {n, 4}) : std::vector<double>();
  const auto image = file.has("/contacts/image") ? file.read_integers("/contacts/image", {n, 2})
                                                 : std::vector<std::int32_t>(2 * n, 0);
  std::vector<Contact> contacts(n);
  for (std::size_t i = 0; i < n; ++i) {
    contacts[i] = Contact{.a = DiskId(a[i]),
                          .b = Body::from_code(b[i]),
                          .normal = {normal[2 * i], normal[2 * i + 1]},
                          .gap = gap[i],
                          .mu = mu[i],
                          .R = r[i],
                          .T = t[i],
                          .lever_a = lever_a[i],
                          .lever_b = lever_b[i],
                          .image = {image[2 * i], image[2 * i + 1]}};
    if (bounds.empty()) continue;
    contacts[i].R_lo = bounds[4 * i];
    contacts[i].R_hi = bounds[4 * i + 1];
    contacts[i].T_lo = bounds[4 * i + 2];
    contacts[i].T_hi = bounds[4 * i + 3];
  }
  return contacts;
}

}  // namespace

SchemaVersion schema_of(const Packing& packing) {
  const bool fixed = std::any_of(packing.disks.begin(), packing.disks.end(), is_fixed);
  const bool is_new = fixed || packing.has_levers() || packing.has_loaded_walls() ||
                      packing.has_bound_columns() || packing.cell.is_periodic();
  return is_new ? SchemaVersion{2, 0} : SchemaVersion{};
}

void write_packing_part(Hdf5File& file, const Packing& packing) {
  write_parameters(file, packing);
  write_disks(file, packing.disks);
  write_cell(file, packing.cell);
  if (packing.stress.is_imposed()) write_stress(file, packing.stress);
  write_walls(file, packing.walls);
  write_contacts(file, packing.contacts);
  if (packing.has_levers()) write_levers(file, packing.contacts);
  if (packing.has_bound_columns()) write_bounds(file, packing.contacts);
  if (packing.cell.is_periodic()) {
    file.write("/contacts/image", images(packing.contacts), {packing.contacts.size(), 2},
               {"1", "whole numbers i, j: the contact is with disk b at x_b + i a + j b"});
  }
}

Packing read_packing(const Hdf5File& file) {
  Packing packing;
  packing.origin.protocol = file.string_attribute("/parameters", "protocol");
  packing.origin.seed = file.integer_attribute("/parameters", "seed");
  packing.origin.config = file.string_attribute("/parameters", "config");
  if (file.has_attribute("/parameters", "Lx")) {
    packing.origin.width = file.double_attribute("/parameters", "Lx");
    packing.origin.height = file.double_attribute("/parameters", "Ly");
  }
  const auto gravity = file.doubles_attribute("/parameters", "gravity", 2);
  packing.gravity = {gravity[0], gravity[1]};
  packing.named_force_unit = file.double_attribute("/parameters", "force_unit");
  packing.cell = read_cell(file);
  packing.stress = read_stress(file);
  packing.disks = read_disks(file);
  packing.walls = read_walls(file);
  packing.contacts = read_contacts(file);
  validate(packing, file.path().string());
  return packing;
}

void write_packing(const std::filesystem::path& path, const Packing& packing, const Provenance& provenance) {
  Hdf5File file = Hdf5File::create(path);
  write_header(file, schema_of(packing));
  write_packing_part(file, packing);
  write_provenance_part(file, provenance);
  seal(file);
}

Packing read_packing(const std::filesystem::path& path) { return read_packing(open_indet_file(path)); }

std::string packing_digest(const Hdf5File& file) {
  return file.sha256({"/contacts", "/parameters", "/particles", "/walls"});
}

}  // namespace indet
