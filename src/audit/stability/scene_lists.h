// The parts of the table of scenes, one file each.
#pragma once

#include <vector>

#include "audit/stability/failure_scene.h"

namespace plumb::audit::stability {

std::vector<Scene> slicing_scenes();
std::vector<Scene> tessellation_scenes();
std::vector<Scene> quadtree_scenes();
std::vector<Scene> stack_scenes();
std::vector<Scene> degenerate_scenes();

}  // namespace plumb::audit::stability
