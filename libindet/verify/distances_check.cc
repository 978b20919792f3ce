#include "libindet/verify/distances_check.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "libindet/base/tolerances.h"
#include "libindet/packing/force_bounds.h"
#include "libindet/verify/nonnegative.h"

namespace indet {
namespace {

/// Up to so many contacts, and so many distances, least squares are solved for (0.1 s each).
constexpr int kMostContacts = 30;
constexpr std::size_t kDistancesAgain = 3;

class DistancesCheck {
 public:
  DistancesCheck(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                 Comparisons& compare)
      : packing_(packing),
        ranges_(ranges),
        smallest_(ranges.smallest),
        problem_(problem),
        compare_(compare) {}

  void run() {
    if (smallest_.outcome.rows() == 0) return;
    for (int i = 0; i < packing_.contact_count(); ++i) {
      for (const int component : {0, 1}) check(i, component);
    }
    const bool is_small = packing_.contact_count() <= kMostContacts && force_bounds(packing_).empty();
    const std::size_t again = is_small ? std::min(kDistancesAgain, known_.size()) : 0;
    for (std::size_t k = 0; k < again; ++k) {
      const auto [contact, component] = known_[k * known_.size() / again];
      check_by_least_squares(contact, component);
    }
    compare_.leave_unchecked(fmt::format(
        "d_R_min, d_T_min, d_min_lower, d_min_shortage of /ranges, but for what they say of each other, of "
        "delta_R, delta_T and of the states that are stored ({})",
        found_again_ > 0 ? fmt::format("least squares find {} of them again", found_again_)
                         : "least squares find some again in small packings"));
  }

 private:
  struct Known {
    int contact = 0, component = 0;
  };

  std::string place(int contact, int component) const {
    return fmt::format("{} of contact {}", component == 0 ? "d_R_min" : "d_T_min", contact);
  }

  void check(int i, int component) {
    const std::string where = place(i, component);
    const Outcome outcome = smallest_.outcome(i, component);
    const double distance = smallest_.of(component)[i];
    const double lower = smallest_.lower(i, component);
    const double shortage = smallest_.shortage(i, component);
    const bool is_asked_for =
        ranges_.status != PolytopeStatus::kEmpty && ranges_.outcome(i, kMinR) != Outcome::kNotRequested;
    compare_.require(is_asked_for == (outcome != Outcome::kNotRequested), "{}: {}", where,
                     to_string(outcome));
    const bool has_value = outcome == Outcome::kEnclosed || outcome == Outcome::kImprecise;
    compare_.require(has_value || is_left_out(outcome) || outcome == Outcome::kFailed, "{}: {}", where,
                     to_string(outcome));
    for (const double number : {distance, lower, shortage}) {
      compare_.require(std::isfinite(number) == has_value, "{}: {}, but {} is stored", where,
                       to_string(outcome), number);
    }
    if (!has_value) return;
    const double room = tolerance::kRoundingRoom * std::max(1.0, distance);
    compare_.require(0 <= lower, "{}: the bound {} is below 0", where, lower);
    const double delta = component == 0 ? ranges_.delta_R[i] : ranges_.delta_T[i];
    // The distance of these two states is no less than what the force itself differs by.
    const double middle =
        component == 0 ? width(i, kMinR) + width(i, kMaxR) : width(i, kMinT) + width(i, kMaxT);
    compare_.require(!(distance < delta - std::max(0.0, shortage) - middle - room),
                     "{}: {}, though the force alone varies by {}", where, distance, delta);
    const double between = component == 0 ? ranges_.d_R[i] : ranges_.d_T[i];
    compare_.require(!(between < lower - room),
                     "{}: at least {} is stored, but the stored states are {} apart", where, lower, between);
    if (outcome != Outcome::kEnclosed) return;
    known_.push_back({i, component});
    const auto value = ranges_.value.row(i) / ranges_.force_unit;
    const double size = component == 0 ? std::max(std::abs(value[kMinR]), std::abs(value[kMaxR]))
                                       : std::max(std::abs(value[kMinT]), std::abs(value[kMaxT]));
    compare_.require(shortage <= tolerance::kFaceShortage * std::max(1.0, size) + room + middle,
                     "{}: known, but its states miss the extremes by {}", where, shortage);
    compare_.require(std::abs(distance - lower) <= tolerance::kDistanceGap * std::max(1.0, distance) + room,
                     "{}: {} is called known, but its lower bound is {}", where, distance, lower);
  }

