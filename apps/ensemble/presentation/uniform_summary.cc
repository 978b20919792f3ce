#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "apps/ensemble/presentation/curves.h"
#include "apps/ensemble/presentation/samples.h"
#include "apps/ensemble/presentation/uniform_figures.h"
#include "libindet/base/tolerances.h"
#include "libindet/statistics/two_sample.h"

namespace indet {
namespace {

using sim::Protocol;
using SummaryRows = std::vector<std::vector<std::string>>;
using Cell = std::function<std::string(Protocol protocol)>;

class Summary {
 public:
  explicit Summary(const EnsembleTables& tables) : tables_(tables), samples_(tables) {
    const std::vector<double> r = tables.runs.numbers("uniform_r");
    for (std::size_t row = 0; row < r.size(); ++row) {
      if (!std::isnan(r[row])) sampled_.push_back(samples_.protocols()[row]);
    }
    for (std::size_t p = 0; p < kFamilies.size(); ++p) {
      if (std::count(sampled_.begin(), sampled_.end(), kFamilies[p].protocol) > 0) shown_.push_back(p);
    }
  }

  SummaryRows rows() {
    if (shown_.empty()) return {};
    std::vector<std::string> header = {""};
    for (const std::size_t p : shown_) header.emplace_back(kFamilies[p].name());
    header.emplace_back("if equal");
    rows_.push_back(header);
    add("packings sampled uniformly, converged", "", [&](Protocol p) { return converged(p); });
    add_radii();
    add_tests();
    add_places();
    return rows_;
  }

 private:
  void add(const std::string& name, const std::string& expected, const Cell& cell) {
    std::vector<std::string> row = {name};
    for (const std::size_t p : shown_) row.push_back(cell(kFamilies[p].protocol));
    row.push_back(expected);
    rows_.push_back(row);
  }

  void add_mean(const std::string& name, const std::string& expected, const char* column, int digits) {
    add(name, expected, [&](Protocol p) { return text_of(mean_of(samples_.runs(p, column)), digits); });
  }

  std::string converged(Protocol protocol) const {
    std::int64_t done = 0;
    std::int64_t asked = 0;
    for (std::size_t row = 0; row < tables_.runs.rows(); ++row) {
      const std::string& outcome = tables_.runs.text("uniform", row);
      if (samples_.protocols()[row] != protocol || outcome.empty()) continue;
      ++asked;
      done += outcome == "converged" ? 1 : 0;
    }
    return fmt::format("{} of {}", done, asked);
  }

  /// Of the packings in which both samplings were compared.
  std::vector<double> compared(Protocol protocol, const char* column) const {
    std::vector<double> values = samples_.runs(protocol, column);
    const std::vector<double> ratio = samples_.runs(protocol, "bias_ratio");
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::isnan(ratio[i])) values[i] = ratio[i];
    }
    return values;
  }

  void add_radii() {
    add_mean("r of the uniform distribution (mg)", "", "uniform_r", 1);
    add("r of perturb-and-resolve [38] (mg)", "",
        [&](Protocol p) { return text_of(mean_of(compared(p, "r")), 1); });
    add("the same in the paper (mg)", "", [](Protocol p) {
      return paper_radius(*std::find_if(kFamilies.begin(), kFamilies.end(),
                                        [&](const Family& f) { return p == f.protocol; }));
    });
    add_mean("ratio of both", "1", "bias_ratio", 2);
    add_mean("distance of their centres (mg)", "0", "bias_shift", 1);
    add("packings in which it is above three standard errors (%)", "0", [&](Protocol p) {
      const std::vector<double> shift = samples_.runs(p, "bias_shift");
      const std::vector<double> error = samples_.runs(p, "bias_shift_error");
      int known = 0;
      int above = 0;
      for (std::size_t i = 0; i < shift.size(); ++i) {
        known += std::isnan(shift[i]) ? 0 : 1;
        above += shift[i] > 3 * error[i] ? 1 : 0;
      }
      return known > 0 ? fmt::format("{:.0f}", 100.0 * above / known) : "–";
    });
  }

