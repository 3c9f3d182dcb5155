// The truth that what a method draws is held against.
#pragma once

#include <optional>

#include "audit/mesh_truth.h"
#include "audit/method.h"
#include "audit/truth.h"
#include "audit/truth_terms.h"
#include "terrain/heightfield.h"

namespace plumb::audit {

/// The full-detail surface of a terrain: a heightfield's, or, where it is one of stacks, their
/// finest level as a mesh by the method's own parameters. Keeps a reference to the terrain.
class MethodTruth {
 public:
  /// diagonal  of a heightfield's cells
  /// method    may be null, see full_detail_of_stacks()
  /// Throws InputError for parameters that the method does not have.
  MethodTruth(const terrain::Heightfield& field, terrain::Diagonal diagonal,
              const MethodTable& table, const Method* method, const MethodChoice& choice);
  MethodTruth(terrain::Heightfield&&, terrain::Diagonal, const MethodTable&, const Method*,
              const MethodChoice&) = delete;

  TruthTerms terms() const { return mesh_ ? TruthTerms(*mesh_) : TruthTerms(*heights_); }

 private:
  std::optional<HeightfieldTruth> heights_;
  std::optional<MeshTruth> mesh_;
};

}  // namespace plumb::audit
