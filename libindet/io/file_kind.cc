#include "libindet/io/file_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "libindet/base/error.h"
#include "libindet/io/csv_writer.h"
#include "libindet/io/ovito_files.h"
#include "libindet/io/packing_file.h"
#include "libindet/io/picture_mark.h"
#include "libindet/io/vtkhdf.h"

namespace indet {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kHdf5Begin = "\x89HDF\r\n\x1a\n";
constexpr std::string_view kPlanBegin = "# The packings of this ensemble. Written by indet;";
constexpr std::string_view kAnalysisPlanBegin = "# The parts of this analysis. Written by indet;";
constexpr std::string_view kReportTitle = "<title>Force indeterminacy: report</title>";

/// Both ends of a file; that is enough to recognise it.
struct Ends {
  std::string head, tail;
};

Ends ends_of(const fs::path& path) {
  constexpr std::streamoff kLength = 4096;
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  if (!stream) throw InputError(fmt::format("{}: cannot be read", path.string()));
  const std::streamoff size = stream.tellg();
  const auto read = [&](std::streamoff from) {
    std::string bytes(static_cast<std::size_t>(std::min(kLength, size)), '\0');
    stream.seekg(from);
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return bytes;
  };
  return {read(0), read(std::max<std::streamoff>(0, size - kLength))};
}

std::optional<FileKind> kind_of_hdf5(const fs::path& path) {
  try {
    return kind_of(open_indet_file(path));
  } catch (const InputError&) {  // of another program, or damaged
    return {};
  }
}

}  // namespace

const char* describe(FileKind kind) {
  switch (kind) {
    case FileKind::kPacking:
      return "a packing";
    case FileKind::kRanges:
      return "force ranges";
    case FileKind::kLimits:
      return "limits of loads";
    case FileKind::kSamples:
      return "samples of contact states";
    case FileKind::kCheckpoint:
      return "the checkpoint of a simulation";
    case FileKind::kMember:
      return "a packing of an ensemble";
    case FileKind::kEnsemble:
      return "the tables of an ensemble";
    case FileKind::kPlan:
      return "the plan of an ensemble";
    case FileKind::kAnalysisPlan:
      return "the plan of an analysis in parts";
    case FileKind::kPicture:
      return "a picture";
    case FileKind::kContactTable:
      return "a table of contacts";
    case FileKind::kCsvScene:
      return "a part of a CSV scene";
    case FileKind::kVtk:
      return "contacts for readers of VTK";
    case FileKind::kParticles:
      return "particles for OVITO";
    case FileKind::kBonds:
      return "bonds for OVITO";
    case FileKind::kReport:
      return "the report of an ensemble";
  }
  return "a file";
}

FileKind kind_of(const Hdf5File& file) {
  if (file.has("/table/runs")) return FileKind::kEnsemble;
  if (file.has("/ensemble")) return FileKind::kMember;
  if (file.has("/checkpoint")) return FileKind::kCheckpoint;
  if (file.has("/ranges")) return FileKind::kRanges;
  if (file.has("/limits")) return FileKind::kLimits;
  if (file.has("/sampling")) return FileKind::kSamples;
  if (has_vtkhdf(file) && !file.has("/contacts")) return FileKind::kVtk;
  return FileKind::kPacking;
}

std::optional<FileKind> recognise(const fs::path& path) {
  const auto [head, tail] = ends_of(path);
  if (head.starts_with(kHdf5Begin)) return kind_of_hdf5(path);
  if (is_marked_picture(head, tail)) return FileKind::kPicture;
  if (is_contact_table(head)) return FileKind::kContactTable;
  if (is_scene_table(head)) return FileKind::kCsvScene;
  if (is_particle_file(head)) return FileKind::kParticles;
  if (is_bond_file(head)) return FileKind::kBonds;
  if (head.starts_with(kPlanBegin)) return FileKind::kPlan;
  if (head.starts_with(kAnalysisPlanBegin)) return FileKind::kAnalysisPlan;
  if (head.starts_with("<!DOCTYPE html>") && head.find(kReportTitle) != std::string::npos)
    return FileKind::kReport;
  return {};
}

}  // namespace indet
