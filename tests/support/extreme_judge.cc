#include <cmath>

#include "tests/support/extremes.h"
#include "tests/support/rational_simplex.h"

namespace indet::extremes {

void Tally::add(const Tally& other) {
  right += other.right;
  contained += other.contained;
  marked += other.marked;
  wrong += other.wrong;
  complaints.insert(complaints.end(), other.complaints.begin(), other.complaints.end());
}

namespace {

bool encloses(double lower, double upper, const mpq_class& value) {
  const bool above = std::isinf(lower) ? lower < 0 : mpq_class(lower) <= value;
  const bool below = std::isinf(upper) ? upper > 0 : value <= mpq_class(upper);
  return above && below;
}

int sign_of(int column) { return column == kMaxR || column == kMaxT ? 1 : -1; }

}  // namespace

Judge::Judge(const Scene& scene)
    : name_(scene.kind + ", " + scene.name), unit_(scene.packing.internal_force_unit()) {
  oracle::RationalSimplex exact(scene.packing);
  empty_ = exact.is_empty();
  rank_ = exact.rank();
  if (empty_) return;
  values_.resize(static_cast<std::size_t>(scene.packing.contact_count()));
  for (std::size_t i = 0; i < values_.size(); ++i) {
    for (int column = 0; column < 4; ++column) {
      const int component = 2 * static_cast<int>(i) + (column >= kMinT ? 1 : 0);
      values_[i][static_cast<std::size_t>(column)] = exact.extremum(component, sign_of(column));
    }
  }
}

Tally Judge::judge(const ForceRanges& ranges) const {
  Tally tally;
  const auto complain = [&](const std::string& text) {
    ++tally.wrong;
    tally.complaints.push_back(name_ + ": " + text);
  };
  const bool empty = ranges.status == PolytopeStatus::kEmpty;
  if (empty_ != empty) {
    if (ranges.doubtful) {
      ++tally.marked;
    } else {
      complain(empty ? "stands, but is called empty" : "is empty, but ranges are given");
    }
    return tally;
  }
  if (empty) {
    ++(ranges.doubtful ? tally.marked : tally.right);
    return tally;
  }
  if (!ranges.doubtful && ranges.rank != rank_) complain("wrong rank " + std::to_string(ranges.rank));
  for (std::size_t i = 0; i < values_.size(); ++i) {
    for (int column = 0; column < 4; ++column) {
      const auto row = static_cast<Eigen::Index>(i);
      const Outcome outcome = ranges.outcome(row, column);
      if (outcome == Outcome::kImprecise || outcome == Outcome::kFailed) {
        ++tally.marked;
        continue;
      }
      const std::optional<mpq_class>& value = values_[i][static_cast<std::size_t>(column)];
      const double stored = ranges.value(row, column);
      const double lower = ranges.lower(row, column);
      const double upper = ranges.upper(row, column);
      const std::string place = "contact " + std::to_string(i) + " " + to_string(static_cast<Column>(column));
      if (!value) {
        if (std::isinf(stored)) {
          ++tally.right;
        } else if (std::isinf(sign_of(column) > 0 ? upper : lower)) {
          ++tally.contained;
        } else {
          complain(place + " is unbounded, stored " + std::to_string(stored));
        }
        continue;
      }
      if (std::isinf(stored) || !encloses(lower, upper, *value)) {
        complain(place + " is " + std::to_string(value->get_d()) + ", stored " + std::to_string(stored) +
                 " in [" + std::to_string(lower) + ", " + std::to_string(upper) + "]");
        continue;
      }
      const mpq_class size = abs(*value);
      const mpq_class allowed = mpq_class(1e-9) * (size > unit_ ? size : unit_);
      ++(abs(mpq_class(stored) - *value) <= allowed ? tally.right : tally.contained);
    }
  }
  return tally;
}

Tally judge(const Scene& scene, const ForceRanges& ranges) { return Judge(scene).judge(ranges); }

}  // namespace indet::extremes
