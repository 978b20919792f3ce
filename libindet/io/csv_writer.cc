#include "libindet/io/csv_writer.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "libindet/io/contact_columns.h"
#include "libindet/io/destination.h"
#include "libindet/io/file_ids.h"
#include "libindet/io/scene_file.h"
#include "libindet/io/whole_file.h"

namespace indet {
namespace {

// Headers, and what may follow them where a packing has it.
constexpr std::string_view kDisksBegin = "id,x,y,radius,mass,inertia,angle,vx,vy,omega,fx,fy,torque";
constexpr std::string_view kFixedColumn = ",fixed";
constexpr std::string_view kWallsBegin = "id,px,py,nx,ny,name";
constexpr std::string_view kLoadColumns = ",load_n,load_t";
constexpr std::string_view kContactsBegin = "a,b,nx,ny,mu,R,T,gap";
constexpr std::string_view kLeverColumns = ",lever_a,lever_b";
constexpr std::string_view kBoundColumns = ",R_lo,R_hi,T_lo,T_hi";
constexpr std::string_view kImageColumns = ",image_x,image_y";
constexpr std::string_view kTableBegin = "contact,a,b,x,y,nx,ny,gap,mu";

/// The shortest text that reads back as the same number; empty for NaN.
std::string field(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

/// A text in quotation marks, those within it doubled (RFC 4180).
std::string quoted(const std::string& text) {
  if (text.empty()) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + '"';
}

/// Empty for a bound that there is not.
std::string bound_field(double value) { return std::isinf(value) ? "" : field(value); }

/// What follows the other columns of contacts where the packing has it: their names, and the fields of one.
std::string rare_columns(const Packing& packing) {
  std::string text;
  if (packing.has_levers()) text += kLeverColumns;
  if (packing.has_bound_columns()) text += kBoundColumns;
  if (packing.cell.is_periodic()) text += kImageColumns;
  return text;
}

std::string rare_fields(const Packing& packing, const Contact& c) {
  std::string text;
  if (packing.has_levers()) text += fmt::format(",{},{}", field(c.lever_a), field(c.lever_b));
  if (packing.has_bound_columns()) {
    for (const double bound : {c.R_lo, c.R_hi, c.T_lo, c.T_hi}) text += "," + bound_field(bound);
  }
  if (packing.cell.is_periodic()) text += fmt::format(",{},{}", c.image[0], c.image[1]);
  return text;
}

/// True if the rest of a header is rare columns and then `end`.
bool ends_header(std::string_view rest, std::string_view end) {
  for (const std::string_view columns : {kLeverColumns, kBoundColumns, kImageColumns}) {
    if (rest.starts_with(columns)) rest.remove_prefix(columns.size());
  }
  return rest.starts_with(end);
}

/// Adds the header and the columns that follow it.
void begin_table(std::string& text, std::string_view header, bool has_more, std::string_view more) {
  text += header;
  if (has_more) text += more;
  text += '\n';
}

std::string disks_text(const Packing& packing, const FileIds& ids) {
  std::string text;
  const bool has_fixed = packing.fixed_disk_count() > 0;
  begin_table(text, kDisksBegin, has_fixed, kFixedColumn);
  for (std::size_t i = 0; i < packing.disks.size(); ++i) {
    const Disk& d = packing.disks[i];
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}", ids.disks[i], d.position.x(),
                        d.position.y(), d.radius, d.mass, d.inertia, d.angle, d.velocity.x(), d.velocity.y(),
                        d.angular_velocity, d.load.x(), d.load.y(), d.load.z());
    if (has_fixed) text += d.fixed ? ",1" : ",0";
    text += '\n';
  }
  return text;
}

std::string walls_text(const Packing& packing, const FileIds& ids) {
  std::string text;
  const bool has_loads = packing.has_loaded_walls();
  begin_table(text, kWallsBegin, has_loads, kLoadColumns);
  for (std::size_t i = 0; i < packing.walls.size(); ++i) {
    const Wall& w = packing.walls[i];
    text += fmt::format("{},{},{},{},{},{}", ids.walls[i], w.point.x(), w.point.y(), w.normal.x(),
                        w.normal.y(), quoted(w.name));
    if (has_loads) text += fmt::format(",{},{}", field(w.load_n), field(w.load_t));
    text += '\n';
  }
  return text;
}

std::string contacts_text(const Packing& packing, const FileIds& ids,
                          const Eigen::Ref<const Eigen::VectorXd>& forces) {
  std::string text;
  text += fmt::format("{}{}\n", kContactsBegin, rare_columns(packing));
  for (int i = 0; i < packing.contact_count(); ++i) {
    const Contact& c = packing[ContactId(i)];
    text += fmt::format("{},{},{},{},{},{},{},{}", ids.of(c.a), ids.of(c.b), c.normal.x(), c.normal.y(), c.mu,
                        field(forces[2 * i]), field(forces[2 * i + 1]), c.gap);
    text += rare_fields(packing, c) + '\n';
  }
  return text;
}

}  // namespace

