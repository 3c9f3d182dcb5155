#include "audit_truth.h"

#include <fmt/format.h>

#include "audit/method.h"
#include "core/check.h"

namespace plumb::tool {

std::vector<std::string> assumptions(const audit::TruthTerms& truth, const MethodRequest& request,
                                     bool of_stranger) {
  if (truth.mesh() != nullptr)
    return {fmt::format(
        "the truth is the stacks' finest level as a mesh, by the filter and the "
        "placement {}",
        of_stranger ? "that method stacks has if none is named" : "of the method itself")};
  const terrain::Diagonal diagonal = truth.heights()->diagonal();
  if (of_stranger || diagonal == request.method->truth) return {};
  return {fmt::format(
      "the claims of {} are judged on a surface whose diagonals are {}; what it approximates has "
      "{} ones",
      request.method->name, terrain::name_of(diagonal), terrain::name_of(request.method->truth))};
}

void require_fitting(const TerrainOptions& terrain, const StrangerOptions& stranger,
                     const MethodRequest& request, const terrain::Heightfield& field) {
  if (field.stacks == nullptr) return;
  if (!stranger.is_given()) audit::require_drawable(*request.method, field);
  const std::string& source = field.provenance.source;
  if (stranger.is_depth())
    input_error(
        "--depth: {} is a terrain of stacks, of which depth buffers are not audited yet (a mesh "
        "is, with --mesh)",
        source);
  if (!terrain.diagonal.empty())
    input_error("--diagonal: {} is a terrain of stacks, which has no cells with diagonals", source);
}

}  // namespace plumb::tool
