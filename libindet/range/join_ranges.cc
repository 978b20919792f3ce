#include "libindet/range/join_ranges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/range/attained_values.h"
#include "libindet/range/result_fields.h"

namespace indet {
namespace {

/// The values of fields as bytes, so that NaN equals NaN, with their names.
class FieldBytes {
 public:
  template <class Value>
  void operator()(const Field& field, const Value& value) {
    std::string bytes;
    if constexpr (requires { value.rows(); }) {
      const auto table = value.eval();
      append(bytes, table.rows());
      for (const auto entry : table.reshaped()) append(bytes, entry);
    } else if constexpr (std::is_same_v<Value, std::string>) {
      bytes = value;
    } else {
      append(bytes, value);
    }
    bytes_.emplace_back(field.name, std::move(bytes));
  }

  /// The name of a field that differs; empty if there is none.
  std::string difference(const FieldBytes& other) const {
    for (std::size_t k = 0; k < bytes_.size(); ++k) {
      if (bytes_[k].second != other.bytes_[k].second) return bytes_[k].first;
    }
    return {};
  }

 private:
  template <class Number>
  static void append(std::string& bytes, const Number& number) {
    static_assert(std::is_trivially_copyable_v<Number>);
    const auto at = bytes.size();
    bytes.resize(at + sizeof number);
    std::memcpy(bytes.data() + at, &number, sizeof number);
  }

  std::vector<std::pair<std::string, std::string>> bytes_;
};

/// What is the same in all parts: the polytope, and how it was searched.
FieldBytes common_fields(const ForceRanges& part) {
  FieldBytes bytes;
  result_fields::visit_problem(part, bytes);
  const auto add = [&](const char* name, const auto& value) {
    bytes(Field{"", name, "", "", FieldSource::kProblem}, value);
  };
  add("doubtful", part.doubtful);
  add("method", part.method);
  add("formulation", part.formulation);
  add("gap", part.gap);
  add("states", part.state_kind);
  add("states_of", part.states_of);
  add("smallest distances", part.smallest.outcome.rows());
  return bytes;
}

class Joiner {
 public:
  Joiner(const Packing& packing, const ContactChoice& choice, std::span<const ForceRanges> parts)
      : packing_(packing),
        choice_(choice),
        parts_(parts),
        contacts_(chosen_contacts(choice, packing.contact_count())) {}

  ForceRanges run() {
    require_agreement();
    assign_contacts();
    joined_ = parts_.front();
    joined_.choice = choice_.kind;
    joined_.requested = static_cast<int>(contacts_.size());
    join_tables();
    join_states();
    join_rays();
    join_duals();
    for (const ForceRanges& part : parts_) {
      if (part.reactions.count() > 0) joined_.reactions = part.reactions;
    }
    add_up();
    find_largest_residuals();
    static_cast<Measures&>(joined_) = measure(packing_, joined_, joined_, joined_, joined_);
    return std::move(joined_);
  }

 private:
  void require_agreement() const {
    if (parts_.empty()) throw InputError("there is no part to join");
    const FieldBytes first = common_fields(parts_.front());
    for (const ForceRanges& part : parts_) {
      if (part.value.rows() != packing_.contact_count()) {
        throw InputError(fmt::format("a part has {} contacts, and the packing has {}", part.value.rows(),
                                     packing_.contact_count()));
      }
      if (const std::string field = first.difference(common_fields(part)); !field.empty())
        throw InputError(fmt::format("the parts are of different analyses: they differ in {}", field));
    }
    if (parts_.front().status == PolytopeStatus::kEmpty)
      throw InputError("there are no ranges to join, for no state is admissible");
  }

  /// Finds the part that has each contact.
  void assign_contacts() {
    part_of_.assign(static_cast<std::size_t>(packing_.contact_count()), nullptr);
    for (const ForceRanges& part : parts_) {
      for (Eigen::Index i = 0; i < part.outcome.rows(); ++i) {
        if (part.outcome(i, kMinR) == Outcome::kNotRequested) continue;
        const ForceRanges*& owner = part_of_[static_cast<std::size_t>(i)];
        if (owner != nullptr) throw InputError(fmt::format("contact {} is in two parts", i));
        owner = &part;
        if (!std::binary_search(contacts_.begin(), contacts_.end(), static_cast<int>(i)))
          throw InputError(fmt::format("contact {} is in a part, and was not asked for", i));
      }
    }
    for (const int i : contacts_) {
      if (part_of_[static_cast<std::size_t>(i)] == nullptr)
        throw InputError(fmt::format("contact {} is in no part", i));
    }
  }

