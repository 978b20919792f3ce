// The restart file.
#include "libindet/io/mercury_reader.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace indet;
  const auto file = fuzz::write("packing.restart", {reinterpret_cast<const char*>(data), size});
  fuzz::expect_input_error_or_success([&] { read_mercury(file, {}); });
  return 0;
}
