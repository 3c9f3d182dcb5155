// What plumb audit holds a surface against.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "audit/mesh_truth.h"
#include "audit/truth.h"
#include "audit/truth_terms.h"
#include "common_options.h"
#include "method_options.h"
#include "stranger.h"
#include "terrain/heightfield.h"

namespace plumb::tool {

/// The full-detail surface of a terrain: a heightfield's, or, where it is one of stacks, their
/// finest level as a mesh by the method's own parameters. Keeps a reference to the terrain.
class AuditTruth {
 public:
  /// diagonal  of a heightfield's cells
  /// Throws InputError for parameters that the method does not have.
  AuditTruth(const terrain::Heightfield& field, terrain::Diagonal diagonal,
             const MethodRequest& request);

  audit::TruthTerms terms() const;
  /// What a report should say about it, one sentence each.
  std::vector<std::string> assumptions(const MethodRequest& request, bool of_stranger) const;

 private:
  std::optional<audit::HeightfieldTruth> heights_;
  std::optional<audit::MeshTruth> mesh_;
};

/// Throws InputError for what is not audited against a terrain of stacks: methods that draw
/// heights, depth buffers, and diagonals, which stacks do not have.
void require_fitting(const TerrainOptions& terrain, const StrangerOptions& stranger,
                     const MethodRequest& request, const terrain::Heightfield& field);

}  // namespace plumb::tool
