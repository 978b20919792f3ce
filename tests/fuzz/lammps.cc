// Parts: the dump of atoms, the dump of contacts.
#include "libindet/io/lammps_reader.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace indet;
  const auto parts = fuzz::parts({reinterpret_cast<const char*>(data), size});
  DumpFiles files;
  files.atoms = fuzz::write("atoms.dump", parts[0]);
  files.contacts = fuzz::write("contacts.dump", parts.size() > 1 ? parts[1] : std::string_view());
  ImportSettings settings;
  settings.friction = FrictionRule(0.3);
  fuzz::expect_input_error_or_success([&] { read_lammps(files, settings); });
  return 0;
}
