// Parts: bodies.txt, interactions.txt; a single part is the XML of O.save.
#include "libindet/io/yade_reader.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace indet;
  const auto parts = fuzz::parts({reinterpret_cast<const char*>(data), size});
  if (parts.size() == 1) {
    const auto file = fuzz::write("scene.xml", parts[0]);
    fuzz::expect_input_error_or_success([&] { read_yade(file, {}); });
  } else {
    fuzz::write("bodies.txt", parts[0]);
    fuzz::write("interactions.txt", parts[1]);
    fuzz::expect_input_error_or_success([&] { read_yade(fuzz::folder(), {}); });
  }
  return 0;
}
