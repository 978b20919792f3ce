#include "libindet/io/ranges_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "libindet/base/error.h"

namespace indet {
namespace {

/// In the order of the values of Outcome.
const EnumNames kOutcomes = {"optimal", "unbounded", "imprecise", "failed", "not_requested"};

constexpr std::array kMethods = {Method::kLp, Method::kPivotingPaper, Method::kPivotingTableau};

constexpr std::array kStatuses = {PolytopeStatus::kBounded, PolytopeStatus::kUnbounded,
                                  PolytopeStatus::kPoint, PolytopeStatus::kEmpty};

// Files and structures have the same fields under the same names; each field is listed once here, for both
// directions.

/// Numbers of the equilibrium problem: attributes of /equilibrium.
template <class Ranges, class Visit>
void for_each_integer(Ranges& r, Visit visit) {
  visit("unknowns", r.unknowns);
  visit("equations", r.equations);
  visit("rank", r.rank);
  visit("nullity", r.nullity);
  visit("dim", r.dim);
  visit("blocks", r.blocks);
  visit("rank_ambiguous", r.rank_ambiguous);
  visit("doubtful", r.doubtful);
  visit("sliding", r.sliding);
  visit("non_transmitting", r.non_transmitting);
  visit("objectives", r.objectives);
  visit("determined", r.determined);
  visit("certified", r.certified);
  visit("imprecise", r.imprecise);
  visit("failed", r.failed);
  visit("unbounded", r.unbounded);
}

template <class Ranges, class Visit>
void for_each_real(Ranges& r, Visit visit) {
  visit("rank_gap", r.rank_gap);
  visit("smallest_accepted", r.smallest_accepted);
  visit("largest_rejected", r.largest_rejected);
  visit("residual", r.residual);
  visit("force_unit", r.force_unit);
  visit("worst_primal_residual", r.worst_primal_residual);
  visit("worst_dual_residual", r.worst_dual_residual);
}

/// One number a contact: datasets of /ranges.
template <class Ranges, class Visit>
void for_each_column(Ranges& r, Visit visit) {
  visit("delta_R", r.delta_R, "local indeterminacy of the normal force, inf where unbounded");
  visit("delta_T", r.delta_T, "local indeterminacy of the tangential force, inf where unbounded");
  visit("d_R", r.d_R, "global indeterminacy of the normal force, NaN where a state is missing");
  visit("d_T", r.d_T, "global indeterminacy of the tangential force, NaN where a state is missing");
  visit("R_star", r.R_star, "place of the simulated normal force in its range, NaN if unknown");
  visit("T_star", r.T_star, "place of the simulated tangential force in its range, NaN if unknown");
}

/// Four reals a contact: datasets of /ranges.
template <class Ranges, class Visit>
void for_each_table(Ranges& r, Visit visit) {
  visit("lower", r.lower, Label{"force", "lower end of the enclosure of R_min, R_max, T_min, T_max"});
  visit("upper", r.upper, Label{"force", "upper end of the enclosure of R_min, R_max, T_min, T_max"});
  visit("sensitivity", r.sensitivity,
        Label{"force/radian",
              "how far the value moves at most, to first order, when every normal turns, per angle"});
  visit("primal_residual", r.primal_residual,
        Label{"mg", "violation of equilibrium and contact conditions by the extremal state"});
  visit("dual_residual", r.dual_residual, Label{"1", "largest reduced cost of the wrong sign"});
}

/// What the paper's method counts: attributes of /provenance/work.
template <class Work, class Visit>
void for_each_count(Work& work, Visit visit) {
  // In the order of InteriorEnd and of WalkEnd.
  constexpr std::array<const char*, kInteriorEnds> kStarts = {"start_simulated", "start_unknown",
                                                              "start_outside", "start_tight_corner"};
  constexpr std::array<const char*, kWalkEnds> kEnds = {"walks_none_better",      "walks_more_active",
                                                        "walks_fewer_active",     "walks_directions_lost",
                                                        "walks_edge_without_end", "walks_step_limit"};
  for (std::size_t end = 0; end < kStarts.size(); ++end) visit(kStarts[end], work.starts[end]);
  for (std::size_t end = 0; end < kEnds.size(); ++end) visit(kEnds[end], work.walks[end]);
  visit("sliding_left", work.sliding_left);
  visit("extremal_points", work.points);
  visit("unexpected_points", work.unexpected);
  visit("neighbours", work.neighbours);
}

template <class Derived>
Shape shape_of(const Eigen::DenseBase<Derived>& array) {
  return {static_cast<std::size_t>(array.rows()), static_cast<std::size_t>(array.cols())};
}

/// The values in C order; `Array` must be stored by rows or be a vector.
template <class Array>
std::span<const typename Array::Scalar> span_of(const Array& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

template <class Array, class T>
void fill(Array& array, std::size_t rows, std::size_t columns, const std::vector<T>& values) {
  array.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  std::copy(values.begin(), values.end(), array.data());
}

void write_equilibrium(Hdf5File& file, const ForceRanges& ranges) {
  const std::string group = "/equilibrium";
  file.make_group(group);
  file.set_attribute(group, "status", to_string(ranges.status));
  for_each_integer(ranges, [&](const char* name, auto value) {
    file.set_attribute(group, name, static_cast<std::int64_t>(value));
  });
  for_each_real(ranges, [&](const char* name, double value) { file.set_attribute(group, name, value); });
  if (ranges.motion.rows() > 0) {
    file.write(
        group + "/motion", span_of(ranges.motion), shape_of(ranges.motion),
        {"1", "virtual velocity x, y and r*omega with which the disks move where no state is admissible"});
  }
}

void write_tables(Hdf5File& file, const ForceRanges& ranges) {
  const std::string group = "/ranges/";
  file.make_group("/ranges");
  const std::array<const char*, 4> names = {"smallest normal force", "largest normal force",
                                            "smallest tangential force", "largest tangential force"};
  for (const Column column : {kMinR, kMaxR, kMinT, kMaxT}) {
    const Eigen::VectorXd values = ranges.value.col(column);
    file.write(group + to_string(column), span_of(values), {static_cast<std::size_t>(values.size())},
               {"force", std::string(names[column]) + ", inf where unbounded, NaN where not found"});
  }
  for_each_column(ranges, [&](const char* name, const Eigen::VectorXd& values, const char* long_name) {
    file.write(group + name, span_of(values), {static_cast<std::size_t>(values.size())}, {"1", long_name});
  });
  for_each_table(ranges, [&](const char* name, const Table4<double>& values, const Label& label) {
    file.write(group + name, span_of(values), shape_of(values), label);
  });
  std::vector<std::uint8_t> outcome;
  for (const Outcome o : span_of(ranges.outcome)) outcome.push_back(static_cast<std::uint8_t>(o));
  file.write_enum(group + "outcome", outcome, shape_of(ranges.outcome), kOutcomes,
                  {"1", "what became of R_min, R_max, T_min, T_max"});
  file.write(group + "unique", span_of(ranges.unique), shape_of(ranges.unique),
             {"1", "1 if only one state attains the value"});
  file.write(group + "vertex", span_of(ranges.vertex), shape_of(ranges.vertex),
             {"1", "row of /extremal/states that attains the value, -1 for none"});
  file.write(group + "ray", span_of(ranges.ray), shape_of(ranges.ray),
             {"1", "row of /extremal/rays along which the value grows without limit, -1 for none"});
}

/// Only where some contacts were left out.
void write_choice(Hdf5File& file, const ForceRanges& ranges) {
  if (ranges.choice == ContactChoice::Kind::kAll) return;
  file.set_attribute("/ranges", "contacts", to_string(ranges.choice));
  file.set_attribute("/ranges", "requested", ranges.requested);
  if (ranges.choice != ContactChoice::Kind::kSample) return;
  file.set_attribute("/ranges", "sample_seed", ranges.sample_seed);
  file.set_attribute("/ranges", "confidence", kConfidence);
  const auto write = [&](const std::string& name, const SampleEstimate& estimate) {
    file.set_attribute("/ranges", "mean_" + name, std::array{estimate.mean, estimate.low, estimate.high});
    file.set_attribute("/ranges", "band_" + name, estimate.band);
  };
  write("delta_R", ranges.sample_R);
  write("delta_T", ranges.sample_T);
}

void write_extremal(Hdf5File& file, const ForceRanges& ranges) {
  file.make_group("/extremal");
  file.set_attribute("/extremal", "largest_norm", ranges.largest_norm);
  file.write("/extremal/states", span_of(ranges.states), shape_of(ranges.states),
             {"force", "extremal states (R_1, T_1, ..., R_M, T_M), each once"});
  file.write("/extremal/norm", span_of(ranges.norm), {static_cast<std::size_t>(ranges.norm.size())},
             {"force", "Euclidean norm of the state"});
  file.write("/extremal/active", span_of(ranges.active), shape_of(ranges.active),
             {"1", "half-planes that define the state: 2a for mu R + T >= 0, 2a+1 for mu R - T >= 0"});
}

void write_rays(Hdf5File& file, const ForceRanges& ranges) {
  if (ranges.rays.rows() == 0) return;
  file.write("/extremal/rays", span_of(ranges.rays), shape_of(ranges.rays),
             {"1", "directions (R_1, T_1, ..., R_M, T_M) in which forces can be added without limit"});
}

[[noreturn]] void fail(const Hdf5File& file, const std::string& object, const std::string& reason) {
  throw Hdf5ReadError(fmt::format("{}: {}: {}", file.path().string(), object, reason));
}

void read_equilibrium(const Hdf5File& file, std::size_t disks, ForceRanges& ranges) {
  const std::string group = "/equilibrium";
  const std::string status = file.string_attribute(group, "status");
  const auto* const found = std::find_if(kStatuses.begin(), kStatuses.end(),
                                         [&](PolytopeStatus s) { return status == to_string(s); });
  if (found == kStatuses.end()) fail(file, group + "@status", fmt::format("\"{}\" is unknown", status));
  ranges.status = *found;
  for_each_integer(ranges, [&](const char* name, auto& value) {
    value = static_cast<std::remove_reference_t<decltype(value)>>(file.integer_attribute(group, name));
  });
  for_each_real(ranges, [&](const char* name, double& value) { value = file.double_attribute(group, name); });
  if (file.has(group + "/motion")) {
    fill(ranges.motion, disks, 3, file.read_doubles(group + "/motion", {disks, 3}));
  }
}

void read_tables(const Hdf5File& file, std::size_t contacts, ForceRanges& ranges) {
  const std::string group = "/ranges/";
  const Shape table = {contacts, 4};
  ranges.value.resize(static_cast<Eigen::Index>(contacts), 4);
  for (const Column column : {kMinR, kMaxR, kMinT, kMaxT}) {
    const auto values = file.read_doubles(group + to_string(column), {contacts});
    std::copy(values.begin(), values.end(), ranges.value.col(column).begin());
  }
  for_each_column(ranges, [&](const char* name, Eigen::VectorXd& values, const char*) {
    fill(values, contacts, 1, file.read_doubles(group + name, {contacts}));
  });
  for_each_table(ranges, [&](const char* name, Table4<double>& values, const Label&) {
    fill(values, contacts, 4, file.read_doubles(group + name, table));
  });
  ranges.outcome.resize(static_cast<Eigen::Index>(contacts), 4);
  const auto outcome = file.read_enum(group + "outcome", table, kOutcomes);
  std::transform(outcome.begin(), outcome.end(), ranges.outcome.data(),
                 [](std::uint8_t value) { return static_cast<Outcome>(value); });
  fill(ranges.unique, contacts, 4, file.read_bytes(group + "unique", table));
  fill(ranges.vertex, contacts, 4, file.read_integers(group + "vertex", table));
  fill(ranges.ray, contacts, 4, file.read_integers(group + "ray", table));
}

void read_choice(const Hdf5File& file, std::size_t contacts, ForceRanges& ranges) {
  ranges.requested = static_cast<int>(contacts);
  if (!file.has_attribute("/ranges", "contacts")) return;
  const std::string choice = file.string_attribute("/ranges", "contacts");
  if (choice == to_string(ContactChoice::Kind::kSample)) {
    ranges.choice = ContactChoice::Kind::kSample;
  } else if (choice == to_string(ContactChoice::Kind::kList)) {
    ranges.choice = ContactChoice::Kind::kList;
  } else {
    fail(file, "/ranges@contacts", fmt::format("\"{}\" is unknown", choice));
  }
  const std::int64_t requested = file.integer_attribute("/ranges", "requested");
  if (requested < 0 || requested > static_cast<std::int64_t>(contacts))
    fail(file, "/ranges@requested", fmt::format("{} of {} contacts", requested, contacts));
  ranges.requested = static_cast<int>(requested);
  if (ranges.choice != ContactChoice::Kind::kSample) return;
  ranges.sample_seed = file.integer_attribute("/ranges", "sample_seed");
  if (file.double_attribute("/ranges", "confidence") != kConfidence)
    fail(file, "/ranges@confidence", fmt::format("is not {}", kConfidence));
  const auto read = [&](const std::string& name, SampleEstimate& estimate) {
    const std::vector<double> mean = file.doubles_attribute("/ranges", "mean_" + name, 3);
    estimate = {mean[0], mean[1], mean[2], file.double_attribute("/ranges", "band_" + name)};
  };
  read("delta_R", ranges.sample_R);
  read("delta_T", ranges.sample_T);
}

void read_extremal(const Hdf5File& file, std::size_t contacts, ForceRanges& ranges) {
  const std::size_t count = file.shape("/extremal/norm", 1)[0];
  fill(ranges.norm, count, 1, file.read_doubles("/extremal/norm", {count}));
  fill(ranges.states, count, 2 * contacts, file.read_doubles("/extremal/states", {count, 2 * contacts}));
  const Shape active = file.shape("/extremal/active", 2);
  fill(ranges.active, count, active[1], file.read_integers("/extremal/active", {count, active[1]}));
  const auto half_planes = static_cast<std::int32_t>(2 * contacts);
  for (const std::int32_t plane : span_of(ranges.active)) {
    if (plane < -1 || plane >= half_planes) {
      fail(file, "/extremal/active", fmt::format("there is no half-plane {}", plane));
    }
  }
  const auto check_row = [&](const char* object, std::int64_t row) {
    if (row < -1 || row >= static_cast<std::int64_t>(count)) {
      fail(file, object, fmt::format("points to state {}, but there are {}", row, count));
    }
  };
  const std::int64_t largest = file.integer_attribute("/extremal", "largest_norm");
  check_row("/extremal@largest_norm", largest);
  ranges.largest_norm = static_cast<int>(largest);
  for (const std::int32_t row : span_of(ranges.vertex)) check_row("/ranges/vertex", row);
  const std::size_t rays = file.has("/extremal/rays") ? file.shape("/extremal/rays", 2)[0] : 0;
  if (rays > 0)
    fill(ranges.rays, rays, 2 * contacts, file.read_doubles("/extremal/rays", {rays, 2 * contacts}));
  for (const std::int32_t row : span_of(ranges.ray)) {
    if (row < -1 || row >= static_cast<std::int64_t>(rays)) {
      fail(file, "/ranges/ray", fmt::format("points to ray {}, but there are {}", row, rays));
    }
  }
}

void read_method(const Hdf5File& file, ForceRanges& ranges) {
  const std::string name = file.string_attribute("/provenance/work", "method");
  const auto* const found = std::find_if(kMethods.begin(), kMethods.end(),
                                         [&](Method method) { return name == to_string(method); });
  if (found == kMethods.end()) fail(file, "/provenance/work@method", fmt::format("\"{}\" is unknown", name));
  ranges.method = *found;
  if (ranges.method != Method::kPivotingPaper) return;
  for_each_count(ranges.paper, [&](const char* attribute, std::int64_t& value) {
    value = file.integer_attribute("/provenance/work", attribute);
  });
}

void read_work(const Hdf5File& file, ForceRanges& ranges) {
  if (file.has_attribute("/provenance/work", "method")) read_method(file, ranges);
  ranges.formulation = file.string_attribute("/provenance/work", "formulation");
  ranges.solves = file.integer_attribute("/provenance/work", "solves");
  ranges.pivots = file.integer_attribute("/provenance/work", "pivots");
  ranges.seconds = file.number_attributes("/provenance/timings");
}

}  // namespace

void write_ranges_part(Hdf5File& file, const ForceRanges& ranges) {
  write_equilibrium(file, ranges);
  write_tables(file, ranges);
  write_choice(file, ranges);
  write_extremal(file, ranges);
  write_rays(file, ranges);
  file.set_attribute("/ranges", "sha256", file.sha256({"/extremal", "/ranges"}));
}

void write_work_part(Hdf5File& file, const ForceRanges& ranges) {
  file.make_group("/provenance/work");
  file.set_attribute("/provenance/work", "method", to_string(ranges.method));
  file.set_attribute("/provenance/work", "formulation", ranges.formulation);
  file.set_attribute("/provenance/work", "solves", ranges.solves);
  file.set_attribute("/provenance/work", "pivots", ranges.pivots);
  if (ranges.method != Method::kPivotingPaper) return;
  for_each_count(ranges.paper, [&](const char* attribute, std::int64_t value) {
    file.set_attribute("/provenance/work", attribute, value);
  });
}

void write_ranges(const std::filesystem::path& path, const Packing& packing, const ForceRanges& ranges,
                  const Provenance& provenance) {
  Hdf5File file = Hdf5File::create(path);
  write_header(file);
  write_packing_part(file, packing);
  write_ranges_part(file, ranges);
  Provenance all = provenance;
  all.seconds.insert(ranges.seconds.begin(), ranges.seconds.end());
  write_provenance_part(file, all);
  write_work_part(file, ranges);
  seal(file);
}

ForceRanges read_ranges(const std::filesystem::path& path) {
  const Hdf5File file = open_indet_file(path);
  if (!file.has("/ranges")) {
    throw Hdf5ReadError(
        fmt::format("{}: has no force ranges; compute them with indet analyze", path.string()));
  }
  const std::size_t disks = file.shape("/particles/disks/id", 1)[0];
  const std::size_t contacts = file.shape("/contacts/body_a", 1)[0];
  ForceRanges ranges;
  read_equilibrium(file, disks, ranges);
  read_tables(file, contacts, ranges);
  read_choice(file, contacts, ranges);
  read_extremal(file, contacts, ranges);
  read_work(file, ranges);
  return ranges;
}

bool file_has_ranges(const std::filesystem::path& path) { return open_indet_file(path).has("/ranges"); }

}  // namespace indet
