#include "libindet/verify/free_directions.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libindet/base/disjoint_sets.h"
#include "libindet/base/random.h"
#include "libindet/base/tolerances.h"

namespace indet {
namespace {

constexpr int kSamples = 4;
constexpr int kSolves = 6;  ///< of a projection: the first, and those that refine it
constexpr int kMostSteps = 200;

/// Whether a contact's ranges are those of T = sign · μR.
bool slides(const ForceRanges& ranges, Eigen::Index i, double sign_mu) {
  const auto agree = [&](double T, double R) {
    const double room = std::isnan(ranges.gap) ? tolerance::kTightHalfPlane : ranges.gap;
    const double size = std::max(ranges.force_unit, std::abs(R));
    return std::abs(T - sign_mu * R) <= 2 * room * size;
  };
  const auto value = ranges.value.row(i);
  return sign_mu > 0 ? agree(value[kMinT], value[kMinR]) && agree(value[kMaxT], value[kMaxR])
                     : agree(value[kMinT], value[kMaxR]) && agree(value[kMaxT], value[kMinR]);
}

/// What open edges leave to the force of a contact of which R, T are held or not.
std::vector<Vector2> directions_of(const Packing& packing, const ForceRanges& ranges, int i, bool holds_R,
                                   bool holds_T) {
  const double mu = packing[ContactId(i)].mu;
  const double size = std::max(1.0, mu);
  if (ranges.dim < ranges.nullity) {
    if (ranges.value(i, kMinR) == 0 && ranges.value(i, kMaxR) == 0) return {};
    for (const double sign_mu : {mu, -mu}) {
      if (mu == 0 || !slides(ranges, i, sign_mu)) continue;
      return holds_R || holds_T ? std::vector<Vector2>() : std::vector<Vector2>{Vector2(1, sign_mu) / size};
    }
  }
  if (holds_R && holds_T) return {};
  if (holds_T) return {{1, 0}};
  if (holds_R) return {{0, 1}};
  return {Vector2(1, mu) / size, Vector2(1, -mu) / size};
}

enum class Clarity { kRounding, kDoubtful, kClear };
Clarity clarity(double value) {
  return value <= tolerance::kHullRounding    ? Clarity::kRounding
         : value > tolerance::kProjectedClear ? Clarity::kClear
                                              : Clarity::kDoubtful;
}

/// Sets of contacts that grow, one in each region: contacts that are left, joined by rows that they enter.
class Growth {
 public:
  Growth(const Eigen::SparseMatrix<double>& rows, const std::vector<int>& contact,
         const std::vector<bool>& varies)
      : rows_(rows), contact_(contact), regions_(0) {
    for (std::size_t i = 0; 2 * i < varies.size(); ++i)
      state_.push_back(varies[2 * i] || varies[2 * i + 1] ? State::kLeft : State::kDone);
  }

  /// Makes the regions, and begins where nothing grows. Returns whether something does.
  bool begin() {
    const std::ptrdiff_t contacts = std::ssize(state_);
    regions_ = DisjointSets(contacts + rows_.rows());
    for (std::size_t j = 0; j < contact_.size(); ++j) {
      if (at(contact_[j]) == State::kDone) continue;
      for (Eigen::SparseMatrix<double>::InnerIterator it(rows_, static_cast<Eigen::Index>(j)); it; ++it)
        regions_.join(contact_[j], contacts + it.row());
    }
    std::vector<bool> has_begun(state_.size() + static_cast<std::size_t>(rows_.rows()), false);
    for (const State wanted : {State::kGrowing, State::kLeft}) {
      for (std::size_t i = 0; i < state_.size(); ++i) {
        if (state_[i] != wanted || has_begun[regions_.root(i)]) continue;
        has_begun[regions_.root(i)] = true;
        state_[i] = State::kGrowing;
      }
    }
    return std::find(has_begun.begin(), has_begun.end(), true) != has_begun.end();
  }

  Eigen::VectorXd random_vector(Random& random) const {
    Eigen::VectorXd r = Eigen::VectorXd::Zero(rows_.cols());
    for (std::size_t j = 0; j < contact_.size(); ++j) {
      if (at(contact_[j]) == State::kGrowing) r[static_cast<Eigen::Index>(j)] = random.normal();
    }
    return r;
  }

  /// `reach`: of each contact, how far it moves with what grows. Returns how many sets ended.
  std::optional<int> spread(const Eigen::VectorXd& reach) {
    std::vector<Clarity> outside(state_.size() + static_cast<std::size_t>(rows_.rows()), Clarity::kRounding);
    for (std::size_t i = 0; i < state_.size(); ++i) {
      if (state_[i] != State::kLeft) continue;
      const Clarity joins = clarity(reach[static_cast<Eigen::Index>(i)]);
      Clarity& most = outside[regions_.root(i)];
      most = std::max(most, joins);
      if (joins == Clarity::kClear) state_[i] = State::kGrowing;
    }
    std::vector<bool> ends(outside.size(), false);
    for (std::size_t i = 0; i < state_.size(); ++i) {
      const std::size_t region = regions_.root(i);
      if (state_[i] != State::kGrowing || outside[region] == Clarity::kClear) continue;
      if (outside[region] == Clarity::kDoubtful) return std::nullopt;
      state_[i] = State::kDone;
      ends[region] = true;
    }
    return static_cast<int>(std::count(ends.begin(), ends.end(), true));
  }

