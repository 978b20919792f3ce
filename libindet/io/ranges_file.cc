#include "libindet/io/ranges_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/io/packing_file.h"
#include "libindet/io/vtkhdf.h"
#include "libindet/range/result_fields.h"

namespace indet {
namespace {

/// In the order of the values of Outcome.
const EnumNames kOutcomes = {"optimal",       "unbounded", "imprecise", "failed",
                             "not_requested", "enclosed",  "estimate"};
/// Files name no more of them than they need, so that versions before the last ones read them.
constexpr std::ptrdiff_t kFewestOutcomes = 5;

constexpr std::array kStatuses = {PolytopeStatus::kBounded, PolytopeStatus::kUnbounded,
                                  PolytopeStatus::kPoint, PolytopeStatus::kEmpty};
constexpr std::array kChoices = {ContactChoice::Kind::kAll, ContactChoice::Kind::kSample,
                                 ContactChoice::Kind::kList, ContactChoice::Kind::kCalibration};

/// Attributes that are stored as text: all values of their type.
constexpr const auto& values_of(Method) { return kMethods; }
constexpr const auto& values_of(NeighbourRule) { return kNeighbourRules; }
constexpr const auto& values_of(WalkStart) { return kWalkStarts; }
constexpr const auto& values_of(StateChoice::Kind) { return kStateKinds; }
constexpr const auto& values_of(StateChoice::Contacts) { return kKindsOfStateContacts; }
constexpr const auto& values_of(PolytopeStatus) { return kStatuses; }
constexpr const auto& values_of(ContactChoice::Kind) { return kChoices; }
constexpr const auto& values_of(DrawEstimator) { return kDrawEstimators; }

constexpr const char* kWork = "/provenance/work";

bool is(const char* text, std::string_view other) { return text == other; }

std::string path_of(const Field& field) { return std::string(field.group) + "/" + field.name; }

/// Writes the fields of some groups.
class FieldWriter {
 public:
  FieldWriter(Hdf5File& file, const ForceRanges& ranges, bool work)
      : file_(file), ranges_(ranges), work_(work) {}

  template <class Value>
  void operator()(const Field& field, const Value& value) {
    if (is(field.group, kWork) != work_) return;
    if constexpr (requires { value.rows(); }) {
      if (is_present(field.presence, ranges_, value.rows())) write(field, value.eval());
    } else {
      if (is_present(field.presence, ranges_, 1)) set_attribute(field, value);
    }
  }

 private:
  template <class Table>
  void write(const Field& field, const Table& table) {
    using Number = typename Table::Scalar;
    Shape shape = {static_cast<std::size_t>(table.rows())};
    if (field.columns != Extent::kOne) shape.push_back(static_cast<std::size_t>(table.cols()));
    const std::span<const Number> values(table.data(), static_cast<std::size_t>(table.size()));
    const Label label = {field.unit, field.meaning};
    if constexpr (std::is_same_v<Number, Outcome>) {
      std::vector<std::uint8_t> numbers;
      std::ptrdiff_t named = kFewestOutcomes;
      for (const Outcome outcome : values) {
        numbers.push_back(static_cast<std::uint8_t>(outcome));
        named = std::max<std::ptrdiff_t>(named, numbers.back() + 1);
      }
      const EnumNames names(kOutcomes.begin(), kOutcomes.begin() + named);
      file_.write_enum(path_of(field), numbers, shape, names, label);
    } else {
      file_.write(path_of(field), values, shape, label);
    }
  }

  void set_attribute(const Field& field,
                     const std::tuple<const double&, const double&, const double&>& value) {
    const std::array<double, 3> numbers = {std::get<0>(value), std::get<1>(value), std::get<2>(value)};
    file_.set_attribute(field.group, field.name, numbers);
  }
  template <class Value>
  void set_attribute(const Field& field, const Value& value) {
    if constexpr (std::is_enum_v<Value>) {
      file_.set_attribute(field.group, field.name, to_string(value));
    } else if constexpr (std::is_integral_v<Value>) {
      file_.set_attribute(field.group, field.name, static_cast<std::int64_t>(value));
    } else {
      file_.set_attribute(field.group, field.name, value);
    }
  }

