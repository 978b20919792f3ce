#include "libindet/base/remaining_time.h"

namespace indet {

void RemainingTime::update(double seconds, double share) {
  if (marks_.empty()) marks_.push_back({});
  now_ = {seconds, share};
  if (seconds - marks_.back().seconds >= kSpacing * seconds) marks_.push_back(now_);
  while (marks_.size() > 1 && marks_[1].seconds <= seconds * 2 / 3) marks_.pop_front();
}

std::optional<double> RemainingTime::seconds() const {
  if (marks_.empty()) return std::nullopt;
  const double done = now_.share - marks_.front().share;
  const double pace = now_.seconds - marks_.front().seconds;
  // Where nothing was done of late, the pace since the beginning.
  if (done > 0 && pace > 0) return (1 - now_.share) * pace / done;
  if (now_.share > 0 && now_.seconds > 0) return (1 - now_.share) * now_.seconds / now_.share;
  return std::nullopt;
}

}  // namespace indet
