// A terrain by its name: a file, or a generator.
#pragma once

#include <string>

#include "terrain/heightfield.h"
#include "terrain/read_options.h"

namespace plumb::terrain {

/// The terrain that an argument of the command line names.
///
/// argument  `generate:NAME?key=value&key=value`, or a file: .png and .exr are read by OpenImageIO,
///           .r16 and .r32 are bare samples, everything else is GDAL's
///
///           A terrain of stacks (`generate:caves`, or a file of stacks) is the heightfield of its
///           top surface, with `stacks` set unless options.top_surface.
/// options   decode, band, no_data, crs, origin and raw_size speak of files: with a generator they
///           are errors
/// returns   metres; row 0 is the southernmost; void samples are NaN; `provenance` says where the
///           heights come from and what was taken for granted
///
///   (1) The same file and options give the same bits, except where `crs` has GDAL reproject.
///   (2) A window of a file holds the same heights as that part of the whole file.
/// Throws InputError, one line that names the file, for everything that is wrong with it, and if it
/// does not fit into the memory that is there.
Heightfield load_terrain(const std::string& argument, const ReadOptions& options = {});

}  // namespace plumb::terrain
