// Parts: .data, .fstat.
#include "libindet/io/mercury_data_reader.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace indet;
  const auto [particles, contacts] =
      fuzz::write_two({reinterpret_cast<const char*>(data), size}, "packing.data", "packing.fstat");
  const MercuryFiles files{.data = particles, .fstat = contacts};
  ImportSettings settings;
  settings.friction = FrictionRule(0.3);
  settings.density = DensityRule::parse({"disk=1"});
  fuzz::expect_input_error_or_success([&] { read_mercury_data(files, {}, {}, settings); });
  fuzz::expect_input_error_or_success(
      [&] { read_mercury_data(files, 0.5, parse_walls({"1=x:1"}, settings.plane), settings); });
  return 0;
}
