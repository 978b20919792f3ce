#include "apps/file_contents.h"

#include <initializer_list>
#include <vector>

#include "libindet/io/limits_file.h"
#include "libindet/io/ranges_file.h"

namespace indet::app {
namespace {

std::optional<Account> account_of(const Hdf5File& file, const std::string& group,
                                  std::initializer_list<const char*> texts) {
  if (!file.has(group)) return {};
  Account account;
  account.numbers = file.number_attributes(group);
  for (const char* name : texts) account.texts[name] = file.string_attribute(group, name);
  return account;
}

std::optional<TrajectoryExtent> trajectory_of(const Hdf5File& file) {
  if (!file.has("/trajectory")) return {};
  const std::vector<double> times = file.read_doubles("/trajectory/time", file.shape("/trajectory/time", 1));
  if (times.empty()) return TrajectoryExtent{};
  return TrajectoryExtent{times.size(), times.front(), times.back()};
}

}  // namespace

FileContents read_contents(const Hdf5File& file) {
  FileContents contents;
  contents.packing = read_packing(file);
  ImportedPacking for_balance;
  for_balance.packing = contents.packing;
  contents.balance = report_balance(for_balance);
  if (has_ranges(file)) contents.ranges = read_ranges(file);
  if (has_limits(file)) contents.limits = read_limits(file);
  contents.digests = compute_digests(file);
  for (const char* name : {"version", "git", "compiler", "host", "created"}) {
    contents.provenance[name] = file.string_attribute("/provenance", name);
  }
  contents.simulation = account_of(file, "/simulation", {"ending", "reason", "method", "polish"});
  contents.tilt = account_of(file, "/tilt", {"ending"});
  contents.sampling = account_of(file, "/sampling", {"method"});
  contents.trajectory = trajectory_of(file);
  return contents;
}

}  // namespace indet::app
