// How far rays of a small part of a picture go at most before all of them have met the surface.
#pragma once

#include "reference/beam_start.h"
#include "reference/height_pyramid.h"
#include "terrain/heightfield.h"

namespace plumb::reference {

/// A t by which every ray of the beam has its hit; +inf where none is known, which says nothing of
/// the rays. Found by following the beam from beam_start() on: all of it is above the ground of its
/// terrain somewhere, and below everything under it at t, so that each ray crosses between.
///
/// field  without a void: a ray that crosses in one goes on
///
///   (1) caster.cast(ray).t <= the value returned, for every ray of the beam.
double beam_end(const terrain::Heightfield& field, terrain::Diagonal diagonal,
                const HeightPyramid& pyramid, const Beam& beam);

}  // namespace plumb::reference
