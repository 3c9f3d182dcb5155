// Every run of a sweep, with all that decides its result.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "audit/method.h"
#include "audit/sweep/scene.h"
#include "core/camera.h"
#include "core/claim.h"
#include "terrain/heightfield.h"

namespace plumb::audit::sweep {

/// A camera of a sweep over one terrain.
struct PlacedView {
  std::size_t camera = 0;  // of the scene
  int frame = 0;           // of a path, from 1; else 0
  Camera placed;
};

struct PlacedTerrain {
  std::shared_ptr<const terrain::Heightfield> field;
  std::string source;    // gives the terrain again, in the scene's folder
  std::string checksum;  // of what was read
  std::vector<PlacedView> views;
};

/// Runs that share what a method makes of a terrain.
struct RunGroup {
  std::size_t terrain = 0;  // of the plan
  const Method* method = nullptr;
  MethodChoice choice;                                          // with a variant
  terrain::Diagonal diagonal = terrain::Diagonal::Alternating;  // of the truth
  std::string skipped;  // why it cannot be run; empty: it can
};

struct PlannedRun {
  std::size_t group = 0;
  std::size_t view = 0;  // of the group's terrain
  Tolerance tolerance;
  std::string asked;    // the JSON object that decides the result
  std::string key;      // of `asked`
  std::string skipped;  // why it is not run; empty: it is
};

struct SweepPlan {
  SweepScene scene;
  std::vector<PlacedTerrain> terrains;  // as in the scene
  std::vector<RunGroup> groups;
  std::vector<PlannedRun> runs;  // in the scene's order: terrain, method, parameters, variant,
                                 // tolerance, camera, frame
};

/// Sixteen hexadecimal digits: FNV-1a (64 bits) of the bytes.
std::string key_of(const std::string& asked);

/// Reads every terrain, places every camera and lists the runs.
///
/// Throws InputError for a terrain that cannot be read, a camera that is none over one of the
/// terrains or whose picture does not fit into memory, and for two runs that ask for the same.
SweepPlan plan_sweep(SweepScene scene, const MethodTable& table,
                     const std::string& program_version);

/// A `plumb audit` that makes the run again where the scene lies.
std::string command_of(const SweepPlan& plan, const PlannedRun& run);

/// "alpine, tessellation, published, 1px, oblique": the run for people.
std::string name_of(const SweepPlan& plan, const PlannedRun& run);

/// Indices of the runs that are part `part` of `parts`, in order; 1 <= part <= parts.
///
///   (1) Parts differ by at most one run; each run is in one of them.
///   (2) Runs that differ in one thing alone fall into different parts, as far as there are parts.
std::vector<std::size_t> shard_of(const SweepPlan& plan, int part, int parts);

}  // namespace plumb::audit::sweep
