#include "libindet/io/ovito_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "libindet/io/contact_columns.h"
#include "libindet/io/file_ids.h"
#include "libindet/io/vtk_grid.h"
#include "libindet/io/whole_file.h"

namespace indet {
namespace {

constexpr std::string_view kProperties = "Properties=species:S:1:pos:R:3:id:I:1:radius:R:1:mass:R:1 pbc=\"";
constexpr std::string_view kWriter = " writer=indet\n";
constexpr std::string_view kBondColumns =
    "ITEM: ENTRIES index ParticleIdentifiers.A ParticleIdentifiers.B mu gap R_mg T_mg";

/// The second line of the particles.
std::string comment(const Packing& packing) {
  const auto& [a, b] = packing.cell;
  std::string text = fmt::format("{}{} {} F\"", kProperties, a ? 'T' : 'F', b ? 'T' : 'F');
  if (packing.cell.is_periodic()) {
    Vector2 low = packing.disks.empty() ? Vector2(0, 0) : packing.disks.front().position;
    Vector2 high = low;
    for (const Disk& disk : packing.disks) {
      low = low.cwiseMin(disk.position);
      high = high.cwiseMax(disk.position);
    }
    const double extent = (high - low).norm();
    const auto across = [&](const Vector2& v) -> Vector2 {
      return (extent + 2 * packing.max_radius()) * Vector2(-v.y(), v.x()).normalized();
    };
    const Vector2 first = a ? *a : Vector2(-across(*b));
    const Vector2 second = b ? *b : across(*a);
    text += fmt::format(" Lattice=\"{} {} 0 {} {} 0 0 0 {}\"", first.x(), first.y(), second.x(), second.y(),
                        2 * packing.max_radius());
  }
  return text + std::string(kWriter);
}

/// Of the type of a particle: X a disk, F a fixed one, W the foot of a contact with a wall, I an image.
char species_of(const Packing& packing, const VtkGrid& grid, std::size_t point) {
  if (grid.body[point] < 0) return 'W';
  if (point >= packing.disks.size()) return 'I';
  return grid.fixed[point] != 0 ? 'F' : 'X';
}

/// The ids of the points of a grid: disks, then feet and images.
std::vector<std::int64_t> particle_ids(const Packing& packing, const VtkGrid& grid) {
  const FileIds ids(packing);
  std::vector<std::int64_t> all(ids.disks.begin(), ids.disks.end());
  std::int64_t next = all.empty() ? 0 : *std::max_element(all.begin(), all.end()) + 1;
  while (all.size() < grid.point_count()) all.push_back(next++);
  return all;
}

/// The smallest box that holds all disks and feet, as LAMMPS writes it; a plane has some thickness there.
std::string box_text(const VtkGrid& grid) {
  std::string text = "ITEM: BOX BOUNDS ff ff ff\n";
  for (std::size_t axis = 0; axis < 2; ++axis) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t i = 0; i < grid.point_count(); ++i) {
      low = std::min(low, grid.points[3 * i + axis] - grid.radius[i]);
      high = std::max(high, grid.points[3 * i + axis] + grid.radius[i]);
    }
    text += fmt::format("{} {}\n", low, high);
  }
  const double thickness =
      grid.radius.empty() ? 1 : *std::max_element(grid.radius.begin(), grid.radius.end());
  return text + fmt::format("{} {}\n", -thickness, thickness);
}

std::string particles_text(const Packing& packing) {
  const VtkGrid grid = vtk_grid(packing);
  const std::vector<std::int64_t> ids = particle_ids(packing, grid);
  std::string text = fmt::format("{}\n{}", grid.point_count(), comment(packing));
  for (std::size_t i = 0; i < grid.point_count(); ++i) {
    const bool is_disk = i < packing.disks.size();
    text += fmt::format("{} {} {} 0 {} {} {}\n", species_of(packing, grid, i), grid.points[3 * i],
                        grid.points[3 * i + 1], ids[i],
                        is_disk ? grid.radius[i] : kFootRadius * packing.max_radius(),
                        is_disk ? packing[DiskId(grid.body[i])].mass : 0);
  }
  return text;
}

std::string bonds_text(const Packing& packing, const Eigen::Ref<const Eigen::VectorXd>& forces,
                       const ForceRanges* ranges) {
  const VtkGrid grid = vtk_grid(packing);
  const std::vector<std::int64_t> ids = particle_ids(packing, grid);
  const auto particle = [&](int end) {
    return ids[static_cast<std::size_t>(grid.connectivity[static_cast<std::size_t>(end)])];
  };
  const double mg = packing.force_unit();
  const std::vector<RangeColumn> columns =
      ranges != nullptr ? range_columns(*ranges, mg) : std::vector<RangeColumn>{};
  std::string text = fmt::format("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n{}\n{}{}",
                                 packing.contact_count(), box_text(grid), kBondColumns);
  if (packing.has_levers()) text += " lever_a lever_b";
  for (const RangeColumn& column : columns) {
    text += " " + column.name;
    if (column.end) text += fmt::format(" {}_outcome", to_string(*column.end));
  }
  text += "\n";
  for (int i = 0; i < packing.contact_count(); ++i) {
    const Contact& contact = packing[ContactId(i)];
    text += fmt::format("{} {} {} {} {} {} {}", i + 1, particle(2 * i), particle(2 * i + 1), contact.mu,
                        contact.gap, forces[2 * i] / mg, forces[2 * i + 1] / mg);
    if (packing.has_levers()) {
      const double of_b =
          contact.b.is_wall() ? std::numeric_limits<double>::quiet_NaN() : packing.lever_b(contact);
      text += fmt::format(" {} {}", packing.lever_a(contact), of_b);
    }
    for (const RangeColumn& column : columns) {
      text += fmt::format(" {}", column.values[i]);
      if (column.end) text += fmt::format(" {}", static_cast<int>(ranges->outcome(i, *column.end)));
    }
    text += "\n";
  }
  return text;
}

}  // namespace

void write_ovito_files(const std::filesystem::path& particles, const Packing& packing,
                       const Eigen::Ref<const Eigen::VectorXd>& forces, const ForceRanges* ranges) {
  write_whole_files({{particles, particles_text(packing)},
                     {bonds_path_of(particles), bonds_text(packing, forces, ranges)}});
}

std::filesystem::path bonds_path_of(const std::filesystem::path& particles) {
  return std::filesystem::path(particles).replace_extension(".bonds.dump");
}

bool is_particle_file(std::string_view text) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos) return false;
  const std::string_view second = text.substr(end + 1);
  return second.starts_with(kProperties) && second.substr(0, second.find('\n') + 1).ends_with(kWriter);
}

bool is_bond_file(std::string_view text) {
  return text.starts_with("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n") &&
         text.find(kBondColumns) != std::string_view::npos;
}

}  // namespace indet
