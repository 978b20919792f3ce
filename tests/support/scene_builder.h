#pragma once

#include "libindet/packing/packing.h"

namespace indet::zoo {

/// Nothing, under gravity (0, −1).
Packing empty_scene();

/// Adds a homogeneous disk (moment of inertia m r²/2); ids count from 1.
DiskId add_disk(Packing& packing, Vector2 position, double radius = 1, double mass = 1);

/// Adds the wall through a point with a unit normal that points into the packing.
WallId add_wall(Packing& packing, Vector2 point, Vector2 normal);

/// Adds a contact whose normal and gap are those of the places.
void touch(Packing& packing, DiskId a, Body b, double mu);

}  // namespace indet::zoo
