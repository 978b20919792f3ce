// A scene of the simulators, TOML.
#include "libsim/scene_toml.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace indet;
  const auto path = fuzz::write("scene.toml", {reinterpret_cast<const char*>(data), size});
  fuzz::expect_input_error_or_success([&] { sim::read_scene(path); });
  return 0;
}