  void add_tests() {
    add("contacts with 20 effective states of perturb-and-resolve, tested (%)", "",
        [&](Protocol p) { return text_of(percentage(p, "bias_tested", "contacts"), 0); });
    for (const auto& [name, column, tested] :
         {std::tuple{"of these, mean of R differs (%)", "bias_means", "bias_tested"},
          std::tuple{"of these, distribution of R differs (%)", "bias_distributions", "bias_tested"},
          std::tuple{"control, two halves of the uniform sample: mean differs (%)", "control_means",
                     "contacts"},
          std::tuple{"control: distribution differs (%)", "control_distributions", "contacts"}}) {
      add(name, "0", [&](Protocol p) { return text_of(percentage(p, column, tested), 1); });
    }
    const auto ratio = [&](Protocol p, const char* above, const char* from) {
      GroupedValues values = samples_.of({p}, above);
      const GroupedValues other = samples_.of({p}, from);
      const GroupedValues unit = samples_.of({p}, "uniform_R_deviation");
      for (std::size_t i = 0; i < values.values.size(); ++i) {
        const double difference =
            above == from ? values.values[i] : std::abs(values.values[i] - other.values[i]);
        values.values[i] =
            unit.values[i] > tolerance::kComparable ? difference / unit.values[i] : std::nan("");
      }
      return text_of(grouped_mean(values), 2);
    };
    add("standard deviation of R, perturb-and-resolve : uniform, mean over contacts", "1",
        [&](Protocol p) { return ratio(p, "perturb_R_deviation", "perturb_R_deviation"); });
    add("difference of the means of R in standard deviations, mean of absolute values", "0",
        [&](Protocol p) { return ratio(p, "perturb_R", "uniform_R"); });
  }

  /// Mean over packings of 100 a/b.
  Estimate percentage(Protocol protocol, const char* a, const char* b) const {
    std::vector<double> values = compared(protocol, a);
    const std::vector<double> below = samples_.runs(protocol, b);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = below[i] > 0 ? 100 * values[i] / below[i] : std::nan("");
    return mean_of(values);
  }

  void add_places() {
    const auto n = static_cast<double>(sampled_.size()) / static_cast<double>(shown_.size());
    const std::string expected = fmt::format("50 ± {:.1f}", 100 / std::sqrt(12 * n));
    add_mean("distance of the simulated state from the uniform centre (mg)", "", "uniform_distance", 1);
    add_mean("its percentile", expected, "uniform_distance_percentile", 1);
    add_mean("percentile of the simulated ‖F‖", expected, "uniform_norm_percentile", 1);
    add_mean("… of ΣR", expected, "uniform_normal_force_percentile", 1);
    add_mean("… of the mean R*", expected, "uniform_R_star_percentile", 1);
    add_mean("… of the mean |T|/(μR)", expected, "uniform_mobilisation_percentile", 1);
    add_mean("… of Ms", "50", "uniform_sliding_percentile", 1);
    add("Ms simulated", "", [&](Protocol p) { return text_of(mean_of(samples_.runs(p, "sliding")), 1); });
    add("largest Ms of a uniform sample", "", [&](Protocol p) {
      double largest = 0;
      for (const double value : samples_.runs(p, "uniform_most_sliding")) largest = std::fmax(largest, value);
      return fmt::format("{:g}", largest);
    });
    add_mean("contacts whose R is in the central 90 % of the uniform distribution", "0.90",
             "uniform_central_R", 2);
  }

  const EnsembleTables& tables_;
  Samples samples_;
  Protocols sampled_;               ///< Protocols of the packings with a uniform sample.
  std::vector<std::size_t> shown_;  ///< Families that have some.
  SummaryRows rows_;
};

}  // namespace

SummaryRows uniform_summary(const EnsembleTables& tables) { return Summary(tables).rows(); }

}  // namespace indet
