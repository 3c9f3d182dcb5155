// What judging needs to know of a truth, of whichever kind it is.
#pragma once

#include "audit/mesh_truth.h"
#include "audit/truth.h"
#include "terrain/heightfield.h"

namespace plumb::audit {

/// Keeps references to what it is made of.
class TruthTerms {
 public:
  TruthTerms(const HeightfieldTruth& truth)
      : field_(&truth.field()), slack_m_(truth.slack_m), heights_(&truth) {}
  TruthTerms(const MeshTruth& truth)
      : field_(&truth.field()), slack_m_(truth.slack_m()), mesh_(&truth) {}

  /// Whose origin places are relative to.
  const terrain::Heightfield& field() const { return *field_; }
  /// How far off its surface rounding may have put it, metres.
  double slack_m() const { return slack_m_; }
  /// One of these two; the other is null.
  const HeightfieldTruth* heights() const { return heights_; }
  const MeshTruth* mesh() const { return mesh_; }

 private:
  const terrain::Heightfield* field_;
  double slack_m_;
  const HeightfieldTruth* heights_ = nullptr;
  const MeshTruth* mesh_ = nullptr;
};

}  // namespace plumb::audit
