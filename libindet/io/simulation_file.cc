#include "libindet/io/simulation_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libindet/base/constants.h"
#include "libindet/base/error.h"

namespace indet {
namespace {

const Label kCount{"1", "number of rows before each frame's contacts"};

std::vector<double> flatten(const std::vector<Vector2>& vectors) {
  std::vector<double> values;
  values.reserve(2 * vectors.size());
  for (const Vector2& v : vectors) values.insert(values.end(), {v.x(), v.y()});
  return values;
}

std::vector<Vector2> unflatten(const double* values, std::size_t count) {
  std::vector<Vector2> vectors;
  for (std::size_t i = 0; i < count; ++i) vectors.emplace_back(values[2 * i], values[2 * i + 1]);
  return vectors;
}

/// Contacts as columns below a group.
void write_contact_columns(Hdf5File& file, const std::string& group, const std::vector<Contact>& contacts) {
  std::vector<std::int32_t> a;
  std::vector<std::int32_t> b;
  std::vector<Vector2> normal;
  std::vector<double> gap, mu, R, T, lever_a, lever_b;
  for (const Contact& c : contacts) {
    a.push_back(c.a.value());
    b.push_back(c.b.code());
    normal.push_back(c.normal);
    gap.push_back(c.gap);
    mu.push_back(c.mu);
    R.push_back(c.R);
    T.push_back(c.T);
    lever_a.push_back(c.lever_a);
    lever_b.push_back(c.lever_b);
  }
  const std::size_t m = contacts.size();
  file.make_group(group);
  file.write(group + "/body_a", a, {m}, {"1", "row of disk a"});
  file.write(group + "/body_b", b, {m}, {"1", "row of disk b, or -(w+1) for the wall of row w"});
  file.write(group + "/normal", flatten(normal), {m, 2}, {"1", "unit normal from b to a x, y"});
  file.write(group + "/gap", gap, {m}, {"length", "distance of the surfaces, negative where they overlap"});
  file.write(group + "/mu", mu, {m}, {"1", "Coulomb friction coefficient"});
  file.write(group + "/R", R, {m}, {"force", "normal force"});
  file.write(group + "/T", T, {m}, {"force", "tangential force"});
  const auto is_given = [](double lever) { return !std::isnan(lever); };
  if (std::none_of(lever_a.begin(), lever_a.end(), is_given) &&
      std::none_of(lever_b.begin(), lever_b.end(), is_given))
    return;
  file.write(group + "/lever_a", lever_a, {m}, {"length", "arm of the torque of T on a, NaN: the radius"});
  file.write(group + "/lever_b", lever_b, {m},
             {"length", "arm of the torque of T on b, NaN: the radius, or a wall"});
}

std::vector<Contact> read_contact_columns(const Hdf5File& file, const std::string& group) {
  const std::size_t m = file.shape(group + "/body_a", 1)[0];
  const auto a = file.read_integers(group + "/body_a", {m});
  const auto b = file.read_integers(group + "/body_b", {m});
  const auto normal = file.read_doubles(group + "/normal", {m, 2});
  const auto gap = file.read_doubles(group + "/gap", {m});
  const auto mu = file.read_doubles(group + "/mu", {m});
  const auto R = file.read_doubles(group + "/R", {m});
  const auto T = file.read_doubles(group + "/T", {m});
  const auto lever = [&](const std::string& name) {
    return file.has(name) ? file.read_doubles(name, {m}) : std::vector<double>(m, kNaN);
  };
  const auto lever_a = lever(group + "/lever_a");
  const auto lever_b = lever(group + "/lever_b");
  const auto disks = static_cast<int>(file.shape("/particles/disks/id", 1)[0]);
  const auto walls = static_cast<int>(file.shape("/walls/id", 1)[0]);
  std::vector<Contact> contacts;
  for (std::size_t i = 0; i < m; ++i) {
    const Body body = Body::from_code(b[i]);
    if (a[i] < 0 || a[i] >= disks || !body.is_among(disks, walls)) {
      throw Hdf5ReadError(fmt::format("{}: {}: row {} joins bodies {} and {}, which are not both there",
                                      file.path().string(), group, i, a[i], b[i]));
    }
    contacts.push_back({.a = DiskId(a[i]),
                        .b = Body::from_code(b[i]),
                        .normal = {normal[2 * i], normal[2 * i + 1]},
                        .gap = gap[i],
                        .mu = mu[i],
                        .R = R[i],
                        .T = T[i],
                        .lever_a = lever_a[i],
                        .lever_b = lever_b[i]});
  }
  return contacts;
}

void write_tilt_part(Hdf5File& file, const TiltRecord& tilt) {
  const std::string group = "/tilt";
  const std::size_t rows = tilt.angle.size();
  file.make_group(group);
  for (const auto& [name, value] : tilt.numbers) file.set_attribute(group, name, value);
  for (const auto& [name, value] : tilt.texts) file.set_attribute(group, name, value);
  file.write(group + "/angle", tilt.angle, {rows}, {"rad", "by which gravity is turned, counter-clockwise"});
  file.write(group + "/contacts", tilt.contacts, {rows}, {"1", "contacts that transmit force"});
  file.write(group + "/sliding", tilt.sliding, {rows}, {"1", "of these, contacts at the Coulomb limit"});
  file.write(group + "/kinetic_energy", tilt.kinetic_energy, {rows}, {"energy", "kinetic energy per disk"});
  file.write(group + "/displacement", tilt.displacement, {rows}, {"length", "largest of all disks"});
  file.write(group + "/moved_at", tilt.moved_at, {tilt.moved_at.size()},
             {"rad", "angle at which the disk first had moved, NaN: never"});
}

void write_trajectory_part(Hdf5File& file, const Trajectory& trajectory) {
  const std::string group = "/trajectory";
  const std::size_t frames = trajectory.size();
  const std::size_t n = trajectory.front().positions.size();
  std::vector<double> time, position, velocity, angle, spin;
  std::vector<std::int32_t> first{0};
  std::vector<Contact> contacts;
  for (const TrajectoryFrame& frame : trajectory) {
    time.push_back(frame.time);
    const std::vector<double> x = flatten(frame.positions);
    const std::vector<double> v = flatten(frame.velocities);
    position.insert(position.end(), x.begin(), x.end());
    velocity.insert(velocity.end(), v.begin(), v.end());
    angle.insert(angle.end(), frame.angles.begin(), frame.angles.end());
    spin.insert(spin.end(), frame.angular_velocities.begin(), frame.angular_velocities.end());
    contacts.insert(contacts.end(), frame.contacts.begin(), frame.contacts.end());
    first.push_back(static_cast<std::int32_t>(contacts.size()));
  }
  file.make_group(group);
  file.write(group + "/time", time, {frames}, {"time", "simulated time"});
  file.write(group + "/position", position, {frames, n, 2}, {"length", "centre x, y"});
  file.write(group + "/velocity", velocity, {frames, n, 2}, {"length/time", "velocity x, y"});
  file.write(group + "/angle", angle, {frames, n}, {"rad", "orientation"});
  file.write(group + "/angular_velocity", spin, {frames, n}, {"rad/time", "angular velocity"});
  file.write(group + "/first_contact", first, {frames + 1}, kCount);
  write_contact_columns(file, group + "/contacts", contacts);
}

Trajectory read_trajectory_part(const Hdf5File& file) {
  const std::string group = "/trajectory";
  const Shape shape = file.shape(group + "/position", 3);
  const std::size_t frames = shape[0];
  const std::size_t n = shape[1];
  const auto time = file.read_doubles(group + "/time", {frames});
  const auto position = file.read_doubles(group + "/position", {frames, n, 2});
  const auto velocity = file.read_doubles(group + "/velocity", {frames, n, 2});
  const auto angle = file.read_doubles(group + "/angle", {frames, n});
  const auto spin = file.read_doubles(group + "/angular_velocity", {frames, n});
  const auto first = file.read_integers(group + "/first_contact", {frames + 1});
  const std::vector<Contact> contacts = read_contact_columns(file, group + "/contacts");
  Trajectory trajectory(frames);
  for (std::size_t f = 0; f < frames; ++f) {
    if (first[f] < 0 || first[f] > first[f + 1] ||
        first[f + 1] > static_cast<std::int64_t>(contacts.size())) {
      throw Hdf5ReadError(fmt::format("{}: /trajectory/first_contact is not in order", file.path().string()));
    }
    TrajectoryFrame& frame = trajectory[f];
    frame.time = time[f];
    frame.positions = unflatten(position.data() + 2 * n * f, n);
    frame.velocities = unflatten(velocity.data() + 2 * n * f, n);
    const auto row = static_cast<std::ptrdiff_t>(n * f);
    const auto end = static_cast<std::ptrdiff_t>(n * (f + 1));
    frame.angles.assign(angle.begin() + row, angle.begin() + end);
    frame.angular_velocities.assign(spin.begin() + row, spin.begin() + end);
    frame.contacts.assign(contacts.begin() + first[f], contacts.begin() + first[f + 1]);
  }
  return trajectory;
}

}  // namespace

void write_simulation_part(Hdf5File& file, const SimulationRecord& record) {
  write_contact_columns(file, "/simulation", record.raw_contacts);
  for (const auto& [name, value] : record.numbers) file.set_attribute("/simulation", name, value);
  for (const auto& [name, value] : record.texts) file.set_attribute("/simulation", name, value);
}

void write_simulation(const std::filesystem::path& path, const Packing& packing,
                      const SimulationRecord& record, const Trajectory& trajectory,
                      const Provenance& provenance) {
  Hdf5File file = Hdf5File::create(path);
  write_header(file, schema_of(packing));
  write_packing_part(file, packing);
  write_simulation_part(file, record);
  if (record.tilt) write_tilt_part(file, *record.tilt);
  if (!trajectory.empty()) write_trajectory_part(file, trajectory);
  write_provenance_part(file, provenance);
  seal(file);
}

Trajectory read_trajectory(const Hdf5File& file) {
  if (!file.has("/trajectory")) {
    throw InputError(fmt::format("{} has no trajectory; simulate with --every", file.path().string()));
  }
  return read_trajectory_part(file);
}

void write_checkpoint(const std::filesystem::path& path, const StoredCheckpoint& checkpoint,
                      const Provenance& provenance) {
  Hdf5File file = Hdf5File::create(path);
  write_header(file, schema_of(checkpoint.state));
  write_packing_part(file, checkpoint.state);
  const std::string group = "/checkpoint";
  const std::size_t m = checkpoint.spring.size();
  file.make_group(group);
  file.set_attribute(group, "fingerprint", checkpoint.fingerprint);
  for (const auto& [name, value] : checkpoint.counters) file.set_attribute(group, name, value);
  file.write(group + "/spring", checkpoint.spring, {m}, {"length", "stretch of the tangential spring"});
  file.write(group + "/change", checkpoint.change, {m}, {"force", "change of R in the last step"});
  if (!checkpoint.trajectory.empty()) write_trajectory_part(file, checkpoint.trajectory);
  write_provenance_part(file, provenance);
  seal(file);
}

StoredCheckpoint read_checkpoint(const Hdf5File& file) {
  const std::string group = "/checkpoint";
  if (!file.has(group)) throw InputError(fmt::format("{} is not a checkpoint", file.path().string()));
  StoredCheckpoint checkpoint;
  checkpoint.fingerprint = file.string_attribute(group, "fingerprint");
  checkpoint.state = read_packing(file);
  const std::size_t m = checkpoint.state.contacts.size();
  checkpoint.spring = file.read_doubles(group + "/spring", {m});
  checkpoint.change = file.read_doubles(group + "/change", {m});
  for (const auto& [name, value] : file.number_attributes(group)) {
    checkpoint.counters[name] = static_cast<std::int64_t>(value);
  }
  if (file.has("/trajectory")) checkpoint.trajectory = read_trajectory_part(file);
  return checkpoint;
}

}  // namespace indet
