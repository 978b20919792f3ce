// Parts: the dump of atoms, the dump of contacts.
#include "libindet/io/liggghts_reader.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace indet;
  const auto parts = fuzz::parts({reinterpret_cast<const char*>(data), size});
  DumpFiles files;
  files.atoms = fuzz::write("atoms.dump", parts[0]);
  files.contacts = fuzz::write("contacts.dump", parts.size() > 1 ? parts[1] : std::string_view());
  ImportSettings settings;
  settings.friction = FrictionRule(0.3);
  fuzz::expect_input_error_or_success([&] {
    read_liggghts(files, parse_walls({"left=x:0", "floor=y:0"}, settings.plane), settings);
  });
  return 0;
}
