#pragma once

#include <deque>
#include <optional>

namespace indet {

/// How long work will still take, from its pace of late: the share that was done in the last third of the
/// time so far. The first objectives of a search are often settled at once, and the last ones are the
/// dearest, so that the pace since the beginning promises too little for too long.
class RemainingTime {
 public:
  /// `seconds` since the work began, not before those of the last call; `share` of it that is done, 0 … 1.
  void update(double seconds, double share);

  /// In seconds, as of the last update; none as long as nothing tells the pace.
  std::optional<double> seconds() const;

 private:
  struct Mark {
    double seconds = 0, share = 0;
  };
  /// Marks are this share of the time apart at least, which keeps some 20 of them.
  static constexpr double kSpacing = 0.02;

  std::deque<Mark> marks_;  ///< the first one is the last before the last third
  Mark now_;
};

}  // namespace indet