  const ForceRanges& part_of(int contact) const { return *part_of_[static_cast<std::size_t>(contact)]; }

  /// Takes the rows of a table from the parts that have them.
  template <class Table>
  void take_rows(const Table& table) {
    auto& to = table(joined_);
    for (const int i : contacts_) to.row(i) = table(part_of(i)).row(i);
  }

  void join_tables() {
    take_rows([](auto& r) -> auto& { return r.value; });
    take_rows([](auto& r) -> auto& { return r.lower; });
    take_rows([](auto& r) -> auto& { return r.upper; });
    take_rows([](auto& r) -> auto& { return r.sensitivity.value; });
    take_rows([](auto& r) -> auto& { return r.sensitivity.claim; });
    take_rows([](auto& r) -> auto& { return r.outcome; });
    take_rows([](auto& r) -> auto& { return r.primal_residual; });
    take_rows([](auto& r) -> auto& { return r.dual_residual; });
    take_rows([](auto& r) -> auto& { return r.unique; });
    if (joined_.smallest.outcome.rows() == 0) return;
    take_rows([](auto& r) -> auto& { return r.smallest.d_R; });
    take_rows([](auto& r) -> auto& { return r.smallest.d_T; });
    take_rows([](auto& r) -> auto& { return r.smallest.lower; });
    take_rows([](auto& r) -> auto& { return r.smallest.shortage; });
    take_rows([](auto& r) -> auto& { return r.smallest.outcome; });
  }

  /// A state is told by the half-planes that define it. Where parts have it with other roundings, the first
  /// one stands for all, and the values are those of that.
  void join_states() {
    std::map<std::vector<std::int32_t>, std::int32_t> rows;
    std::vector<std::pair<const ForceRanges*, std::int32_t>> first;
    std::vector<double> residual;
    for (const int i : contacts_) {
      const ForceRanges& part = part_of(i);
      for (int column = 0; column < 4; ++column) {
        std::int32_t& row = joined_.vertex(i, column);
        row = -1;
        const std::int32_t there = part.vertex(i, column);
        if (there < 0) continue;
        const auto active = part.active.row(there);
        const auto [entry, is_new] =
            rows.emplace(std::vector<std::int32_t>(active.begin(), active.end()), std::ssize(first));
        if (is_new) {
          first.emplace_back(&part, there);
          residual.push_back(part.primal_residual(i, column));
        }
        row = entry->second;
        const auto& [owner, at] = first[static_cast<std::size_t>(row)];
        joined_.value(i, column) = owner->states(at, 2 * i + (column >= kMinT ? 1 : 0));
        joined_.primal_residual(i, column) = residual[static_cast<std::size_t>(row)];
      }
    }
    joined_.states.resize(std::ssize(first), 2 * packing_.contact_count());
    joined_.active.resize(std::ssize(first), parts_.front().active.cols());
    for (Eigen::Index row = 0; row < std::ssize(first); ++row) {
      const auto& [owner, at] = first[static_cast<std::size_t>(row)];
      joined_.states.row(row) = owner->states.row(at);
      joined_.active.row(row) = owner->active.row(at);
    }
    std::vector<std::int32_t> kept;
    for (const ForceRanges& part : parts_)
      kept.insert(kept.end(), part.state_contacts.begin(), part.state_contacts.end());
    std::sort(kept.begin(), kept.end());
    joined_.state_contacts = Eigen::Map<const Eigen::ArrayXi>(kept.data(), std::ssize(kept));
  }

