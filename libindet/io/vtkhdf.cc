#include "libindet/io/vtkhdf.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "libindet/io/vtk_grid.h"
#include "libindet/range/result_fields.h"

namespace indet {
namespace {

constexpr const char* kGroup = "/VTKHDF";

std::string cell_data(const std::string& name) { return std::string(kGroup) + "/CellData/" + name; }

/// The grid and the data of its points.
void write_grid(Hdf5File& file, const Packing& packing) {
  const VtkGrid grid = vtk_grid(packing);
  const std::string group = kGroup;
  file.make_group(group);
  const std::array<std::int64_t, 2> version = {1, 0};
  file.set_attribute(group, "Version", std::span<const std::int64_t>(version));
  file.set_fixed_text(group, "Type", "UnstructuredGrid");
  const auto count = [&](const char* name, std::size_t value, const char* meaning) {
    const std::array<std::int64_t, 1> values = {static_cast<std::int64_t>(value)};
    file.write(group + "/" + name, std::span<const std::int64_t>(values), {1}, {"1", meaning});
  };
  count("NumberOfPoints", grid.point_count(), "number of points, of the one part");
  count("NumberOfCells", grid.types.size(), "number of cells, of the one part");
  count("NumberOfConnectivityIds", grid.connectivity.size(), "number of corners, of the one part");
  file.write(group + "/Points", grid.points, {grid.point_count(), 3},
             {"length", "centres of the disks, then the feet of contacts with walls, x, y, 0"});
  file.write(group + "/Connectivity", std::span<const std::int64_t>(grid.connectivity),
             {grid.connectivity.size()}, {"1", "points of each cell: of body a, of body b"});
  file.write(group + "/Offsets", std::span<const std::int64_t>(grid.offsets), {grid.offsets.size()},
             {"1", "where each cell begins in Connectivity, and the end"});
  file.write(group + "/Types", grid.types, {grid.types.size()}, {"1", "3: a line"});
  file.make_group(group + "/PointData");
  file.write(group + "/PointData/radius", grid.radius, {grid.point_count()},
             {"length", "radius of the disk, 0 of a foot"});
  file.write(group + "/PointData/body", grid.body, {grid.point_count()},
             {"1", "row of the disk, or -(w+1) for the wall of row w"});
  if (packing.fixed_disk_count() > 0) {
    file.write(group + "/PointData/fixed", grid.fixed, {grid.point_count()}, {"1", "1 of a fixed disk"});
  }
  file.make_group(group + "/CellData");
}

/// Calls visit(field, table) for each field of the ranges with a row a contact. A table has 1, 2 or 4
/// columns.
template <class Visit>
void visit_contact_fields(const ForceRanges& ranges, const Visit& visit) {
  visit_fields(ranges, [&]<class Value>(const Field& field, const Value& value) {
    if constexpr (requires { value.rows(); }) {
      if (field.rows == Extent::kContacts && is_present(field.presence, ranges, value.rows())) {
        visit(field, value.eval());
      }
    }
  });
}

template <class Table>
constexpr bool kIsOutcome = std::is_same_v<typename Table::Scalar, Outcome>;

template <class Table>
void write_table(Hdf5File& file, const Field& field, const Table& table) {
  using Number = typename Table::Scalar;
  Shape shape = {static_cast<std::size_t>(table.rows())};
  if (field.columns != Extent::kOne) shape.push_back(static_cast<std::size_t>(table.cols()));
  const std::span<const Number> values(table.data(), static_cast<std::size_t>(table.size()));
  const Label label = {field.unit, field.meaning};
  if constexpr (kIsOutcome<Table>) {  // readers of VTK know no enumerations
    std::vector<std::uint8_t> numbers;
    for (const Outcome outcome : values) numbers.push_back(static_cast<std::uint8_t>(outcome));
    file.write(cell_data(field.name), numbers, shape,
               {field.unit, std::string(field.meaning) + ": a value of the enumeration /ranges/outcome"});
  } else {
    file.write(cell_data(field.name), values, shape, label);
  }
}

}  // namespace

void write_vtkhdf_part(Hdf5File& file, const Packing& packing, const ForceRanges& ranges) {
  write_grid(file, packing);
  for (const char* name : {"body_a", "body_b", "gap", "mu", "R", "T"}) {
    file.link(std::string("/contacts/") + name, cell_data(name));
  }
  for (const char* name : {"lever_a", "lever_b"}) {
    if (packing.has_levers()) file.link(std::string("/contacts/") + name, cell_data(name));
  }
  visit_contact_fields(ranges, [&]<class Table>(const Field& field, const Table& table) {
    if constexpr (kIsOutcome<Table>) {
      write_table(file, field, table);
    } else {
      file.link(std::string(field.group) + "/" + field.name, cell_data(field.name));
    }
  });
}

void write_vtkhdf(const std::filesystem::path& path, const Packing& packing,
                  const Eigen::Ref<const Eigen::VectorXd>& forces, const ForceRanges* ranges,
                  const Provenance& provenance) {
  Hdf5File file = Hdf5File::create(path);
  write_header(file);
  write_grid(file, packing);
  const auto count = static_cast<std::size_t>(packing.contact_count());
  std::vector<std::int32_t> a, b;
  std::vector<double> gap, mu, R, T, lever_a, lever_b;
  for (int i = 0; i < packing.contact_count(); ++i) {
    const Contact& contact = packing[ContactId(i)];
    a.push_back(contact.a.value());
    b.push_back(contact.b.code());
    gap.push_back(contact.gap);
    mu.push_back(contact.mu);
    R.push_back(forces[2 * i]);
    T.push_back(forces[2 * i + 1]);
    lever_a.push_back(contact.lever_a);
    lever_b.push_back(contact.lever_b);
  }
  file.write(cell_data("body_a"), a, {count}, {"1", "row of disk a"});
  file.write(cell_data("body_b"), b, {count}, {"1", "row of disk b, or -(w+1) for the wall of row w"});
  file.write(cell_data("gap"), gap, {count},
             {"length", "distance of the surfaces, negative where they overlap"});
  file.write(cell_data("mu"), mu, {count}, {"1", "Coulomb friction coefficient"});
  file.write(cell_data("R"), R, {count}, {"force", "normal force of the chosen state, NaN if unknown"});
  file.write(cell_data("T"), T, {count}, {"force", "tangential force of the chosen state, NaN if unknown"});
  if (packing.has_levers()) {
    file.write(cell_data("lever_a"), lever_a, {count}, {"length", "lever arm on a, NaN: its radius"});
    file.write(cell_data("lever_b"), lever_b, {count},
               {"length", "lever arm on b, NaN: its radius, or a wall"});
  }
  if (ranges != nullptr) {
    visit_contact_fields(*ranges,
                         [&](const Field& field, const auto& table) { write_table(file, field, table); });
  }
  write_provenance_part(file, provenance);
  seal(file);
}

bool has_vtkhdf(const Hdf5File& file) { return file.has(kGroup); }

}  // namespace indet