void write_csv_scene(const std::filesystem::path& folder, const Packing& packing,
                     const Eigen::Ref<const Eigen::VectorXd>& forces) {
  make_folder(folder);
  const FileIds ids(packing);
  write_whole_files({{folder / "disks.csv", disks_text(packing, ids)},
                     {folder / "walls.csv", walls_text(packing, ids)},
                     {folder / "contacts.csv", contacts_text(packing, ids, forces)},
                     {folder / "scene.toml", scene_file_text(packing)}});
}

void write_contact_table(const std::filesystem::path& path, const Packing& packing,
                         const Eigen::Ref<const Eigen::VectorXd>& forces, const ForceRanges* ranges) {
  const FileIds ids(packing);
  const double mg = packing.force_unit();
  const std::vector<RangeColumn> columns =
      ranges != nullptr ? range_columns(*ranges, mg) : std::vector<RangeColumn>{};
  std::string text(kTableBegin);
  text += rare_columns(packing) + ",R_mg,T_mg";
  for (const RangeColumn& column : columns) {
    text += "," + column.name;
    if (column.end) text += fmt::format(",{}_outcome", to_string(*column.end));
  }
  text += "\n";
  for (int i = 0; i < packing.contact_count(); ++i) {
    const Contact& c = packing[ContactId(i)];
    const Vector2 point = packing.contact_point(c);
    text += fmt::format("{},{},{},{},{},{},{},{},{}", i, ids.of(c.a), ids.of(c.b), point.x(), point.y(),
                        c.normal.x(), c.normal.y(), c.gap, c.mu);
    text += rare_fields(packing, c);
    text += fmt::format(",{},{}", field(forces[2 * i] / mg), field(forces[2 * i + 1] / mg));
    for (const RangeColumn& column : columns) {
      text += "," + field(column.values[i]);
      if (column.end) text += fmt::format(",{}", to_string(ranges->outcome(i, *column.end)));
    }
    text += "\n";
  }
  write_whole_file(path, text);
}

bool is_scene_table(std::string_view text) {
  const auto begins = [&](std::string_view header, std::string_view more) {
    if (!text.starts_with(header)) return false;
    std::string_view rest = text.substr(header.size());
    if (rest.starts_with(more)) rest.remove_prefix(more.size());
    return rest.starts_with('\n');
  };
  if (begins(kDisksBegin, kFixedColumn) || begins(kWallsBegin, kLoadColumns)) return true;
  if (text.starts_with(kContactsBegin)) return ends_header(text.substr(kContactsBegin.size()), "\n");
  return is_scene_file(text);
}

bool is_contact_table(std::string_view text) {
  return text.starts_with(kTableBegin) && ends_header(text.substr(kTableBegin.size()), ",R_mg,");
}

}  // namespace indet