  void join_rays() {
    std::map<std::vector<double>, std::int32_t> rows;
    std::vector<std::vector<double>> rays;
    for (const int i : contacts_) {
      const ForceRanges& part = part_of(i);
      for (int column = 0; column < 4; ++column) {
        std::int32_t& row = joined_.ray(i, column);
        row = -1;
        if (part.ray(i, column) < 0) continue;
        const auto there = part.rays.row(part.ray(i, column));
        const auto [entry, is_new] =
            rows.emplace(std::vector<double>(there.begin(), there.end()), std::ssize(rays));
        if (is_new) rays.push_back(entry->first);
        row = entry->second;
      }
    }
    joined_.rays.resize(std::ssize(rays), 2 * packing_.contact_count());
    for (Eigen::Index row = 0; row < std::ssize(rays); ++row) {
      joined_.rays.row(row) = Eigen::Map<const Eigen::RowVectorXd>(rays[static_cast<std::size_t>(row)].data(),
                                                                   joined_.rays.cols());
    }
  }

  void join_duals() {
    joined_.duals = {};
    std::map<std::int32_t, std::pair<const Duals*, Eigen::Index>> all;
    for (const ForceRanges& part : parts_) {
      for (Eigen::Index d = 0; d < part.duals.contacts.size(); ++d)
        all[part.duals.contacts[d]] = {&part.duals, d};
    }
    if (all.empty()) return;
    Duals& duals = joined_.duals;
    const Duals& one = *all.begin()->second.first;
    duals.seed = one.seed;
    duals.bounding = one.bounding;
    duals.contacts.resize(std::ssize(all));
    duals.multipliers.resize(4 * std::ssize(all), one.multipliers.cols());
    duals.points.resize(4 * std::ssize(all), one.points.cols());
    Eigen::Index d = 0;
    for (const auto& [contact, place] : all) {
      const auto& [from, at] = place;
      duals.contacts[d] = contact;
      duals.multipliers.middleRows<4>(Duals::row_of(d, 0)) =
          from->multipliers.middleRows<4>(Duals::row_of(at, 0));
      duals.points.middleRows<4>(Duals::row_of(d, 0)) = from->points.middleRows<4>(Duals::row_of(at, 0));
      ++d;
    }
  }

  /// Counts, work and times, of all parts but the first, which is there already.
  void add_up() {
    for (const ForceRanges& part : parts_.subspan(1)) {
      const auto add = [&](auto count) { joined_.*count += part.*count; };
      add(&ForceRanges::objectives);
      add(&ForceRanges::certified);
      add(&ForceRanges::unbounded);
      add(&ForceRanges::enclosed);
      add(&ForceRanges::imprecise);
      add(&ForceRanges::failed);
      add(&ForceRanges::determined);
      add(&ForceRanges::solves);
      add(&ForceRanges::pivots);
      add(&ForceRanges::paper);
      for (const auto& [stage, seconds] : part.seconds) joined_.seconds[stage] += seconds;
    }
  }

  /// Not those of the parts, which may have a state with other roundings.
  void find_largest_residuals() {
    joined_.residual = joined_.worst_primal_residual = joined_.worst_dual_residual = 0;
    const StateChecker check(packing_);
    for (Eigen::Index row = 0; row < joined_.states.rows(); ++row) {
      const SceneForces state(joined_.states.row(row).transpose());
      joined_.residual = std::max(joined_.residual, check(state).imbalance);
    }
    for (const int i : contacts_) {
      for (int column = 0; column < 4; ++column) {
        if (joined_.outcome(i, column) == Outcome::kFailed) continue;
        joined_.worst_primal_residual =
            std::fmax(joined_.worst_primal_residual, joined_.primal_residual(i, column));
        joined_.worst_dual_residual =
            std::fmax(joined_.worst_dual_residual, joined_.dual_residual(i, column));
      }
    }
  }

  const Packing& packing_;
  const ContactChoice& choice_;
  std::span<const ForceRanges> parts_;
  std::vector<int> contacts_;                ///< of the choice, ascending
  std::vector<const ForceRanges*> part_of_;  ///< one a contact; null where it is not wanted
  ForceRanges joined_;
};

}  // namespace

ForceRanges join_ranges(const Packing& packing, const ContactChoice& choice,
                        std::span<const ForceRanges> parts) {
  return Joiner(packing, choice, parts).run();
}

}  // namespace indet