  Hdf5File& file_;
  const ForceRanges& ranges_;
  bool work_;
};

[[noreturn]] void fail(const Hdf5File& file, const std::string& object, const std::string& reason) {
  throw Hdf5ReadError(fmt::format("{}: {}: {}", file.path().string(), object, reason));
}

/// Reads all fields; those that decide about others come first.
class FieldReader {
 public:
  FieldReader(const Hdf5File& file, const ForceRanges& ranges) : file_(file), ranges_(ranges) {
    sizes_[Extent::kOne] = 1;
    sizes_[Extent::kDirections] = 2;
    sizes_[Extent::kComponents] = 3;
    sizes_[Extent::kColumns] = 4;
    sizes_[Extent::kEnds] = 2;
    sizes_[Extent::kDisks] = file.shape("/particles/disks/id", 1)[0];
    sizes_[Extent::kWalls] = file.shape("/walls/id", 1)[0];
    sizes_[Extent::kContacts] = file.shape("/contacts/body_a", 1)[0];
    sizes_[Extent::kForces] = 2 * sizes_[Extent::kContacts];
  }

  template <class Value>
  void operator()(const Field& field, Value&& value) {
    if constexpr (requires { value.rows(); }) {
      if (field.presence == Presence::kWhereRows && !file_.has(path_of(field))) {
        resize(value, 0, size(field.columns));
      } else if (is(field.name, "sensitivity_claim") && !file_.has(path_of(field))) {
        resize(value, size(field.rows), size(field.columns));
        value.setZero();  // of an earlier version: no claim
      } else {
        read(field, value);
      }
    } else {
      if (is_stored(field)) read_attribute(field, value);
    }
  }

 private:
  bool is_stored(const Field& field) const {
    // A file of all contacts, or of contacts that were equally likely, does not say so, and one of an earlier
    // version not which states it has, by which estimator a mean was found (there was one), or by which
    // method it was made, or how.
    const bool may_lack =
        is(field.group, "/ranges") &&
        (is(field.name, "contacts") || is(field.name, "draws") || is(field.name, "estimator") ||
         is(field.name, "states") || is(field.name, "states_of"));
    const bool may_be_older =
        is(field.group, kWork) && (is(field.name, "method") || is(field.name, "reason") ||
                                   is(field.name, "neighbour_rule") || is(field.name, "walk_start"));
    const bool tells_itself = field.presence == Presence::kInterval ||
                              field.presence == Presence::kEstimate || field.presence == Presence::kSeed ||
                              field.presence == Presence::kUnknownBlocks ||
                              field.presence == Presence::kExact || field.presence == Presence::kHairline;
    if (may_lack || may_be_older || tells_itself) return file_.has_attribute(field.group, field.name);
    return is_present(field.presence, ranges_, 1);
  }

  /// The sizes that the packing does not tell are those of the first table that has them.
  std::size_t size(Extent extent) const { return sizes_.contains(extent) ? sizes_.at(extent) : 0; }

  Shape shape_of(const Field& field) {
    const bool is_matrix = field.columns != Extent::kOne;
    const std::string path = path_of(field);
    for (const Extent extent : {field.rows, field.columns}) {
      if (!sizes_.contains(extent))
        sizes_[extent] = file_.shape(path, is_matrix ? 2 : 1)[extent == field.rows ? 0 : 1];
    }
    return is_matrix ? Shape{size(field.rows), size(field.columns)} : Shape{size(field.rows)};
  }

  template <class Table>
  static void resize(Table& table, std::size_t rows, std::size_t columns) {
    table.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  }

