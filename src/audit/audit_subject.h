// What was audited: everything that a result must say so that it can be made again.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/claim.h"
#include "terrain/heightfield.h"

namespace plumb::audit {

struct AuditSubject {
  const terrain::Heightfield* field = nullptr;
  terrain::Diagonal truth = terrain::Diagonal::Alternating;
  std::string method;   // or "mesh" for a stranger's
  std::string variant;  // empty where there is none
  std::map<std::string, std::string> parameters;
  Tolerance tolerance;
  Camera camera;  // world coordinates
  std::string camera_name;
  std::string command;                        // the command line that makes the result again
  std::vector<std::string> assumptions = {};  // taken for granted, one sentence each
  std::vector<std::string> hints = {};        // what to look at first if the result surprises
  std::vector<std::string> notes = {};        // what the method says of the frame
};

}  // namespace plumb::audit
