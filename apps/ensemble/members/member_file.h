#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

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

/// How the file of a member stands.
enum class MemberStatus : std::uint8_t {
  kAbsent,
  kOther,       ///< It is of another configuration, or of no ensemble.
  kUnreadable,  ///< It cannot be opened, or is not complete.
  kDone,        ///< It is complete and carries the hash of the member.
};

struct MemberState {
  MemberStatus status = MemberStatus::kAbsent;
  std::string reason = {};  ///< Why it does not count, with the path; of kOther and kUnreadable.
};

MemberState examine_member(const std::filesystem::path& path, const Member& member);

bool member_is_done(const std::filesystem::path& path, const Member& member);

}  // namespace indet
