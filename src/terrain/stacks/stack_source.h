// Terrains of stacks by their name.
#pragma once

#include <string>

#include "terrain/generator_parameters.h"
#include "terrain/stacks/stack_field.h"

namespace plumb::terrain {

/// True if `argument` names a generator whose terrain is one of stacks ("generate:caves?..."), and
/// does not ask for its top surface alone. False for what is no generator, known or not.
bool is_stack_generator(const std::string& argument);

/// The stacks of `generate:caves?key=value&key=value`: terrain/stacks/caves.h. Voids are holes.
///
///   (1) provenance.source names every parameter with its value, and gives the same stacks again.
///   (2) The same bits on any number of threads.
/// Throws InputError for what generate() of terrain/generators.h refuses, for surface=top and for a
/// generator of heights.
StackField generate_stacks(const std::string& argument);

/// The same of values that are parsed, whatever `surface` says.
StackField make_stacks(const GeneratorValues& values);

/// What a stack is taken to need before it is made: more than the default terrain's do.
inline constexpr int kBytesAStack = 64;

}  // namespace plumb::terrain
