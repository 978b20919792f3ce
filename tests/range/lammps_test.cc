#include <gtest/gtest.h>

#include <filesystem>

#include "libindet/io/lammps_reader.h"
#include "libindet/range/analyze.h"
#include "tests/range/formulations.h"
#include "tests/support/compare.h"

namespace indet {
namespace {

/// 220 disks and 376 contacts that LAMMPS settled in a box (tests/data/lammps/in.pack).
Packing lammps_packing() {
  const std::filesystem::path folder = std::filesystem::path(INDET_TEST_DATA) / "lammps";
  return read_lammps({folder / "atoms.dump", folder / "contacts.dump", {}}, {.friction = FrictionRule(0.3)})
      .packing;
}

// One test, so that each formulation is run no more often than needed.
TEST(LammpsPacking, IsCertifiedAndAllFormulationsAgree) {
  const Packing packing = lammps_packing();
  const ForceRanges dual = analyze_by(Formulation::kDual, packing, 1);
  EXPECT_EQ(dual.status, PolytopeStatus::kBounded);
  EXPECT_EQ(dual.nullity, 95);
  EXPECT_EQ(dual.objectives, 1504);
  EXPECT_EQ(dual.certified, 1504);
  EXPECT_EQ(dual.imprecise, 0);
  EXPECT_EQ(dual.failed, 0);
  EXPECT_LE(dual.worst_primal_residual, 1e-10);
  // The simulated state is one of those allowed.
  for (int k = 0; k < packing.contact_count(); ++k) {
    const Contact& contact = packing[ContactId(k)];
    EXPECT_GE(contact.R, dual.value(k, kMinR) - 1e-6 * dual.force_unit);
    EXPECT_LE(contact.R, dual.value(k, kMaxR) + 1e-6 * dual.force_unit);
    EXPECT_GE(contact.T, dual.value(k, kMinT) - 1e-6 * dual.force_unit);
    EXPECT_LE(contact.T, dual.value(k, kMaxT) + 1e-6 * dual.force_unit);
  }
  EXPECT_TRUE(test::same_ranges(dual, analyze_by(Formulation::kEdge, packing, 2), 1e-9));
  // Of every fourth contact: the null space takes three times as long as the others.
  AnalyzeOptions some;
  some.contacts.kind = ContactChoice::Kind::kList;
  for (int k = 0; k < packing.contact_count(); k += 4) some.contacts.list.push_back(k);
  some.formulation = Formulation::kEdge;
  const ForceRanges edge = analyze(packing, some);
  EXPECT_EQ(edge.certified, 376);
  some.threads = 2;
  EXPECT_TRUE(test::same_bytes(edge, analyze(packing, some)));
  some.formulation = Formulation::kNullSpace;
  EXPECT_TRUE(test::same_ranges(edge, analyze(packing, some), 1e-9));
}

}  // namespace
}  // namespace indet
