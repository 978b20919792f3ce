// Writes the sample files that h5py_test.py reads, into the folder that is given.

#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <type_traits>

#include "libindet/io/ranges_file.h"
#include "libindet/range/result_fields.h"
#include "tests/io/sample.h"

namespace {

/// How file-format.md calls the type of the numbers of a field.
template <class Value>
std::string type_of() {
  if constexpr (requires { typename Value::Scalar; }) {
    using Number = typename Value::Scalar;
    if (std::is_same_v<Number, indet::Outcome>) return "enum";
    if (std::is_same_v<Number, std::uint8_t>) return "u1";
    return std::is_same_v<Number, std::int32_t> ? "i4" : "f8";
  }
  return "attribute";
}

/// The list of fields: group, name, type, shape, unit and meaning, a line each.
void write_fields(const std::filesystem::path& path) {
  std::ofstream out(path);
  const indet::ForceRanges ranges;
  indet::visit_fields(ranges, [&]<class Value>(const indet::Field& field, const Value&) {
    std::string shape = to_string(field.rows);
    if (field.columns != indet::Extent::kOne) shape += std::string(",") + to_string(field.columns);
    out << field.group << '\t' << field.name << '\t' << type_of<Value>() << '\t' << shape << '\t'
        << field.unit << '\t' << field.meaning << '\n';
  });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    const indet::Provenance provenance = {
        {"indet", "analyze"}, "threads = 1\n", {{"GLPK", "5.0"}}, {{"read", 0.5}}};
    indet::write_ranges(folder / "ranges.h5", indet::test::sample_packing(), indet::test::sample_ranges(),
                        provenance);

    write_fields(folder / "fields.txt");

    // Everything that only some files have.
    indet::ForceRanges rare = indet::test::sample_ranges();
    rare.choice = indet::ContactChoice::Kind::kSample;
    rare.requested = 3;
    rare.state_kind = indet::StateChoice::Kind::kSolver;
    rare.states_of = indet::StateChoice::Contacts::kList;
    rare.state_contacts = Eigen::Array2i(1, 4);
    rare.sample_seed = 12;
    rare.reason = "a reason";
    rare.blocks = -1;
    rare.blocks_reason = "rounding decides";
    rare.exact = true;
    rare.hairline = 1e-12;
    rare.gap = 1e-6;
    rare.enclosed = 3;
    rare.smallest = indet::test::sample_distances();
    rare.draws = 4;
    rare.weight.setLinSpaced(5, 3, 7);
    rare.drawn.setZero(5);
    rare.drawn.head(3) << 1, 2, 1;
    rare.centre.setConstant(5, 2, 1.5);
    rare.width.setConstant(5, 2, 0.75);
    rare.calibration = 2;
    rare.coverage = 0.95;
    rare.calibrates.setOnes(5);
    for (auto* part : {&rare.estimated_R, &rare.estimated_T}) {
      for (auto* values : {&part->estimate, &part->low, &part->high}) values->setConstant(5, 0.25);
    }
    rare.method = indet::Method::kPivotingPaper;
    rare.paper_options.neighbour = indet::NeighbourRule::kRandom;
    rare.motion.setConstant(3, 3, 0.5);
    rare.wall_motion.setConstant(2, 2, 0.5);
    rare.cell_motion.setConstant(2, 2, 0.25);
    rare.bound_multipliers.setConstant(6, 0.125);
    rare.duals = indet::test::sample_duals();
    indet::write_ranges(folder / "rare.h5", indet::test::sample_packing(), rare, provenance);

    // Above the size from which data are compressed.
    indet::ForceRanges large = indet::test::sample_ranges();
    constexpr int kStates = 3001;
    large.states.resize(kStates, 10);
    large.norm.setLinSpaced(kStates, 0, kStates - 1);
    large.active.setZero(kStates, 3);
    for (int k = 0; k < kStates; ++k) {
      for (int j = 0; j < 10; ++j) large.states(k, j) = k + 0.0625 * j;
    }
    indet::write_ranges(folder / "large.h5", indet::test::sample_packing(), large, provenance);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
