#pragma once

#include <array>
#include <cstdint>
#include <tuple>

#include "libindet/range/force_ranges.h"

namespace indet {

/// How many: N disks, W walls, M contacts, K extremal states, Q rays, d = dim F; P reactions, of which S
/// states and U rays; B bounds of forces; C contacts whose states are kept; D contacts whose duals are, of Y
/// rows.
enum class Extent : std::uint8_t {
  kOne,
  kDirections,      ///< 2: along normal and tangent (R and T), or x and y
  kComponents,      ///< 3: x, y, rotation
  kColumns,         ///< 4: R_min, R_max, T_min, T_max
  kDisks,           ///< N
  kWalls,           ///< W
  kContacts,        ///< M
  kForces,          ///< 2M: R_1, T_1, …, R_M, T_M
  kStates,          ///< K
  kRays,            ///< Q
  kActive,          ///< d
  kReactions,       ///< P
  kEnds,            ///< 2: minimum, maximum
  kReactionStates,  ///< S
  kReactionRays,    ///< U
  kBounds,          ///< B: of force_bounds()
  kStateContacts,   ///< C: contacts whose states are kept, where not all are
  kDualContacts,    ///< D
  kDualValues,      ///< 4D: R_min, R_max, T_min, T_max of the first contact, …
  kSceneRows        ///< Y: 3N + 2W + 3 + B (duals.h)
};
/// "1", "2", "3", "4", "N", "W", "M", "2M", "K", "Q", "d", "P", "2", "S", "U", "B", "C", "D", "4D", "Y".
const char* to_string(Extent extent);

/// When a field has something to say; else files leave it out.
enum class Presence : std::uint8_t {
  kAlways,
  kSubset,         ///< where not all contacts were asked for
  kSample,         ///< where a sample of contacts was
  kDrawn,          ///< where that was drawn with unequal probabilities
  kSeed,           ///< where a seed drew contacts
  kEstimate,       ///< where δ is estimated
  kPaper,          ///< where the method is kPivotingPaper
  kInterval,       ///< where values are known to intervals of an asked-for width
  kDuals,          ///< where duals are kept
  kReason,         ///< where the method was chosen by the program
  kExact,          ///< where rational arithmetic found all of them
  kHairline,       ///< where a decision lies within rounding
  kUnknownBlocks,  ///< where the number of blocks is not known
  kRandom,         ///< where that goes to a neighbour by chance
  kWhereRows       ///< where the table has rows
};

/// What a field follows from, and so where it must be the same.
enum class FieldSource : std::uint8_t {
  kProblem,    ///< the packing and the request: exactly the same, whatever the method
  kAnswer,     ///< the polytope: the same within rounding
  kEnclosure,  ///< bounds of an answer: intervals of the same answer overlap
  kState,      ///< the same where the method takes the same of several states that attain a value
  kProof,      ///< one of several that would do
  kRounding,   ///< the roundings of a computation
  kWork        ///< how the result was found
};

/// One field of the results, and what is told of it everywhere: in files, JSON, tables, tests. `group` and
/// `name` are those of the HDF5 object, a dataset where the shape is not 1 × 1 and otherwise an attribute of
/// `group`. `unit` is "1" for pure numbers and text, "mg" for forces in the packing's unit of force, and
/// "force" for those in the scene's ("force*length" for torques).
struct Field {
  const char* group;
  const char* name;
  const char* unit;
  const char* meaning;  ///< ASCII: the long_name of a dataset
  FieldSource source;
  Extent rows = Extent::kOne;
  Extent columns = Extent::kOne;
  Presence presence = Presence::kAlways;

