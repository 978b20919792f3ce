#include "libindet/barrier/ordering.h"

#include <amd.h>
#include <cholmod.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <string>

#include "libindet/base/error.h"

namespace indet::barrier {
namespace {

/// The pattern of a symmetric matrix by columns, without its diagonal.
struct Pattern {
  std::vector<int> start{0};
  std::vector<int> row;

  int size() const { return static_cast<int>(start.size()) - 1; }
};

std::vector<int> minimum_degree(const Pattern& pattern) {
  std::vector<int> order(static_cast<std::size_t>(pattern.size()));
  const int status =
      amd_order(pattern.size(), pattern.start.data(), pattern.row.data(), order.data(), nullptr, nullptr);
  if (status != AMD_OK && status != AMD_OK_BUT_JUMBLED)
    throw LibraryError("the equations of equilibrium could not be ordered (AMD status " +
                       std::to_string(status) + ")");
  return order;
}

/// CHOLMOD analyses the matrix in both orders, and keeps the one whose factorisation has fewer products. Not
/// METIS by itself, whose METIS_NodeND takes over the handler of SIGTERM and does not give it back as it was.
std::vector<int> best_order(Pattern pattern) {
  struct Finish {
    void operator()(cholmod_common* common) const { cholmod_finish(common); }
  };
  cholmod_common common{};
  cholmod_start(&common);
  const std::unique_ptr<cholmod_common, Finish> finish(&common);
  common.print = 0;
  common.supernodal = CHOLMOD_SIMPLICIAL;
  common.nmethods = 2;
  common.method[0].ordering = CHOLMOD_AMD;
  common.method[1].ordering = CHOLMOD_NESDIS;

  cholmod_sparse matrix{};
  matrix.nrow = matrix.ncol = static_cast<std::size_t>(pattern.size());
  matrix.nzmax = pattern.row.size();
  matrix.p = pattern.start.data();
  matrix.i = pattern.row.data();
  matrix.stype = 1;  // what lies above the diagonal counts
  matrix.itype = CHOLMOD_INT;
  matrix.xtype = CHOLMOD_PATTERN;
  matrix.dtype = CHOLMOD_DOUBLE;
  matrix.packed = 1;

  const auto release = [&](cholmod_factor* factor) { cholmod_free_factor(&factor, &common); };
  // The dissection draws from rand(), which all threads share, after it has set its seed.
  static std::mutex only_one;
  const std::scoped_lock lock(only_one);
  const std::unique_ptr<cholmod_factor, decltype(release)> factor(cholmod_analyze(&matrix, &common), release);
  if (!factor)
    throw LibraryError("the equations of equilibrium could not be ordered (CHOLMOD status " +
                       std::to_string(common.status) + ")");
  const int* order = static_cast<const int*>(factor->Perm);
  return {order, order + pattern.size()};
}

}  // namespace

std::vector<int> fill_reducing_order(const std::vector<std::vector<int>>& neighbours,
                                     const std::vector<bool>& last) {
  const auto count = neighbours.size();
  std::vector<int> number(count, -1);
  std::vector<int> kept;
  for (std::size_t i = 0; i < count; ++i) {
    if (last[i]) continue;
    number[i] = static_cast<int>(kept.size());
    kept.push_back(static_cast<int>(i));
  }
  Pattern pattern;
  for (const int i : kept) {
    for (const int j : neighbours[static_cast<std::size_t>(i)]) {
      if (number[static_cast<std::size_t>(j)] >= 0)
        pattern.row.push_back(number[static_cast<std::size_t>(j)]);
    }
    // What a dissection finds depends on the order of the neighbours.
    std::sort(pattern.row.begin() + pattern.start.back(), pattern.row.end());
    pattern.start.push_back(static_cast<int>(pattern.row.size()));
  }
  // The libraries want an address also where there is no entry.
  pattern.row.resize(std::max<std::size_t>(1, pattern.row.size()));
  std::vector<int> order;
  if (kept.size() >= kNestedDissectionNodes)
    order = best_order(std::move(pattern));
  else if (!kept.empty())
    order = minimum_degree(pattern);
  for (int& i : order) i = kept[static_cast<std::size_t>(i)];
  for (std::size_t i = 0; i < count; ++i) {
    if (last[i]) order.push_back(static_cast<int>(i));
  }
  return order;
}

}  // namespace indet::barrier
