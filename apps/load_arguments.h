#pragma once

#include <string>

#include "libindet/packing/loads.h"

namespace indet::app {

/// What --load says, in the scene's units: a sum of parts, joined by +,
///
///   disk=ID,fx,fy[,torque]   wall=NAME,normal,tangential   gravity=gx,gy   stress=xx,yy,xy
///
/// or a TOML file (its name ends with .toml):
///
///   gravity = [gx, gy]
///   stress = {xx = 1, yy = 1}              # also xy, pressure
///   [[disk]]
///   id = 7
///   force = [fx, fy]                       # and torque = 0.5
///   [[wall]]
///   name = "lid"
///   force = [normal, tangential]
///
/// Throws UsageError where the text does not read so, InputError for files, for bodies that are not there,
/// and for loads that no contact feels.
Loads parse_load(const std::string& text, const Packing& packing);

}  // namespace indet::app
