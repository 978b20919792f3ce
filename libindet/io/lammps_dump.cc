#include "libindet/io/lammps_dump.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "libindet/base/counted.h"
#include "libindet/base/error.h"
#include "libindet/base/printable.h"

namespace indet {
namespace {

/// A frame that was found in the file, and where its rows begin.
struct FrameHeader {
  std::int64_t timestep = 0;
  std::int64_t rows = 0;   ///< As announced.
  std::int64_t found = 0;  ///< As counted.
  std::array<double, 3> low{}, high{};
  std::array<bool, 3> periodic{};
  bool tilted = false;
  std::array<std::array<double, 3>, 3> edges{};
  int columns_line = 0;
  std::vector<std::string> columns;
  LineReader body{""};
};

/// Finds the frames of a dump without parsing their rows.
class DumpIndex {
 public:
  DumpIndex(std::string source, std::string_view text) : source_(std::move(source)), lines_(text) {
    have_line_ = advance();
    while (have_line_) frames_.push_back(read_frame());
    if (frames_.empty()) throw InputError(fmt::format("{}: the file is empty", source_));
  }

  const FrameHeader& choose(std::optional<std::int64_t> timestep) const {
    if (!timestep) return frames_.back();
    for (const FrameHeader& frame : frames_) {
      if (frame.timestep == *timestep) return frame;
    }
    throw InputError(
        fmt::format("{}: there is no frame of timestep {}; the file has {}, of timesteps {} … {}", source_,
                    *timestep, counted(static_cast<std::int64_t>(frames_.size()), "frame"),
                    frames_.front().timestep, frames_.back().timestep));
  }

 private:
  /// The next line that is not blank.
  bool advance() {
    while (lines_.next(&line_)) {
      if (!trimmed(line_).empty()) return true;
    }
    return false;
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw InputError(fmt::format("{}:{}: {}", source_, lines_.line_number(), reason));
  }

  void need_line() {
    if (!advance()) fail("the file ends within the header of a frame; it is truncated");
  }

  std::int64_t whole_number(const char* what) {
    need_line();
    std::int64_t value = 0;
    if (!parse_number(line_, &value) || value < 0) {
      fail(fmt::format("\"{}\" is not a {}", excerpt(trimmed(line_)), what));
    }
    return value;
  }

  /// `words`: of "ITEM: BOX BOUNDS [xy xz yz | abc origin] [pp ff mm]".
  void read_box(const std::vector<std::string_view>& words, FrameHeader& frame) {
    const bool general = words.size() > 4 && words[3] == "abc" && words[4] == "origin";
    frame.tilted = general || (words.size() > 3 && words[3] == "xy");
    const std::size_t count = general ? 4 : frame.tilted ? 3 : 2;
    std::array<double, 3> tilts{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      need_line();
      const auto fields = split_words(line_);
      std::array<double, 4> numbers{};
      bool valid = fields.size() >= count;
      for (std::size_t i = 0; valid && i < count; ++i) valid = parse_number(fields[i], &numbers[i]);
      if (!valid) {
        fail(general        ? "an edge vector of the box and a component of its origin must be four numbers"
             : frame.tilted ? "the bounds of a tilted box and its tilt must be three numbers"
                            : "the bounds of the box must be two numbers");
      }
      if (general) {
        for (std::size_t i = 0; i < 3; ++i) {
          frame.edges[axis][i] = numbers[i];
          (numbers[i] < 0 ? frame.low : frame.high)[i] += numbers[i];
        }
        frame.low[axis] += numbers[3];
        frame.high[axis] += numbers[3];
      } else {
        frame.low[axis] = numbers[0];
        frame.high[axis] = numbers[1];
        frame.edges[axis][axis] = numbers[1] - numbers[0];
        tilts[axis] = numbers[2];
      }
      // The boundary flags are the last three words; dumps of old versions have none.
      const std::string_view flag = words.size() >= 6 ? words[words.size() - 3 + axis] : std::string_view();
      frame.periodic[axis] = flag.starts_with('p');
    }
    if (general) return;
    // The bounds are those of all points of the tilted box: a = (lx, 0, 0), b = (xy, ly, 0), c = (xz, yz,
    // lz).
    const auto [xy, xz, yz] = tilts;
    frame.edges[0][0] -= std::max({0.0, xy, xz, xy + xz}) - std::min({0.0, xy, xz, xy + xz});
    frame.edges[1][0] = xy;
    frame.edges[1][1] -= std::abs(yz);
    frame.edges[2][0] = xz;
    frame.edges[2][1] = yz;
  }