  bool is_dataset() const { return rows != Extent::kOne; }
};

/// Whether a field has something to say; of tables `row_count` is the number of rows.
bool is_present(Presence presence, const ForceRanges& ranges, std::int64_t row_count);

namespace result_fields {

/// Calls visit(Field, value) for each field of a part, in the order of files. What decides about the presence
/// of others comes first. `Part` may be const; values are references, views of columns, or tuples of
/// references.
template <class Part, class Visit>
void visit_problem(Part& r, Visit& visit) {
  const auto attribute = [&](const char* name, const char* meaning, auto& value,
                             FieldSource source = FieldSource::kAnswer, const char* unit = "1") {
    visit(Field{"/equilibrium", name, unit, meaning, source}, value);
  };
  attribute("status", "what the polytope is: bounded, unbounded, point, empty", r.status);
  attribute("unknowns", "unknown forces", r.unknowns, FieldSource::kProblem);
  attribute("equations", "equations of equilibrium", r.equations, FieldSource::kProblem);
  attribute("rank", "rank of the equations", r.rank);
  attribute("nullity", "dimension of the kernel", r.nullity);
  attribute("dim", "dimension of the polytope, -1 if it is empty", r.dim);
  attribute("blocks", "independent parts of the polytope, -1 if not known", r.blocks);
  visit(Field{"/equilibrium", "blocks_reason", "1", "why they are not known", FieldSource::kRounding,
              Extent::kOne, Extent::kOne, Presence::kUnknownBlocks},
        r.blocks_reason);
  attribute("rank_ambiguous", "1 if the rank lies within rounding", r.rank_ambiguous);
  visit(
      Field{"/equilibrium", "exact", "1", "1 if rational arithmetic found all results, from the polytope on",
            FieldSource::kRounding, Extent::kOne, Extent::kOne, Presence::kExact},
      r.exact);
  visit(
      Field{
          "/equilibrium", "hairline", "1",
          "relative change of the packing's numbers that may alter a decision about the polytope, estimated",
          FieldSource::kRounding, Extent::kOne, Extent::kOne, Presence::kHairline},
      r.hairline);
  attribute("rank_gap", "smallest accepted over largest rejected singular value, estimated", r.rank_gap,
            FieldSource::kRounding);
  attribute("smallest_accepted", "smallest singular value that counts, estimated", r.smallest_accepted,
            FieldSource::kRounding);
  attribute("largest_rejected", "largest singular value that counts as zero, estimated", r.largest_rejected,
            FieldSource::kRounding);
  attribute("force_unit", "mg, the unit of force of residuals and measures", r.force_unit,
            FieldSource::kProblem, "force");
  visit(Field{"/equilibrium", "motion", "1",
              "virtual velocity x, y and r*omega with which the disks move where no state is admissible",
              FieldSource::kProof, Extent::kDisks, Extent::kComponents, Presence::kWhereRows},
        r.motion);
  visit(Field{"/equilibrium", "wall_motion", "1",
              "virtual velocity along normal and tangent with which loaded walls move then",
              FieldSource::kProof, Extent::kWalls, Extent::kDirections, Presence::kWhereRows},
        r.wall_motion);
  visit(Field{"/equilibrium", "cell_motion", "1",
              "rate of compression times the length of the cell then, rows x, y and columns x, y",
              FieldSource::kProof, Extent::kDirections, Extent::kDirections, Presence::kWhereRows},
        r.cell_motion);
  visit(Field{"/equilibrium", "bound_multipliers", "1",
              "multipliers with which bounds of forces take part in the proof then", FieldSource::kProof,
              Extent::kBounds, Extent::kOne, Presence::kWhereRows},
        r.bound_multipliers);
}

template <class Part, class Visit>
void visit_request(Part& r, Visit& visit) {
  const auto attribute = [&](const char* name, const char* meaning, Presence presence, auto& value) {
    visit(Field{"/ranges", name, "1", meaning, FieldSource::kProblem, Extent::kOne, Extent::kOne, presence},
          value);
  };
  attribute("contacts", "which contacts were asked for: list, sample, calibration", Presence::kSubset,
            r.choice);
  attribute("requested", "number of contacts that were asked for", Presence::kSubset, r.requested);
  attribute("draws", "draws with unequal probabilities, with replacement", Presence::kDrawn, r.draws);
  attribute("sample_seed", "seed that drew the sample, or the contacts that calibrate", Presence::kSeed,
            r.sample_seed);
  const auto table = [&](const char* name, const char* unit, const char* meaning, FieldSource source,
                         Extent columns, auto& value) {
    visit(Field{"/ranges", name, unit, meaning, source, Extent::kContacts, columns, Presence::kWhereRows},
          value);
  };
  table("draw_weight", "1", "a whole number that the probability of a draw is proportional to",
        FieldSource::kAnswer, Extent::kOne, r.weight);
  table("drawn", "1", "how often the contact was drawn", FieldSource::kAnswer, Extent::kOne, r.drawn);
  table("centre", "force", "R and T of the analytic centre", FieldSource::kAnswer, Extent::kDirections,
        r.centre);
  table("width", "force", "widths of R and T of the Dikin ellipsoid about the centre", FieldSource::kAnswer,
        Extent::kDirections, r.width);
}

template <class Part, class Visit>
void visit_certified(Part& r, Visit& visit) {
  const auto column = [&](Column c, const char* meaning) {
    visit(Field{"/ranges", to_string(c), "force", meaning, FieldSource::kAnswer, Extent::kContacts},
          r.value.col(c));
  };
  column(kMinR, "smallest normal force, inf where unbounded, NaN where not found");
  column(kMaxR, "largest normal force, inf where unbounded, NaN where not found");
  column(kMinT, "smallest tangential force, inf where unbounded, NaN where not found");
  column(kMaxT, "largest tangential force, inf where unbounded, NaN where not found");
  const auto table = [&](const char* name, const char* unit, const char* meaning, FieldSource source,
                         auto& value) {
    visit(Field{"/ranges", name, unit, meaning, source, Extent::kContacts, Extent::kColumns}, value);
  };
  table("lower", "force", "lower end of the enclosure of R_min, R_max, T_min, T_max", FieldSource::kEnclosure,
        r.lower);
  table("upper", "force", "upper end of the enclosure of R_min, R_max, T_min, T_max", FieldSource::kEnclosure,
        r.upper);
  table("sensitivity", "force/radian",
        "how far the value moves at most, to first order, when every normal turns, per angle",
        FieldSource::kProof, r.sensitivity.value);
  table("sensitivity_claim", "1",
        "of sensitivity: 0 that of one of perhaps several solutions, 1 a bound, 2 exact", FieldSource::kProof,
        r.sensitivity.claim);
  table("primal_residual", "mg", "violation of equilibrium and contact conditions by the extremal state",
        FieldSource::kRounding, r.primal_residual);
  table("dual_residual", "1", "largest reduced cost of the wrong sign", FieldSource::kRounding,
        r.dual_residual);
  table("outcome", "1", "what became of R_min, R_max, T_min, T_max", FieldSource::kAnswer, r.outcome);
  const auto attribute = [&](const char* name, const char* meaning, FieldSource source, auto& value) {
    visit(Field{"/equilibrium", name, "1", meaning, source}, value);
  };
  attribute("doubtful", "1 if some decision about the polytope lies within rounding", FieldSource::kAnswer,
            r.doubtful);
  attribute("objectives", "values that were asked for", FieldSource::kProblem, r.objectives);
  attribute("certified", "values that are certain: optimal or unbounded", FieldSource::kAnswer, r.certified);
  attribute("unbounded", "of these, unbounded ones", FieldSource::kAnswer, r.unbounded);
  attribute("imprecise", "values that are uncertain", FieldSource::kAnswer, r.imprecise);
  attribute("failed", "values that were not found", FieldSource::kAnswer, r.failed);
  visit(Field{"/equilibrium", "residual", "mg", "largest imbalance of the extremal states, kept or not",
              FieldSource::kRounding},
        r.residual);
  attribute("worst_primal_residual", "largest entry of primal_residual", FieldSource::kRounding,
            r.worst_primal_residual);
  attribute("worst_dual_residual", "largest entry of dual_residual", FieldSource::kRounding,
            r.worst_dual_residual);
}

template <class Part, class Visit>
void visit_reactions(Part& r, Visit& visit) {
  const auto field = [&](const char* name, const char* unit, const char* meaning, FieldSource source,
                         Extent rows, Extent columns, auto& value) {
    visit(Field{"/reactions", name, unit, meaning, source, rows, columns, Presence::kWhereRows}, value);
  };
  field("body", "1", "row of a fixed disk, or -(w+1) for the wall of row w", FieldSource::kProblem,
        Extent::kReactions, Extent::kOne, r.body);
  field("component", "1", "wall: 0 sum of R, 1 sum of T; disk: 0, 1 force x, y on it, 2 torque on it",
        FieldSource::kProblem, Extent::kReactions, Extent::kOne, r.component);
  const auto ends = [&](const char* name, const char* unit, const char* meaning, FieldSource source,
                        auto& value) {
    field(name, unit, meaning, source, Extent::kReactions, Extent::kEnds, value);
  };
  const char* const unit = "force or force*length";
  ends("value", unit, "smallest and largest value, inf where unbounded, NaN where not found",
       FieldSource::kAnswer, r.value);
  ends("lower", unit, "lower end of the enclosure of both", FieldSource::kEnclosure, r.lower);
  ends("upper", unit, "upper end of the enclosure of both", FieldSource::kEnclosure, r.upper);
  ends("outcome", "1", "what became of both", FieldSource::kAnswer, r.outcome);
  ends("vertex", "1", "row of /reactions/states that attains the value, -1 for none", FieldSource::kProof,
       r.vertex);
  ends("ray", "1", "row of /reactions/rays along which the value grows without limit, -1 for none",
       FieldSource::kProof, r.ray);
  field("states", "force", "states (R_1, T_1, ..., R_M, T_M) that attain the values", FieldSource::kProof,
        Extent::kReactionStates, Extent::kForces, r.states);
  field("rays", "1", "directions (R_1, T_1, ..., R_M, T_M) along which values grow without limit",
        FieldSource::kProof, Extent::kReactionRays, Extent::kForces, r.rays);
}

template <class Part, class Visit>
void visit_extremal(Part& r, Visit& visit) {
  visit(Field{"/ranges", "states", "1", "which extremal states are kept: none, canonical, solver, unknown",
              FieldSource::kProblem},
        r.state_kind);
  visit(Field{"/ranges", "states_of", "1", "of which contacts: all, list, largest", FieldSource::kProblem},
        r.states_of);
  visit(Field{"/extremal", "contacts", "1", "these contacts, where not all", FieldSource::kAnswer,
              Extent::kStateContacts, Extent::kOne, Presence::kWhereRows},
        r.state_contacts);
  visit(Field{"/extremal", "states", "force", "extremal states (R_1, T_1, ..., R_M, T_M), each once",
              FieldSource::kState, Extent::kStates, Extent::kForces},
        r.states);
  visit(Field{"/extremal", "active", "1",
              "half-planes that define the state: 2a for mu R + T >= 0, 2a+1 for mu R - T >= 0",
              FieldSource::kProof, Extent::kStates, Extent::kActive},
        r.active);
  visit(Field{"/extremal", "rays", "1",
              "directions (R_1, T_1, ..., R_M, T_M) in which forces can be added without limit",
              FieldSource::kProof, Extent::kRays, Extent::kForces, Presence::kWhereRows},
        r.rays);
  const auto table = [&](const char* name, const char* meaning, FieldSource source, auto& value) {
    visit(Field{"/ranges", name, "1", meaning, source, Extent::kContacts, Extent::kColumns}, value);
  };
  table("unique", "1 if only one state attains the value", FieldSource::kAnswer, r.unique);
  table("vertex", "row of /extremal/states that attains the value, -1 where none is kept",
        FieldSource::kState, r.vertex);
  table("ray", "row of /extremal/rays along which the value grows without limit, -1 for none",
        FieldSource::kProof, r.ray);
}

template <class Part, class Visit>
void visit_smallest(Part& r, Visit& visit) {
  const auto field = [&](const char* name, const char* unit, const char* meaning, FieldSource source,
                         Extent columns, auto& value) {
    visit(Field{"/ranges", name, unit, meaning, source, Extent::kContacts, columns, Presence::kWhereRows},
          value);
  };
  field("d_R_min", "mg", "smallest distance of states of largest and smallest normal force, NaN if not known",
        FieldSource::kEnclosure, Extent::kOne, r.d_R);
  field("d_T_min", "mg",
        "smallest distance of states of largest and smallest tangential force, NaN if not known",
        FieldSource::kEnclosure, Extent::kOne, r.d_T);
  field("d_min_lower", "mg", "proven lower bound of the smallest distance, for R and T",
        FieldSource::kEnclosure, Extent::kDirections, r.lower);
  field("d_min_shortage", "mg", "by how much the values of the two states miss the extremes at most",
        FieldSource::kRounding, Extent::kDirections, r.shortage);
  field("d_min_outcome", "1", "what became of d_R_min, d_T_min", FieldSource::kAnswer, Extent::kDirections,
        r.outcome);
}

template <class Part, class Visit>
void visit_measures(Part& r, Visit& visit) {
  const auto column = [&](const char* name, const char* unit, const char* meaning, FieldSource source,
                          auto& value) {
    visit(Field{"/ranges", name, unit, meaning, source, Extent::kContacts}, value);
  };
  column("delta_R", "mg", "local indeterminacy of the normal force, inf where unbounded",
         FieldSource::kAnswer, r.delta_R);
  column("delta_T", "mg", "local indeterminacy of the tangential force, inf where unbounded",
         FieldSource::kAnswer, r.delta_T);
  column("d_R", "mg", "global indeterminacy of the normal force, NaN where a state is not kept",
         FieldSource::kState, r.d_R);
  column("d_T", "mg", "global indeterminacy of the tangential force, NaN where a state is not kept",
         FieldSource::kState, r.d_T);
  column("R_star", "1", "place of the simulated normal force in its range, NaN if unknown",
         FieldSource::kAnswer, r.R_star);
  column("T_star", "1", "place of the simulated tangential force in its range, NaN if unknown",
         FieldSource::kAnswer, r.T_star);
  visit_smallest(r.smallest, visit);
  visit(Field{"/extremal", "norm", "force", "Euclidean norm of the state", FieldSource::kState,
              Extent::kStates},
        r.norm);
  visit(Field{"/extremal", "largest_norm", "1", "row of the state of largest norm, -1 for none",
              FieldSource::kState},
        r.largest_norm);
  visit(Field{"/equilibrium", "sliding", "1",
              "sliding contacts of the simulated state, non-transmitting ones twice, -1 if unknown",
              FieldSource::kProblem},
        r.sliding);
  visit(Field{"/equilibrium", "non_transmitting", "1",
              "non-transmitting contacts of the simulated state, -1 if unknown", FieldSource::kProblem},
        r.non_transmitting);
  const auto estimate = [&](const char* name, const char* meaning, auto&& value) {
    visit(Field{"/ranges", name, "1", meaning, FieldSource::kAnswer, Extent::kOne, Extent::kOne,
                Presence::kSample},
          value);
  };
  const char* const mean = "mean over all contacts as the sample tells it: in the sample, lowest, highest";
  const char* const band = "largest distance of the sample's distribution from that of all contacts";
  estimate("mean_delta_R", mean, std::tie(r.sample_R.mean, r.sample_R.low, r.sample_R.high));
  estimate("band_delta_R", band, r.sample_R.band);
  estimate("mean_delta_T", mean, std::tie(r.sample_T.mean, r.sample_T.low, r.sample_T.high));
  estimate("band_delta_T", band, r.sample_T.band);
  visit(Field{"/ranges", "estimator", "1",
              "of these means: mean of z = delta/(M p), or regression of z on predictions over M p",
              FieldSource::kAnswer, Extent::kOne, Extent::kOne, Presence::kDrawn},
        r.estimator);
}

template <class Part, class Visit>
void visit_estimates(Part& r, Visit& visit) {
  const auto attribute = [&](const char* name, const char* meaning, auto& value) {
    visit(Field{"/ranges", name, "1", meaning, FieldSource::kProblem, Extent::kOne, Extent::kOne,
                Presence::kEstimate},
          value);
  };
  attribute("calibration", "contacts that were to calibrate estimates, 0: stored coefficients alone",
            r.calibration);
  attribute("coverage", "probability that an interval of an estimate is made for", r.coverage);
  const auto table = [&](const char* name, const char* unit, const char* meaning, auto& value) {
    visit(Field{"/ranges", name, unit, meaning, FieldSource::kAnswer, Extent::kContacts, Extent::kOne,
                Presence::kWhereRows},
          value);
  };
  table("calibrates", "1", "1 if estimates were calibrated on the contact", r.calibrates);
  table("delta_R_estimate", "mg", "prediction of delta_R, NaN where that is known", r.estimated_R.estimate);
  table("delta_R_low", "mg", "lower end of the interval of the prediction", r.estimated_R.low);
  table("delta_R_high", "mg", "upper end of the interval of the prediction", r.estimated_R.high);
  table("delta_T_estimate", "mg", "prediction of delta_T, NaN where that is known", r.estimated_T.estimate);
  table("delta_T_low", "mg", "lower end of the interval of the prediction", r.estimated_T.low);
  table("delta_T_high", "mg", "upper end of the interval of the prediction", r.estimated_T.high);
}

template <class Part, class Visit>
void visit_duals(Part& r, Visit& visit) {
  const auto table = [&](const char* name, const char* unit, const char* meaning, FieldSource source,
                         Extent rows, Extent columns, auto& value) {
    visit(Field{"/duals", name, unit, meaning, source, rows, columns, Presence::kWhereRows}, value);
  };
  table("contacts", "1", "contacts whose values these prove", FieldSource::kProblem, Extent::kDualContacts,
        Extent::kOne, r.contacts);
  visit(Field{"/duals", "seed", "1", "seed that drew these contacts, -1: all that were asked for",
              FieldSource::kProblem, Extent::kOne, Extent::kOne, Presence::kDuals},
        r.seed);
  table("bounding", "1", "multipliers that limit every force", FieldSource::kProof, Extent::kSceneRows,
        Extent::kOne, r.bounding);
  table("multipliers", "1", "multipliers that bound R_min, R_max, T_min, T_max of these contacts in turn",
        FieldSource::kProof, Extent::kDualValues, Extent::kSceneRows, r.multipliers);
  table("points", "force", "states (R_1, T_1, ..., R_M, T_M) close to these values", FieldSource::kProof,
        Extent::kDualValues, Extent::kForces, r.points);
}

template <class Part, class Visit>
void visit_work(Part& r, Visit& visit) {
  const auto attribute = [&](const char* name, const char* meaning, Presence presence, auto& value) {
    visit(Field{"/provenance/work", name, "1", meaning, FieldSource::kWork, Extent::kOne, Extent::kOne,
                presence},
          value);
  };
  visit(Field{"/equilibrium", "determined", "1", "values that are the same in every state",
              FieldSource::kAnswer},
        r.determined);
  attribute("method", "how the extremal states were found", Presence::kAlways, r.method);
  attribute("reason", "why this method was taken, where it was not asked for", Presence::kReason, r.reason);
  const auto of_intervals = [&](const char* name, const char* meaning, FieldSource source, auto& value) {
    visit(Field{"/equilibrium", name, "1", meaning, source, Extent::kOne, Extent::kOne, Presence::kInterval},
          value);
  };
  of_intervals("gap", "largest width of an enclosed value, relative to max(1 mg, |value|)",
               FieldSource::kProblem, r.gap);
  of_intervals("enclosed", "certified values that are known to such an interval", FieldSource::kAnswer,
               r.enclosed);
  attribute("formulation", "of the linear programs, empty where there were none", Presence::kAlways,
            r.formulation);
  attribute("solves", "searches for an optimum", Presence::kAlways, r.solves);
  attribute("pivots", "steps of these", Presence::kAlways, r.pivots);
  attribute("neighbour_rule", "which better neighbour a walk goes to: first, best, random", Presence::kPaper,
            r.paper_options.neighbour);
  attribute("walk_start", "where a walk starts: common, minimum", Presence::kPaper, r.paper_options.start);
  attribute("walk_seed", "seed of the order of the neighbours", Presence::kRandom, r.paper_options.seed);
  // In the order of InteriorEnd and of WalkEnd.
  constexpr std::array<const char*, kInteriorEnds> kStarts = {"start_simulated", "start_unknown",
                                                              "start_outside", "start_tight_corner"};
  constexpr std::array<const char*, kWalkEnds> kEnds = {"walks_none_better",      "walks_more_active",
                                                        "walks_fewer_active",     "walks_directions_lost",
                                                        "walks_edge_without_end", "walks_step_limit"};
  for (std::size_t end = 0; end < kStarts.size(); ++end)
    attribute(kStarts[end], "blocks by their start", Presence::kPaper, r.paper.starts[end]);
  for (std::size_t end = 0; end < kEnds.size(); ++end)
    attribute(kEnds[end], "walks by their end", Presence::kPaper, r.paper.walks[end]);
  attribute("sliding_left", "active constraints left on the way to the interior", Presence::kPaper,
            r.paper.sliding_left);
  attribute("extremal_points", "extremal points passed", Presence::kPaper, r.paper.points);
  attribute("unexpected_points", "of these, with more active constraints than dimensions", Presence::kPaper,
            r.paper.unexpected);
  attribute("neighbours", "neighbours looked at", Presence::kPaper, r.paper.neighbours);
}

}  // namespace result_fields

/// Calls visit(Field, value) for every field of the results but the timings, each once. This is the one list
/// of them: HDF5 files, JSON, tables of contacts and the comparisons of tests are made from it. `Ranges` is
/// ForceRanges, const or not; `visit` takes values as forwarding references.
template <class Ranges, class Visit>
void visit_fields(Ranges& ranges, Visit&& visit) {
  result_fields::visit_request(ranges, visit);
  result_fields::visit_problem(ranges, visit);
  result_fields::visit_certified(ranges, visit);
  result_fields::visit_extremal(ranges, visit);
  result_fields::visit_measures(ranges, visit);
  result_fields::visit_estimates(ranges, visit);
  result_fields::visit_reactions(ranges.reactions, visit);
  result_fields::visit_duals(ranges.duals, visit);
  result_fields::visit_work(ranges, visit);
}

}  // namespace indet
