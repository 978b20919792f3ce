#include "libindet/io/mercury_frames.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/io/packing_builder.h"

namespace indet {
namespace {

constexpr std::size_t kHeadOfTwo = 6;    ///< Numbers at the head of a frame of two dimensions,
constexpr std::size_t kHeadOfThree = 8;  ///< and of three.
constexpr int kHeadOfContacts = 3;       ///< Lines.

struct Line {
  int number = 0;
  std::string_view text;
};

/// A frame whose rows have not been read.
struct RawFrame {
  double time = 0;
  Line head;
  std::vector<Line> rows;
  bool spatial = false;
};

struct TextFile {
  std::string source;
  std::shared_ptr<const std::string> text;
  std::vector<Line> lines;  ///< That are not blank.
};

TextFile read_lines(const std::filesystem::path& path) {
  TextFile file{.source = path.string(), .text = read_text(path), .lines = {}};
  LineReader reader(*file.text);
  Line line;
  while (reader.next(&line.text)) {
    line.number = reader.line_number();
    if (!trimmed(line.text).empty()) file.lines.push_back(line);
  }
  if (file.lines.empty()) throw InputError(fmt::format("{}: the file is empty", file.source));
  return file;
}

double parse_time(std::string_view text, const Place& place) {
  double time = 0;
  if (!parse_number(text, &time) || !std::isfinite(time))
    place.fail(fmt::format("\"{}\" is not the time of a frame", excerpt(text)));
  return time;
}

/// The head of a frame of particles; its rows are `count`.
RawFrame parse_head(const Line& line, const Place& place, std::size_t* count) {
  const std::vector<std::string_view> words = split_words(line.text);
  double particles = 0;
  if (words.size() != kHeadOfTwo && words.size() != kHeadOfThree) {
    place.fail(
        fmt::format("a frame must begin with a line of {} or {} numbers (particles, time, box), but this one "
                    "has {}",
                    kHeadOfTwo, kHeadOfThree, words.size()));
  }
  if (!parse_number(words[0], &particles) || particles != std::floor(particles) || particles < 0 ||
      particles > 1e9) {
    place.fail(
        fmt::format("a frame must begin with the number of its particles, but \"{}\" is none; does the frame "
                    "before have more rows than it announces?",
                    excerpt(words[0])));
  }
  *count = static_cast<std::size_t>(particles);
  return {
      .time = parse_time(words[1], place), .head = line, .rows = {}, .spatial = words.size() == kHeadOfThree};
}

std::vector<RawFrame> frames_of_particles(const TextFile& file) {
  std::vector<RawFrame> frames;
  for (std::size_t i = 0; i < file.lines.size();) {
    std::size_t count = 0;
    RawFrame frame = parse_head(file.lines[i], {file.source, file.lines[i].number}, &count);
    const std::size_t left = file.lines.size() - ++i;
    if (count > left) {
      throw InputError(
          fmt::format("{}: the frame in line {} announces {} particles, but {} lines follow; the file "
                      "is truncated",
                      file.source, frame.head.number, count, left));
    }
    const auto first = file.lines.begin() + static_cast<std::ptrdiff_t>(i);
    frame.rows.assign(first, first + static_cast<std::ptrdiff_t>(count));
    i += count;
    frames.push_back(std::move(frame));
  }
  return frames;
}

std::vector<RawFrame> frames_of_contacts(const TextFile& file) {
  std::vector<RawFrame> frames;
  int heads = kHeadOfContacts;  // lines of the head so far
  for (const Line& line : file.lines) {
    const Place place{file.source, line.number};
    if (!trimmed(line.text).starts_with('#')) {
      if (frames.empty() || heads < kHeadOfContacts) {
        place.fail("three lines that begin with # must stand before the contacts of a frame");
      }
      frames.back().rows.push_back(line);
      continue;
    }
    if (heads == kHeadOfContacts || !frames.back().rows.empty()) {
      if (heads < kHeadOfContacts) place.fail("a frame must begin with three lines that begin with #");
      const std::vector<std::string_view> words = split_words(trimmed(line.text).substr(1));
      if (words.empty()) place.fail("the first line of a frame must have its time");
      frames.push_back({.time = parse_time(words[0], place), .head = line, .rows = {}, .spatial = false});
      heads = 0;
    }
    ++heads;
  }
  if (heads < kHeadOfContacts) {
    throw InputError(fmt::format("{}: the file ends in the head of a frame; it is truncated", file.source));
  }
  return frames;
}

/// "0.48, 0.49, 0.5", of many the last ones.
std::string list_times(const std::vector<RawFrame>& frames) {
  constexpr std::size_t kListed = 10;
  std::vector<std::string> times;
  times.reserve(frames.size());
  for (const RawFrame& frame : frames) times.push_back(fmt::format("{}", frame.time));
  const bool many = times.size() > kListed;
  if (many) times.erase(times.begin(), times.end() - kListed);
  return (many ? "…, " : "") + fmt::format("{}", fmt::join(times, ", "));
}

/// The last frame of this time; null if there is none. Both files print times alike, so that they are equal
/// to the last bit.
const RawFrame* find_frame(const std::vector<RawFrame>& frames, double time) {
  const auto found =
      std::find_if(frames.rbegin(), frames.rend(), [&](const RawFrame& frame) { return frame.time == time; });
  return found == frames.rend() ? nullptr : &*found;
}

Table read_table(const TextFile& file, const RawFrame& frame, std::vector<std::string> columns) {
  Table table(file.source, file.text, frame.head.number, std::move(columns));
  for (const Line& line : frame.rows) table.add_row(line.number, split_words(line.text));
  return table;
}

}  // namespace

std::optional<MercuryFiles> MercuryFiles::of(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  const auto with = [&](std::string_view from, std::string_view to) {
    std::string other = name;
    return file.parent_path() / other.replace(name.rfind(from), from.size(), to);
  };
  const auto names = [&](std::string_view part) {
    const std::size_t at = name.rfind(part);
    const std::size_t end = at + part.size();
    return at != std::string::npos && (end == name.size() || name[end] == '.');
  };
  if (names(".data")) return MercuryFiles{.data = file, .fstat = with(".data", ".fstat")};
  if (names(".fstat")) return MercuryFiles{.data = with(".fstat", ".data"), .fstat = file};
  return {};
}

MercuryFrame read_mercury_frame(const MercuryFiles& files, std::optional<double> time) {
  for (const auto& [file, what, other] :
       {std::tuple(files.data, "particles", files.fstat), std::tuple(files.fstat, "contacts", files.data)}) {
    std::error_code status;
    if (std::filesystem::exists(file, status) || status) continue;
    throw InputError(
        fmt::format("{}: there is no such file; it has the {} of {}", file.string(), what, other.string()));
  }
  const TextFile data = read_lines(files.data);
  const TextFile fstat = read_lines(files.fstat);
  const std::vector<RawFrame> particles = frames_of_particles(data);
  const std::vector<RawFrame> contacts = frames_of_contacts(fstat);
  const RawFrame* found = nullptr;
  const RawFrame* with_contacts = nullptr;
  for (auto frame = contacts.rbegin(); frame != contacts.rend() && found == nullptr; ++frame) {
    if (time && frame->time != *time) continue;
    found = find_frame(particles, frame->time);
    with_contacts = &*frame;
  }
  if (found == nullptr) {
    throw InputError(
        fmt::format("{}: there is no frame {}; {} has {}, {} has {}", data.source,
                    time ? fmt::format("at time {} in both files", *time) : "whose time both files have",
                    files.data.filename().string(), list_times(particles), files.fstat.filename().string(),
                    list_times(contacts)));
  }
  std::vector<std::string> warnings;
  if (!time && (found != &particles.back() || with_contacts != &contacts.back())) {
    warnings.push_back(fmt::format("{} ends at time {}, {} at {}; the last frame of both, at {}, is read",
                                   data.source, particles.back().time, fstat.source, contacts.back().time,
                                   found->time));
  }
  return {.time = found->time,
          .particles = read_table(
              data, *found,
              found->spatial
                  ? std::vector<std::string>{"x", "y", "z", "vx", "vy", "vz", "radius", "angle_x", "angle_y",
                                             "angle_z", "omega_x", "omega_y", "omega_z", "info"}
                  : std::vector<std::string>{"x", "y", "vx", "vy", "radius", "angle", "omega", "info"}),
          .contacts = read_table(fstat, *with_contacts,
                                 {"time", "i", "j", "cx", "cy", "cz", "overlap", "slip", "normal_force",
                                  "tangential_force", "nx", "ny", "nz", "tx", "ty", "tz"}),
          .warnings = std::move(warnings)};
}

}  // namespace indet