  template <class Table>
  void read(const Field& field, Table& table) {
    using Number = typename Table::Scalar;
    const Shape shape = shape_of(field);
    const std::string path = path_of(field);
    const auto fill = [&](const auto& values) {
      if constexpr (std::is_same_v<Table, typename Table::PlainObject>) {
        resize(table, shape[0], shape.size() == 2 ? shape[1] : 1);
        std::transform(values.begin(), values.end(), table.data(),
                       [](auto number) { return static_cast<Number>(number); });
      } else {  // a column of a table that has its size
        std::copy(values.begin(), values.end(), table.begin());
      }
    };
    if constexpr (std::is_same_v<Number, Outcome>) {
      fill(file_.read_enum(path, shape, kOutcomes));
    } else if constexpr (std::is_same_v<Number, double>) {
      fill(file_.read_doubles(path, shape));
    } else if constexpr (std::is_same_v<Number, std::int32_t>) {
      fill(file_.read_integers(path, shape));
    } else {
      fill(file_.read_bytes(path, shape));
    }
  }

  void read_attribute(const Field& field, std::tuple<double&, double&, double&>& value) {
    const std::vector<double> numbers = file_.doubles_attribute(field.group, field.name, 3);
    value = std::tuple(numbers[0], numbers[1], numbers[2]);
  }
  void read_attribute(const Field& field, double& value) {
    value = file_.double_attribute(field.group, field.name);
  }
  void read_attribute(const Field& field, std::string& value) {
    value = file_.string_attribute(field.group, field.name);
  }
  template <class Value>
  void read_attribute(const Field& field, Value& value) {
    const auto refuse = [&](const std::string& reason) {
      fail(file_, std::string(field.group) + "@" + field.name, reason);
    };
    if constexpr (std::is_enum_v<Value>) {
      const std::string text = file_.string_attribute(field.group, field.name);
      const auto& values = values_of(value);
      const auto found =
          std::find_if(values.begin(), values.end(), [&](Value v) { return text == to_string(v); });
      if (found == values.end()) refuse(fmt::format("\"{}\" is unknown", excerpt(text)));
      value = *found;
    } else {
      const std::int64_t number = file_.integer_attribute(field.group, field.name);
      value = static_cast<Value>(number);
      if (static_cast<std::int64_t>(value) != number) refuse(fmt::format("{} is out of range", number));
    }
  }