 private:
  enum class State { kLeft, kGrowing, kDone };
  State at(int contact) const { return state_[static_cast<std::size_t>(contact)]; }

  const Eigen::SparseMatrix<double>& rows_;
  const std::vector<int>& contact_;
  DisjointSets regions_;  ///< contacts, then rows
  std::vector<State> state_;
};

}  // namespace

std::unique_ptr<const FreeDirections> FreeDirections::of(const RebuiltProblem& problem,
                                                         const Packing& packing, const ForceRanges& ranges) {
  std::vector<bool> is_held(2 * packing.contacts.size(), false);
  for (const int component : problem.held()) is_held[static_cast<std::size_t>(component)] = true;
  std::vector<Vector2> along;
  std::vector<int> contact;
  for (int i = 0; i < packing.contact_count(); ++i) {
    const auto R = static_cast<std::size_t>(2 * i);
    for (const Vector2& direction : directions_of(packing, ranges, i, is_held[R], is_held[R + 1])) {
      along.push_back(direction);
      contact.push_back(i);
    }
  }
  std::unique_ptr<const FreeDirections> free(
      new FreeDirections(problem, std::move(along), std::move(contact)));
  if (free->factor_.info() != Eigen::Success) return nullptr;
  if (ranges.dim < ranges.nullity && nullity_by_inertia(free->rows_, tolerance::kSparseRank) != ranges.dim)
    return nullptr;
  return free;
}

FreeDirections::FreeDirections(const RebuiltProblem& problem, std::vector<Vector2> along,
                               std::vector<int> contact)
    : contacts_(problem.contact_count()), along_(std::move(along)), contact_(std::move(contact)) {
  const Eigen::SparseMatrix<double>& c = problem.matrix();
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < along_.size(); ++j) {
    for (const int k : {0, 1}) {
      for (Eigen::SparseMatrix<double>::InnerIterator entry(c, 2 * contact_[j] + k); entry; ++entry)
        entries.emplace_back(static_cast<int>(entry.row()), static_cast<int>(j),
                             along_[j][k] * entry.value());
    }
  }
  rows_.resize(c.rows(), std::ssize(along_));
  rows_.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseMatrix<double> squares = rows_ * rows_.transpose();
  // Rows may depend on each other; what lifts the factor from 0 is an error that refinement takes away.
  for (Eigen::Index i = 0; i < squares.rows(); ++i) {
    const double diagonal = squares.coeff(i, i);
    squares.coeffRef(i, i) = diagonal > 0 ? diagonal * (1 + tolerance::kRebuiltLift) : 1;
  }
  factor_.compute(squares);
}

Eigen::VectorXd FreeDirections::projected(Eigen::VectorXd r) const {
  for (int k = 0; k < kSolves; ++k) r -= rows_.transpose() * factor_.solve(rows_ * r);
  return r;
}

Eigen::VectorXd FreeDirections::lengths(const Eigen::VectorXd& v) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(contacts_);
  for (std::size_t j = 0; j < contact_.size(); ++j)
    result[contact_[j]] = std::hypot(result[contact_[j]], v[static_cast<Eigen::Index>(j)]);
  return result;
}

Eigen::VectorXd FreeDirections::random_direction(Random& random) const {
  Eigen::VectorXd r(rows_.cols());
  for (double& value : r) value = random.normal();
  return projected(std::move(r));
}

std::optional<std::vector<bool>> FreeDirections::varying() const {
  Random random(3);
  Eigen::VectorXd sizes = Eigen::VectorXd::Zero(2 * contacts_);
  for (int sample = 0; sample < kSamples; ++sample) {
    const Eigen::VectorXd z = random_direction(random);
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(2 * contacts_);
    for (std::size_t j = 0; j < contact_.size(); ++j)
      forces.segment<2>(2 * contact_[j]) += z[static_cast<Eigen::Index>(j)] * along_[j];
    sizes += forces.cwiseAbs();
  }
  std::vector<bool> result;
  for (const double size : sizes) {
    if (clarity(size) == Clarity::kDoubtful) return std::nullopt;
    result.push_back(clarity(size) == Clarity::kClear);
  }
  return result;
}

std::optional<int> FreeDirections::blocks() const {
  const auto varies = varying();
  if (!varies) return std::nullopt;
  Random random(4);
  Eigen::VectorXd sizes = Eigen::VectorXd::Zero(contacts_);
  for (int sample = 0; sample < kSamples; ++sample) sizes += lengths(random_direction(random));
  Growth growth(rows_, contact_, *varies);
  int count = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    if (!growth.begin()) return count;
    const Eigen::VectorXd reach = lengths(projected(growth.random_vector(random)));
    const std::optional<int> ended = growth.spread(reach.cwiseQuotient(sizes));
    if (!ended) return std::nullopt;
    count += *ended;
  }
  return std::nullopt;
}

}  // namespace indet
