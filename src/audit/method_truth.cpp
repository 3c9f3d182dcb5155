#include "audit/method_truth.h"

namespace plumb::audit {

MethodTruth::MethodTruth(const terrain::Heightfield& field, terrain::Diagonal diagonal,
                         const MethodTable& table, const Method* method,
                         const MethodChoice& choice) {
  if (field.stacks == nullptr) {
    heights_.emplace(field, diagonal);
  } else {
    mesh_.emplace(field, full_detail_of_stacks(table, field, method, choice));
  }
}

}  // namespace plumb::audit
