// What the audit knows of a method: a name, and two functions.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/camera.h"
#include "core/drawn_surface.h"
#include "terrain/heightfield.h"

namespace plumb::audit {

/// A method that is shown frame after frame.
class MethodRun {
 public:
  virtual ~MethodRun() = default;
  virtual DrawnSurface step(const Camera& camera, const Tolerance& tolerance) = 0;
};

/// Everything that a method made of a terrain before it knew a camera.
class PreparedMethod {
 public:
  virtual ~PreparedMethod() = default;
  virtual DrawnSurface draw(const Camera& camera, const Tolerance& tolerance) const = 0;
  /// A method without a memory of frames draws each for itself. Does not outlive *this.
  virtual std::unique_ptr<MethodRun> start() const;
};

/// What a user sets of a method: its variant and parameters by name; the method checks them.
struct MethodChoice {
  std::string variant;                            // empty: the method's first
  std::map<std::string, std::string> parameters;  // unknown names are errors
};

struct Method {
  std::string name;                   // with hyphens, as on the command line
  std::string summary;                // one line
  std::vector<std::string> variants;  // the default first; one for a method with a single variant
  std::vector<Unit> tolerance_units;  // in which it can promise
  terrain::Diagonal truth =
      terrain::Diagonal::Alternating;  // the full-detail surface that it approximates
  std::vector<std::pair<std::string, std::string>> parameters;  // names and what they mean
  std::function<std::unique_ptr<PreparedMethod>(const terrain::Heightfield&, const MethodChoice&)>
      prepare;
  /// If set: what a parameter of the user's stands for, so that a result that names it can be made
  /// again where a file that it came from is gone.
  std::function<MethodChoice(MethodChoice)> resolve = {};
  /// Variants whose tolerance is a size on the screen, and no error: silhouettes must not move by
  /// it.
  std::vector<std::string> size_variants = {};
  bool takes_stacks = false;  // it draws terrains of stacks too, not heights alone
  /// If set: the full-detail mesh of a terrain of stacks by the same parameters, whatever the
  /// variant: the truth that its drawings are held against.
  std::function<DrawnSurface(const terrain::Heightfield&, const MethodChoice&)> full_detail = {};
};

using MethodTable = std::vector<Method>;

/// Wraps prepare's result and a draw function as a PreparedMethod.
template <class Prepared, class Draw>
std::unique_ptr<PreparedMethod> adapt(Prepared prepared, Draw draw) {
  class Adapter final : public PreparedMethod {
   public:
    Adapter(Prepared p, Draw d) : prepared_(std::move(p)), draw_(std::move(d)) {}
    DrawnSurface draw(const Camera& camera, const Tolerance& tolerance) const override {
      return draw_(prepared_, camera, tolerance);
    }

   private:
    Prepared prepared_;
    Draw draw_;
  };
  return std::make_unique<Adapter>(std::move(prepared), std::move(draw));
}

/// The methods that come with plumb.
const MethodTable& built_in_methods();

/// Throws InputError naming the known ones.
const Method& find_method(const MethodTable& table, const std::string& name);

/// The choice with the method's first variant where none is named, and parameters that stand for
/// themselves. Throws InputError for a variant or a parameter that the method does not have.
MethodChoice resolved_choice(const Method& method, MethodChoice choice);

/// Prepares a method after checking the choice against its row: throws InputError for a variant, a
/// parameter or a unit of tolerance that it does not have.
std::unique_ptr<PreparedMethod> prepare_method(const Method& method,
                                               const terrain::Heightfield& field,
                                               const MethodChoice& choice,
                                               const Tolerance& tolerance);

/// Throws InputError if the terrain is one of stacks and the method draws heights alone.
void require_drawable(const Method& method, const terrain::Heightfield& field);

/// The full-detail mesh of a terrain of stacks: by `method`'s parameters if it draws stacks, else
/// (or if it is null) by the defaults of the table's first method that does. Throws InputError for
/// parameters that the method does not have.
DrawnSurface full_detail_of_stacks(const MethodTable& table, const terrain::Heightfield& field,
                                   const Method* method = nullptr, const MethodChoice& choice = {});

}  // namespace plumb::audit
