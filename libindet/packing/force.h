#pragma once

#include <Eigen/Core>
#include <utility>

namespace indet {

/// The three units of force, as types: a number in one of them is not taken for a number in another.
struct SceneUnit;   ///< the scene's own, as in its files
struct WeightUnit;  ///< mg: the mean weight of a disk, or the unit that the scene names (Packing::force_unit)
struct InternalUnit;  ///< that in which the equilibrium problem is posed (Packing::internal_force_unit)

/// A force, or a vector or matrix of forces, in one unit. Of contact forces the order is R_1, T_1, …, R_M,
/// T_M [2]. It becomes one in another unit through a ForceUnits alone.
template <class Unit, class Value>
class Force {
 public:
  Force() = default;
  explicit Force(Value value) : value_(std::move(value)) {}
  const Value& value() const { return value_; }

 private:
  Value value_{};
};

using SceneForce = Force<SceneUnit, double>;
using SceneForces = Force<SceneUnit, Eigen::VectorXd>;
using SceneStates = Force<SceneUnit, Eigen::MatrixXd>;  ///< a column a state
using WeightForce = Force<WeightUnit, double>;
using WeightForces = Force<WeightUnit, Eigen::VectorXd>;
using WeightStates = Force<WeightUnit, Eigen::MatrixXd>;
using InternalForce = Force<InternalUnit, double>;
using InternalForces = Force<InternalUnit, Eigen::VectorXd>;
using InternalStates = Force<InternalUnit, Eigen::MatrixXd>;

/// Turns forces of one unit into forces of another: the only place where units of force meet.
class ForceUnits {
 public:
  ForceUnits() = default;
  /// Both in the scene's unit, positive.
  ForceUnits(double weight, double internal) : weight_(weight), internal_(internal) {}

  double weight_in_scene() const { return weight_; }
  double internal_in_scene() const { return internal_; }
  /// 1 for most scenes, exactly.
  double internal_in_weights() const { return internal_ / weight_; }

  template <class Value>
  Force<SceneUnit, Value> scene(const Force<InternalUnit, Value>& force) const {
    return Force<SceneUnit, Value>(force.value() * internal_);
  }
  template <class Value>
  Force<SceneUnit, Value> scene(const Force<WeightUnit, Value>& force) const {
    return Force<SceneUnit, Value>(force.value() * weight_);
  }
  template <class Value>
  Force<WeightUnit, Value> weights(const Force<InternalUnit, Value>& force) const {
    return Force<WeightUnit, Value>(force.value() * internal_in_weights());
  }
  template <class Value>
  Force<WeightUnit, Value> weights(const Force<SceneUnit, Value>& force) const {
    return Force<WeightUnit, Value>(force.value() / weight_);
  }
  template <class Value>
  Force<InternalUnit, Value> internal(const Force<SceneUnit, Value>& force) const {
    return Force<InternalUnit, Value>(force.value() / internal_);
  }
  template <class Value>
  Force<InternalUnit, Value> internal(const Force<WeightUnit, Value>& force) const {
    return Force<InternalUnit, Value>(force.value() / internal_in_weights());
  }

 private:
  double weight_ = 1;
  double internal_ = 1;
};

}  // namespace indet
