// The parts that a case is drawn from.
#pragma once

#include <string>

#include "audit/soundness/case.h"
#include "audit/soundness/random_numbers.h"
#include "terrain/heightfield.h"

namespace plumb::audit::soundness {

/// Rounded to so many digits, so that a command reads well.
double rounded(double value, int digits);

/// A generator with its parameters and how it is read. Fills the scene's terrain and its traits.
void draw_terrain(RandomNumbers& random, bool of_stacks, Scene& scene, Traits& traits);

/// A camera for the terrain, and its traits.
void draw_camera(RandomNumbers& random, const terrain::Heightfield& field, Scene& scene,
                 Traits& traits);

/// The method's variant, parameters and tolerance.
void draw_choice(RandomNumbers& random, const Method& method, const terrain::Heightfield& field,
                 Scene& scene);

}  // namespace plumb::audit::soundness
