#pragma once

#include <filesystem>
#include <string>

#include "apps/batch/item_file.h"
#include "apps/ensemble/members/member.h"

namespace indet {

/// The file of one member is a file of `indet analyze` with /simulation, /sampling, /uniform, /bias, and
///
///     /ensemble  @member @hash @config; solver_d_R, solver_d_T f8[M]; extremal_R, solver_extremal_R i4[4,
///     B];
///                @paper_…; paper_d_R, paper_d_T f8[M] (paper_walk_step.h)
///                @d_min_known, @d_min_imprecise, @d_min_failed where /ranges has smallest distances
///
/// All functions use HDF5: one thread at a time.
void write_member(const std::filesystem::path& path, const Member& member, const MemberResult& result,
                  const Provenance& provenance);

/// Done: it carries the hash of the member.
ItemState examine_member(const std::filesystem::path& path, const Member& member);

bool member_is_done(const std::filesystem::path& path, const Member& member);

}  // namespace indet
