#include "apps/ensemble/tables/ensemble_file.h"

#include <fmt/format.h>

#include "libindet/base/error.h"

namespace indet {
namespace {

/// A curve as an NXdata group (NeXus): any viewer of NeXus files plots it.
void write_series(Hdf5File& file, const std::string& group, const Panel& panel, const Series& series) {
  file.make_group(group);
  file.set_attribute(group, "NX_class", "NXdata");
  file.set_attribute(group, "signal", "y");
  file.set_attribute(group, "axes", std::vector<std::string>{"x"});
  file.set_attribute(group, "title", series.name);
  file.write(group + "/x", series.x, {series.x.size()}, {"1", panel.x.label});
  file.write(group + "/y", series.y, {series.y.size()}, {"1", panel.y.label});
  if (!series.error.empty())
    file.write(group + "/y_errors", series.error, {series.error.size()},
               {"1", "standard error over the seeds"});
}

void write_figure(Hdf5File& file, const Figure& figure) {
  const std::string group = "/figures/" + figure.id;
  file.make_group(group);
  file.set_attribute(group, "NX_class", "NXentry");
  file.set_attribute(group, "title", figure.title);
  file.set_attribute(group, "caption", figure.caption);
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    for (std::size_t s = 0; s < figure.panels[p].series.size(); ++s) {
      write_series(file, fmt::format("{}/panel{}_curve{}", group, p + 1, s + 1), figure.panels[p],
                   figure.panels[p].series[s]);
    }
  }
}

}  // namespace

void write_ensemble(const std::filesystem::path& path, const EnsembleContents& contents,
                    const std::vector<Figure>& figures, const Provenance& provenance) {
  Hdf5File file = Hdf5File::create(path);
  write_header(file);
  file.make_group("/ensemble");
  file.set_attribute("/ensemble", "config", contents.config);
  file.set_attribute("/ensemble", "hash", contents.hash);
  file.write_strings("/ensemble/missing", contents.missing, {"1", "members that are not in the tables"});
  file.make_group("/table");
  contents.tables.runs.write(file, "/table/runs");
  contents.tables.contacts.write(file, "/table/contacts");
  contents.tables.reactions.write(file, "/table/reactions");
  contents.tables.extremal.write(file, "/table/extremal");
  contents.tables.sampled.write(file, "/table/sampled");
  file.make_group("/figures");
  for (const Figure& figure : figures) write_figure(file, figure);
  write_provenance_part(file, provenance);
  contents.tables.timings.write(file, "/provenance/members");
  std::vector<std::string> members, reasons;
  for (const ItemFailure& failure : contents.failures) {
    members.push_back(failure.item);
    reasons.push_back(failure.reason);
  }
  file.make_group("/provenance/failures");
  file.write_strings("/provenance/failures/member", members, {"1", "name of the packing"});
  file.write_strings("/provenance/failures/reason", reasons, {"1", "why there is none"});
  seal(file);
}

EnsembleContents read_ensemble(const Hdf5File& file) {
  if (!file.has("/table/runs")) throw InputError(fmt::format("{} is not an ensemble", file.path().string()));
  if (!file.has("/table/runs/d_min_known")) {  // the column that was the last to come
    throw InputError(fmt::format(
        "{} was written by an earlier indet; the indet ensemble command that made it writes it anew",
        file.path().string()));
  }
  EnsembleContents contents;
  contents.config = file.string_attribute("/ensemble", "config");
  contents.hash = file.string_attribute("/ensemble", "hash");
  contents.missing = file.read_strings("/ensemble/missing", file.shape("/ensemble/missing", 1)[0]);
  contents.tables.runs.read(file, "/table/runs");
  contents.tables.contacts.read(file, "/table/contacts");
  // Earlier versions have none.
  if (file.has("/table/reactions")) contents.tables.reactions.read(file, "/table/reactions");
  contents.tables.extremal.read(file, "/table/extremal");
  contents.tables.sampled.read(file, "/table/sampled");
  contents.tables.timings.read(file, "/provenance/members");
  const std::size_t failures = file.shape("/provenance/failures/member", 1)[0];
  const auto members = file.read_strings("/provenance/failures/member", failures);
  const auto reasons = file.read_strings("/provenance/failures/reason", failures);
  for (std::size_t i = 0; i < failures; ++i) contents.failures.push_back({members[i], reasons[i]});
  return contents;
}

}  // namespace indet
