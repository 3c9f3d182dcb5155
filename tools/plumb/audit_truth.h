// What plumb audit holds a surface against.
#pragma once

#include <string>
#include <vector>

#include "audit/truth_terms.h"
#include "common_options.h"
#include "method_options.h"
#include "stranger.h"
#include "terrain/heightfield.h"

namespace plumb::tool {

/// What a report should say about the truth, one sentence each.
std::vector<std::string> assumptions(const audit::TruthTerms& truth, const MethodRequest& request,
                                     bool of_stranger);

/// Throws InputError for what is not audited against a terrain of stacks: methods that draw
/// heights, depth buffers, and diagonals, which stacks do not have.
void require_fitting(const TerrainOptions& terrain, const StrangerOptions& stranger,
                     const MethodRequest& request, const terrain::Heightfield& field);

}  // namespace plumb::tool
