// Parts: the dump of atoms, the dump of contacts.
#include "libindet/io/liggghts_reader.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace indet;
  const auto [atoms, contacts] =
      fuzz::write_two({reinterpret_cast<const char*>(data), size}, "atoms.dump", "contacts.dump");
  const DumpFiles files{.atoms = atoms, .contacts = contacts, .timestep = {}};
  ImportSettings settings;
  settings.friction = FrictionRule(0.3);
  fuzz::expect_input_error_or_success([&] {
    read_liggghts(files, parse_walls({"left=x:0", "floor=y:0"}, settings.plane), settings);
  });
  return 0;
}