  const Hdf5File& file_;
  const ForceRanges& ranges_;
  std::map<Extent, std::size_t> sizes_;
};

/// What was drawn is told of every contact, and counts up.
void check_draw(const Hdf5File& file, const ContactDraw& draw) {
  const auto refuse = [&](const char* object) { fail(file, object, "does not go with the draws"); };
  if (draw.draws < 0) refuse("/ranges@draws");
  if ((draw.draws > 0) != (draw.weight.size() > 0)) refuse("/ranges/draw_weight");
  if (draw.drawn.size() != draw.weight.size() || draw.drawn.cast<std::int64_t>().sum() != draw.draws ||
      (draw.drawn < 0).any())
    refuse("/ranges/drawn");
  if ((draw.weight <= 0).any()) refuse("/ranges/draw_weight");
  if (draw.draws > 0 && draw.centre.rows() != draw.weight.size()) refuse("/ranges/centre");
  if (draw.width.rows() != draw.centre.rows()) refuse("/ranges/width");
}

/// Where δ is estimated, every table is there.
void check_estimates(const Hdf5File& file, const ForceRanges& ranges) {
  const Eigen::Index rows = ranges.calibration >= 0 ? ranges.value.rows() : 0;
  bool is_whole = ranges.calibrates.size() == rows && (ranges.draws > 0 || ranges.centre.rows() == rows);
  for (const DeltaEstimates* part : {&ranges.estimated_R, &ranges.estimated_T}) {
    for (const Eigen::VectorXd* values : {&part->estimate, &part->low, &part->high})
      is_whole = is_whole && values->size() == rows;
  }
  const bool is_said = ranges.choice == ContactChoice::Kind::kCalibration;
  if (!is_whole || is_said != (ranges.calibration >= 0) || ranges.calibration < -1)
    fail(file, "/ranges@calibration", "does not go with the estimates");
}

/// Of smallest distances all tables are there, or none.
void check_smallest(const Hdf5File& file, const SmallestDistances& smallest) {
  const Eigen::Index rows = smallest.outcome.rows();
  if (smallest.d_R.rows() != rows || smallest.d_T.rows() != rows || smallest.lower.rows() != rows ||
      smallest.shortage.rows() != rows)
    fail(file, "/ranges/d_min_outcome", "does not go with d_R_min, d_T_min, d_min_lower, d_min_shortage");
}

/// Numbers of contacts, and what they tell of a sample.
void check_request(const Hdf5File& file, const ForceRanges& ranges) {
  if (ranges.requested < 0 || ranges.requested > ranges.value.rows())
    fail(file, "/ranges@requested", fmt::format("{} of {} contacts", ranges.requested, ranges.value.rows()));
  check_draw(file, ranges);
  check_estimates(file, ranges);
  check_smallest(file, ranges.smallest);
  if (ranges.choice != ContactChoice::Kind::kSample) return;
  if (file.double_attribute("/ranges", "confidence") != kConfidence)
    fail(file, "/ranges@confidence", fmt::format("is not {}", kConfidence));
}

/// Every number that points to a state, a ray or a half-plane finds it.
void check_pointers(const Hdf5File& file, const ForceRanges& ranges) {
  const auto check = [&](const char* object, const char* what, std::int64_t row, Eigen::Index count) {
    if (row < -1 || row >= count)
      fail(file, object, fmt::format("points to {} {}, but there are {}", what, row, count));
  };
  Eigen::Index half_planes = 2 * ranges.value.rows();
  if (file.has("/contacts/bounds")) {
    const std::vector<ForceBound> bounds = force_bounds(read_packing(file));
    if (ranges.bound_multipliers.size() != 0 &&
        ranges.bound_multipliers.size() != static_cast<Eigen::Index>(bounds.size()))
      fail(file, "/equilibrium/bound_multipliers", fmt::format("has not {} entries", bounds.size()));
    for (const ForceBound& bound : bounds) half_planes += bound.side == ForceBound::Side::kEqual ? 0 : 1;
  }
  for (const std::int32_t plane : ranges.active.reshaped()) {
    if (plane < -1 || plane >= half_planes)
      fail(file, "/extremal/active", fmt::format("there is no half-plane {}", plane));
  }
  check("/extremal@largest_norm", "state", ranges.largest_norm, ranges.states.rows());
  for (const std::int32_t contact : ranges.state_contacts)
    check("/extremal/contacts", "contact", contact, ranges.value.rows());
  for (const std::int32_t row : ranges.vertex.reshaped())
    check("/ranges/vertex", "state", row, ranges.states.rows());
  for (const std::int32_t row : ranges.ray.reshaped()) check("/ranges/ray", "ray", row, ranges.rays.rows());
  const Reactions& r = ranges.reactions;
  for (const std::int32_t row : r.vertex.reshaped())
    check("/reactions/vertex", "state", row, r.states.rows());
  for (const std::int32_t row : r.ray.reshaped()) check("/reactions/ray", "ray", row, r.rays.rows());
}

/// Reactions are those of bodies that there are, and no table of them is missing.
void check_reactions(const Hdf5File& file, const Reactions& reactions) {
  const Eigen::Index count = reactions.count();
  const auto walls = static_cast<std::int64_t>(file.shape("/walls/id", 1)[0]);
  const auto disks = static_cast<std::int64_t>(file.shape("/particles/disks/id", 1)[0]);
  for (const Eigen::Index rows :
       {reactions.component.size(), reactions.value.rows(), reactions.lower.rows(), reactions.upper.rows(),
        reactions.outcome.rows(), reactions.vertex.rows(), reactions.ray.rows()}) {
    if (rows != count) fail(file, "/reactions", "some of its tables are missing");
  }
  for (Eigen::Index k = 0; k < count; ++k) {
    const Body body = Body::from_code(reactions.body[k]);
    if (!body.is_among(static_cast<int>(disks), static_cast<int>(walls)))
      fail(file, "/reactions/body", fmt::format("there is no body {}", body.code()));
    const std::int32_t component = reactions.component[k];
    if (component < 0 || component >= (body.is_wall() ? 2 : 3))
      fail(file, "/reactions/component",
           fmt::format("there is no component {} of body {}", component, body.code()));
  }
}

/// Proofs are of contacts that there are, and no table of them is missing.
void check_duals(const Hdf5File& file, const Duals& duals) {
  const auto refuse = [&](const char* object, const std::string& reason) { fail(file, object, reason); };
  const auto walls = static_cast<Eigen::Index>(file.shape("/walls/id", 1)[0]);
  const auto disks = static_cast<Eigen::Index>(file.shape("/particles/disks/id", 1)[0]);
  const auto contacts = static_cast<Eigen::Index>(file.shape("/contacts/body_a", 1)[0]);
  const Eigen::Index count = duals.contacts.size();
  if (duals.multipliers.rows() != 4 * count || duals.points.rows() != 4 * count)
    refuse("/duals", fmt::format("has not four values for each of its {} contacts", count));
  if (count == 0) return;
  const Eigen::Index bounds =
      file.has("/contacts/bounds") ? static_cast<Eigen::Index>(force_bounds(read_packing(file)).size()) : 0;
  if (const Eigen::Index rows = 3 * disks + 2 * walls + 3 + bounds; duals.bounding.size() != rows)
    refuse("/duals/bounding", fmt::format("has not {} entries", rows));
  for (Eigen::Index d = 0; d < count; ++d) {
    const std::int32_t contact = duals.contacts[d];
    if (contact < (d == 0 ? 0 : duals.contacts[d - 1] + 1) || contact >= contacts)
      refuse("/duals/contacts", "is no ascending list of contacts");
  }
}

}  // namespace

void write_ranges_part(Hdf5File& file, const ForceRanges& ranges) {
  for (const char* group : {"/equilibrium", "/ranges", "/extremal"}) file.make_group(group);
  if (ranges.reactions.count() > 0) file.make_group("/reactions");
  if (ranges.duals.are_kept()) file.make_group("/duals");
  visit_fields(ranges, FieldWriter(file, ranges, false));
  if (ranges.choice == ContactChoice::Kind::kSample) file.set_attribute("/ranges", "confidence", kConfidence);
  file.set_attribute("/ranges", "sha256", file.sha256({"/extremal", "/ranges"}));
}

void write_work_part(Hdf5File& file, const ForceRanges& ranges) {
  file.make_group(kWork);
  visit_fields(ranges, FieldWriter(file, ranges, true));
}

void write_ranges(const std::filesystem::path& path, const Packing& packing, const ForceRanges& ranges,
                  const Provenance& provenance) {
  Hdf5File file = Hdf5File::create(path);
  write_header(file, schema_of(packing));
  write_packing_part(file, packing);
  write_ranges_part(file, ranges);
  write_vtkhdf_part(file, packing, ranges);
  Provenance all = provenance;
  all.seconds.insert(ranges.seconds.begin(), ranges.seconds.end());
  write_provenance_part(file, all);
  write_work_part(file, ranges);
  seal(file);
}

ForceRanges read_ranges(const Hdf5File& file) {
  if (!file.has("/ranges")) {
    throw Hdf5ReadError(
        fmt::format("{}: has no force ranges; compute them with indet analyze", file.path().string()));
  }
  ForceRanges ranges;
  ranges.value.resize(static_cast<Eigen::Index>(file.shape("/contacts/body_a", 1)[0]), 4);
  FieldReader reader(file, ranges);
  visit_fields(ranges, reader);
  // Earlier versions walked in one way only.
  if (ranges.method == Method::kPivotingPaper && !file.has_attribute(kWork, "neighbour_rule"))
    ranges.paper_options = {.neighbour = NeighbourRule::kBest, .start = WalkStart::kMinimum};
  if (ranges.choice == ContactChoice::Kind::kAll) ranges.requested = static_cast<int>(ranges.value.rows());
  check_request(file, ranges);
  check_pointers(file, ranges);
  check_reactions(file, ranges.reactions);
  check_duals(file, ranges.duals);
  if (!ranges.duals.are_kept()) ranges.duals = {};
  ranges.seconds = file.number_attributes("/provenance/timings");
  return ranges;
}

ForceRanges read_ranges(const std::filesystem::path& path) { return read_ranges(open_indet_file(path)); }

bool has_ranges(const Hdf5File& file) { return file.has("/ranges"); }

}  // namespace indet
