// plumb build --method stacks: where stacks come from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "common_options.h"
#include "options.h"
#include "progress.h"

namespace plumb::tool {

struct StackBuildOptions {
  std::vector<std::string> layers;  // "NAME=FILE", from the bottom up
  std::string voxels, voxel_grid;   // a bare file, and its "XxYxZ"
  std::string mesh, up;
  bool subtract = false;
  std::optional<double> voxel_m, margin_m, low_m;

  friend bool operator==(const StackBuildOptions&, const StackBuildOptions&) = default;
};

void add_stack_build_options(Options& options, StackBuildOptions& stacks);

/// Builds them, writes the file and reads it again; returns what is to be said of it. Throws
/// InputError.
std::string build_stacks(const TerrainOptions& terrain, const StackBuildOptions& options,
                         const std::string& output, bool json, const Invocation& invocation,
                         Progress& progress);

}  // namespace plumb::tool
