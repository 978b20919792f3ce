// A whole HDF5 file, read as a packing and as ranges. Its own checksums stop most changes early, so the
// numbers are compared only after everything was read.
#include "libindet/io/packing_file.h"
#include "libindet/io/ranges_file.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace indet;
  const auto path = fuzz::write("packing.h5", {reinterpret_cast<const char*>(data), size});
  fuzz::expect_input_error_or_success([&] { read_packing(path); });
  fuzz::expect_input_error_or_success([&] { read_ranges(path); });
  fuzz::expect_input_error_or_success([&] { compute_digests(path); });
  return 0;
}
