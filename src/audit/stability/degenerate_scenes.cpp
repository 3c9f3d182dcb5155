#include "audit/stability/grounds.h"
#include "audit/stability/scene_lists.h"

namespace plumb::audit::stability {
std::vector<Scene> degenerate_scenes() { return {}; }
}  // namespace plumb::audit::stability
