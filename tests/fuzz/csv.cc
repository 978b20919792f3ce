// Parts: disks.csv, walls.csv, contacts.csv, scene.toml.
#include "libindet/io/csv_reader.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace indet;
  const auto parts = fuzz::parts({reinterpret_cast<const char*>(data), size});
  constexpr const char* kNames[] = {"disks.csv", "walls.csv", "contacts.csv", "scene.toml"};
  for (std::size_t k = 0; k < 4; ++k) {
    if (k < parts.size()) {
      fuzz::write(kNames[k], parts[k]);
    } else {
      std::filesystem::remove(fuzz::folder() / kNames[k]);
    }
  }
  fuzz::expect_input_error_or_success([] { read_csv_scene(fuzz::folder()); });
  return 0;
}
