// Writes the sample files that h5py_test.py reads, into the folder that is given.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <vector>

#include "libindet/io/ranges_file.h"
#include "tests/io/sample.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    const indet::Provenance provenance = {
        {"indet", "analyze"}, "threads = 1\n", {{"GLPK", "5.0"}}, {{"read", 0.5}}};
    indet::write_ranges(folder / "ranges.h5", indet::test::sample_packing(), indet::test::sample_ranges(),
                        provenance);

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