  FrameHeader read_frame() {
    FrameHeader frame;
    bool has_timestep = false;
    std::string label;
    while (true) {
      auto words = split_words(line_);
      if (words.size() < 2 || words[0] != "ITEM:") {
        fail(frames_.empty() && !has_timestep && frame.rows == 0
                 ? "this is not a LAMMPS text dump: it does not begin with ITEM: TIMESTEP"
                 : "a line that begins with ITEM: is expected");
      }
      const std::string_view item = trimmed(trimmed(line_).substr(5));
      if (item == "TIMESTEP") {
        frame.timestep = whole_number("timestep");
        has_timestep = true;
      } else if (item.starts_with("NUMBER OF ")) {
        label = trimmed(item.substr(10));
        frame.rows = whole_number("number of rows");
      } else if (item.starts_with("BOX BOUNDS")) {
        read_box(words, frame);
      } else if (item == "UNITS" || item == "TIME") {
        need_line();
      } else if (!label.empty() && item.starts_with(label)) {
        if (!has_timestep) fail("the header of the frame has no ITEM: TIMESTEP");
        for (const std::string_view word : split_words(item.substr(label.size()))) {
          frame.columns.emplace_back(word);
        }
        break;
      } else {
        fail(fmt::format("ITEM: {} is unknown", item));
      }
      need_line();
    }
    if (frame.columns.empty()) {
      fail(
          fmt::format("ITEM: {} names no columns, as in dumps of very old versions of LAMMPS; write them "
                      "behind it, for example \"id type x y radius mass\"",
                      label));
    }
    frame.columns_line = lines_.line_number();
    frame.body = lines_;
    while ((have_line_ = advance()) && !line_.starts_with("ITEM:")) {
      if (frame.found == frame.rows) fail(fmt::format("more rows than the {} announced", frame.rows));
      ++frame.found;
    }
    return frame;
  }

  std::string source_;
  LineReader lines_;
  std::string_view line_;
  bool have_line_ = false;
  std::vector<FrameHeader> frames_;
};

}  // namespace

DumpFrame read_dump_frame(const std::filesystem::path& path, std::optional<std::int64_t> timestep) {
  const auto text = read_text(path);
  const DumpIndex index(path.string(), *text);
  const FrameHeader& header = index.choose(timestep);
  if (header.found < header.rows) {
    throw InputError(
        fmt::format("{}: the frame of timestep {} has only {} of its {} rows; the file is truncated",
                    path.string(), header.timestep, header.found, header.rows));
  }
  DumpFrame frame{header.timestep,
                  header.low,
                  header.high,
                  header.periodic,
                  header.tilted,
                  header.edges,
                  Table(path.string(), text, header.columns_line, header.columns)};
  LineReader lines = header.body;
  std::string_view line;
  while (frame.table.rows() < header.rows && lines.next(&line)) {
    auto words = split_words(line);
    if (!words.empty()) frame.table.add_row(lines.line_number(), std::move(words));
  }
  return frame;
}

bool DumpPair::is_periodic(const Plane& plane) const {
  return atoms.periodic[static_cast<std::size_t>(plane.first)] ||
         atoms.periodic[static_cast<std::size_t>(plane.second)];
}

Cell DumpPair::cell(const Plane& plane) const {
  Cell cell;
  for (const int axis : {plane.first, plane.second}) {
    if (!atoms.periodic[static_cast<std::size_t>(axis)]) continue;
    const auto& edge = atoms.edges[static_cast<std::size_t>(axis)];
    if (edge[static_cast<std::size_t>(plane.normal)] != 0) {
      throw InputError(fmt::format("{}: the edge ({}, {}, {}) of the periodic box leaves the plane {}",
                                   atoms.table.source(), edge[0], edge[1], edge[2], plane.name()));
    }
    (axis == plane.first ? cell.a : cell.b) =
        Vector2(edge[static_cast<std::size_t>(plane.first)], edge[static_cast<std::size_t>(plane.second)]);
  }
  return cell;
}

DumpPair read_dumps(const DumpFiles& files) {
  DumpPair dumps{read_dump_frame(files.atoms, files.timestep),
                 read_dump_frame(files.contacts, files.timestep)};
  if (dumps.atoms.timestep != dumps.contacts.timestep) {
    throw InputError(fmt::format(
        "{} ends with timestep {}, {} with {}; choose a timestep that both have with "
        "--timestep",
        files.atoms.string(), dumps.atoms.timestep, files.contacts.string(), dumps.contacts.timestep));
  }
  return dumps;
}

}  // namespace indet
