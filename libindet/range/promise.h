#pragma once

#include <Eigen/Core>

#include "libindet/packing/packing.h"

namespace indet {

/// The load that contact forces are measured by: m g plus what is applied, largest component (torques over
/// the radius), of the least loaded body of the contact that bears any, of free disks and loaded walls; but
/// at most the internal unit of force, which it is where no body of the contact bears any. In the scene's
/// units.
Eigen::VectorXd loads_at_contacts(const Packing& packing);

/// How wide the enclosure of a certified value may be: tolerance::kCertifiedWidth of the larger of |value|
/// and the load at the contact.
double promised_width(double value, double load);

}  // namespace indet