  /// Of the bounds of a value, mg.
  double width(int i, Column column) const {
    const double width = (ranges_.upper(i, column) - ranges_.lower(i, column)) / ranges_.force_unit;
    return std::isfinite(width) ? width : 0;
  }

  /// 2M × edges.
  Eigen::MatrixXd edges() const {
    std::vector<Eigen::VectorXd> columns;
    for (int i = 0; i < packing_.contact_count(); ++i) {
      const double mu = packing_[ContactId(i)].mu;
      for (const double sign : {1.0, -1.0}) {
        if (mu == 0 && sign < 0) continue;
        Eigen::VectorXd& column = columns.emplace_back(Eigen::VectorXd::Zero(2 * packing_.contact_count()));
        column[2 * i] = 1;
        column[2 * i + 1] = sign * mu;
        column.normalize();
      }
    }
    Eigen::MatrixXd result(2 * packing_.contact_count(), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k) result.col(static_cast<Eigen::Index>(k)) = columns[k];
    return result;
  }

  void check_by_least_squares(int contact, int component) {
    constexpr double kWeight = 1e4;
    const Eigen::MatrixXd B = edges();
    const Eigen::MatrixXd balance = kWeight * (problem_.matrix() * B);
    const Eigen::Index forces = B.rows(), columns = B.cols(), rows = balance.rows();
    const int row = 2 * contact + component;
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(forces + 2 * (rows + 1), 2 * columns);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(A.rows());
    A.topRows(forces) << B, -B;
    const double ends[2] = {ranges_.value(contact, component == 0 ? kMaxR : kMaxT) / ranges_.force_unit,
                            ranges_.value(contact, component == 0 ? kMinR : kMinT) / ranges_.force_unit};
    for (const int copy : {0, 1}) {
      const Eigen::Index at = forces + copy * (rows + 1);
      A.block(at, copy * columns, rows, columns) = balance;
      b.segment(at, rows) = -kWeight * problem_.wrench();
      A.block(at + rows, copy * columns, 1, columns) = kWeight * B.row(row);
      b[at + rows] = kWeight * ends[copy];
    }
    const Eigen::VectorXd x = solve_nonnegative(A, b);
    const Eigen::VectorXd left = b - A * x;
    // The sum is convex: it is at most so much above the least one.
    const double excess = 2 * std::max(0.0, (A.transpose() * left).maxCoeff()) * x.sum();
    if (!(excess <= 0.1 * tolerance::kDistanceAgain * std::max(1.0, left.squaredNorm()))) return;
    // The least sum falls short of the square of the distance by what the forces miss their conditions by,
    // once more, and the distance is known but for its bounds.
    const double missed = left.tail(A.rows() - forces).squaredNorm();
    if (!(missed <= tolerance::kDistanceAgain * left.squaredNorm())) return;  // W is too small
    const double found = std::sqrt(left.squaredNorm() + missed);
    const double stored = smallest_.of(component)[contact];
    ++found_again_;
    compare_.require(std::abs(found - stored) <= tolerance::kDistanceAgain * std::max(1.0, stored),
                     "{}: {} is stored, but least squares find {}", place(contact, component), stored, found);
  }

  const Packing& packing_;
  const ForceRanges& ranges_;
  const SmallestDistances& smallest_;
  const RebuiltProblem& problem_;
  Comparisons& compare_;
  std::vector<Known> known_;
  int found_again_ = 0;
};

}  // namespace

void check_smallest_distances(const Packing& packing, const ForceRanges& ranges,
                              const RebuiltProblem& problem, Comparisons& compare) {
  DistancesCheck(packing, ranges, problem, compare).run();
}

}  // namespace indet
