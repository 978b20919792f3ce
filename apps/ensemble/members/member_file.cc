#include "apps/ensemble/members/member_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "apps/ensemble/members/paper_walk_step.h"
#include "apps/ensemble/members/write_vector.h"
#include "libindet/base/error.h"
#include "libindet/io/limits_file.h"
#include "libindet/io/ranges_file.h"

namespace indet {
namespace {

void write_counts(Hdf5File& file, const std::string& path, const ExtremalForces& forces, const char* which) {
  std::size_t bins = 0;
  for (const auto& counts : forces.counts) bins = std::max(bins, counts.size());
  std::vector<std::int32_t> values;
  for (auto counts : forces.counts) {
    counts.resize(bins, 0);
    values.insert(values.end(), counts.begin(), counts.end());
  }
  file.write(
      path, values, {4, bins},
      {"1", fmt::format("how often R lies in [k, k+1) mg in the states of R_min, R_max, T_min, T_max; {}",
                        which)});
}

void write_known_distances(Hdf5File& file, const SmallestDistances& smallest) {
  if (smallest.outcome.rows() == 0) return;
  file.set_attribute("/ensemble", "d_min_known", smallest.count(Outcome::kEnclosed));
  file.set_attribute("/ensemble", "d_min_imprecise", smallest.count(Outcome::kImprecise));
  file.set_attribute("/ensemble", "d_min_failed", smallest.count(Outcome::kFailed));
}

void write_ensemble_part(Hdf5File& file, const Member& member, const MemberResult& result) {
  file.make_group("/ensemble");
  file.set_attribute("/ensemble", "member", member.name);
  file.set_attribute("/ensemble", "hash", member.hash);
  file.set_attribute("/ensemble", "config", member.config);
  if (result.solver_d_R.size() > 0) {
    write_vector(
        file, "/ensemble/solver_d_R", result.solver_d_R,
        {"mg", "global indeterminacy of the normal force with the states that the solver happens to find"});
    write_vector(
        file, "/ensemble/solver_d_T", result.solver_d_T,
        {"mg",
         "global indeterminacy of the tangential force with the states that the solver happens to find"});
    write_counts(file, "/ensemble/solver_extremal_R", result.solver_extremal,
                 "states that the solver happens to find");
  }
  write_counts(file, "/ensemble/extremal_R", result.extremal, "canonical states");
  if (result.paper_walk) write_paper_walk(file, *result.paper_walk);
  write_known_distances(file, result.ranges.smallest);
}

}  // namespace

void write_member(const std::filesystem::path& path, const Member& member, const MemberResult& result,
                  const Provenance& provenance) {
  Hdf5File file = Hdf5File::create(path);
  write_header(file, schema_of(result.packing));
  write_packing_part(file, result.packing);
  if (result.simulation) write_simulation_part(file, *result.simulation);
  write_ranges_part(file, result.ranges);
  if (result.sampling) write_sampling_part(file, *result.sampling);
  if (result.uniform) write_uniform_part(file, *result.uniform);
  if (!result.limits.empty()) write_limits_part(file, result.packing, result.limits);
  write_ensemble_part(file, member, result);
  Provenance all = provenance;
  all.seconds = result.ranges.seconds;
  all.seconds.insert(result.seconds.begin(), result.seconds.end());
  write_provenance_part(file, all);
  write_work_part(file, result.ranges);
  seal(file);
}

ItemState examine_member(const std::filesystem::path& path, const Member& member) {
  return examine_item(path, [&](const Hdf5File& file) {
    return file.has("/ensemble") && file.string_attribute("/ensemble", "hash") == member.hash;
  });
}

bool member_is_done(const std::filesystem::path& path, const Member& member) {
  return examine_member(path, member).status == ItemStatus::kDone;
}

}  // namespace indet
