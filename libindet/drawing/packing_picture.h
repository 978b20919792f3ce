#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>

#include "libindet/packing/packing.h"

namespace indet {

/// A picture of a packing, as a vector or pixel graphic by the extension of its file: .svg, .pdf, .png
/// (300 dpi). Disks and walls, and one of:
///
///   forces    Lines between the centres (to the contact point at a wall) with thickness ∝ R. The tangential
///             force on each disk is a line of length ∝ |T| tangent to the disk at the contact, in the
///             direction of the force on that disk. T > 0 turns both disks counter-clockwise (the torque on
///             each is +rT); both signs also differ in colour. (Fig. 5 of McNamara and Herrmann.)
///   delta_R   Lines of one thickness, coloured by δR [23] with a colour bar in the unit of force. Unbounded
///             ones are dashed red; those without a value are thin and grey. Where δR is an estimate the line
///             has the colour of the estimate and half of the thickness.
///
/// A legend gives the scales; the caption stands below.

/// Draws the state `forces` (2M, in the scene's units; NaN: the contact is drawn thin and dashed).
void draw_forces(const std::filesystem::path& path, const Packing& packing,
                 const Eigen::Ref<const Eigen::VectorXd>& forces, const std::string& caption);

/// Draws `delta_R` (M, dimensionless; inf and NaN as above). `estimate`: M, not NaN where δR is an estimate
/// instead; or empty.
void draw_delta_R(const std::filesystem::path& path, const Packing& packing,
                  const Eigen::Ref<const Eigen::VectorXd>& delta_R,
                  const Eigen::Ref<const Eigen::VectorXd>& estimate, const std::string& caption);

}  // namespace indet
