#pragma once

#include <map>
#include <string>
#include <vector>

#include "apps/ensemble/tables/ensemble_tables.h"
#include "libindet/statistics/distribution.h"
#include "libsim/protocol.h"

namespace indet {

using Protocols = std::vector<sim::Protocol>;

/// "33.1 ± 1.4", the value alone if its error is unknown, "–" if there is none.
std::string text_of(const Estimate& estimate, int digits = 1);
/// The same with a unit, "33.2 ± 1.4 mg".
std::string text_of(const Estimate& estimate, int digits, const char* unit);

/// The largest finite value; 0 if there is none.
double largest(const GroupedValues& data);

/// A width of bins that is 1, 2 or 5 times a power of ten and makes at most `bins` of them.
double round_width(double span, int bins);

/// Position of the main maximum of a density away from 0: between a twentieth of the 99 % quantile and that,
/// in about 40 bins. NaN where the density only falls.
Estimate main_maximum(const GroupedValues& data);

/// Columns of the tables of an ensemble as samples, grouped by seed. `tables` must outlive it.
class Samples {
 public:
  explicit Samples(const EnsembleTables& tables);

  /// Of each run.
  const Protocols& protocols() const { return protocols_; }
  /// True if some packing of any of these protocols is there.
  bool has(const Protocols& protocols) const;
  bool has_solver_states() const { return has_values("solver_d_R"); }
  bool has_paper_walk() const { return has_values("paper_d_R"); }
  bool has_smallest_distances() const { return has_values("d_R_min"); }
  /// A column of the contacts of some protocols. Seeds without a value are no group.
  GroupedValues of(const Protocols& protocols, const std::string& column) const;
  /// The same for contacts with more, or less, than the mean normal force of the protocol.
  GroupedValues split_by_force(sim::Protocol protocol, const std::string& column, bool strong) const;
  double mean_force(sim::Protocol protocol) const;
  /// R in the extremal states of one kind of objective, the canonical ones or the vertices that the solver
  /// lands on; bins of 1 mg at their centres.
  GroupedValues extremal(sim::Protocol protocol, int objective, bool solver) const;
  /// A quantity of /table/sampled at the centres of its bins, for one sampling: 0 uniform, 1
  /// perturb-and-resolve. A value counts as often as there are such contacts in a state.
  GroupedValues sampled(const Protocols& protocols, const std::string& quantity, int sampling) const;
  /// A column of the runs of one protocol; NaN where unknown.
  std::vector<double> runs(sim::Protocol protocol, const std::string& column) const;

 private:
  /// True if some contact has a value in that column.
  bool has_values(const std::string& column) const;

  const EnsembleTables& tables_;
  Protocols protocols_;
  std::vector<int> group_;  ///< Of each run: number of its seed.
  int groups_ = 0;
};

}  // namespace indet
