// What the limits of tilt cost beside other ways to them, in processor time, for each file on the command
// line:
//
//   limits       both ends, with proofs
//   objectives   the polytope stage, and 20 linear programs of ranges from scratch
//   ranges       of all contact forces, by the fastest method
//   bisection    the polytope stage of tilted packings, until the angle of one end is known to 1e-6 rad
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <filesystem>

#include "libindet/io/packing_file.h"
#include "libindet/limit/tilt.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/analyze.h"

namespace {

using namespace indet;

template <class Work>
double seconds(Work work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

bool stands(Packing packing, double angle) {
  packing.gravity = turned(packing.gravity, angle);
  return find_force_polytope(packing).status != PolytopeStatus::kEmpty;
}

/// R_max of 20 contacts, each by a solver of its own, without a start.
void solve_from_scratch(const ForcePolytope& polytope) {
  int left = 20;
  for (const PolytopeBlock& block : polytope.blocks) {
    for (int k = 0; k < block.view.inequalities() && left > 0; k += 7, --left)
      LpSolver(block.view, Formulation::kEdge).maximise(make_objective(block.view, {{k, 1.0}}), {});
  }
}

void measure(const std::filesystem::path& path) {
  const Packing packing = read_packing(path);
  TiltLimits limits;
  const double own = seconds([&] { limits = find_tilt_limits(packing); });
  ForcePolytope polytope;
  const double stage = seconds([&] { polytope = find_force_polytope(packing); });
  const double objectives = stage + seconds([&] { solve_from_scratch(polytope); });
  const double ranges = seconds([&] { analyze(packing, options_for(Accuracy::kFast)); });
  int stages = 0;
  double low = 0;
  double high = 1;
  const double bisection = seconds([&] {
    while (high - low > 1e-6) {
      const double middle = (low + high) / 2;
      ++stages;
      (stands(packing, middle) ? low : high) = middle;
    }
  });
  const double angle = (low + high) / 2;
  fmt::print("{}: {} disks, {} contacts\n", path.filename().string(), packing.disk_count(),
             packing.contact_count());
  fmt::print("  tilt {:.9f} … {:.9f} rad, proven to {:.0e} and {:.0e}\n", limits.smallest.value,
             limits.largest.value, limits.smallest.upper - limits.smallest.lower,
             limits.largest.upper - limits.largest.lower);
  fmt::print("  limits {:.3f} s\n", own);
  fmt::print("  polytope stage and 20 objectives {:.3f} s: limits are {:.2f} of it\n", objectives,
             own / objectives);
  fmt::print("  ranges {:.2f} s: limits are {:.1f} % of it\n", ranges, 100 * own / ranges);
  fmt::print(
      "  bisection of one end: {} stages, {:.2f} s, {:.1f} times that of both limits; off by {:.1e} rad\n",
      stages, bisection, bisection / own, std::abs(angle - limits.largest.value));
}

}  // namespace

int main(int count, char** arguments) {
  for (int i = 1; i < count; ++i) measure(arguments[i]);
}
