// Stacks of material, as the table of methods has them.
#include "audit/method_parameters.h"
#include "audit/method_rows.h"
#include "mesh/stacks/stacks.h"
#include "terrain/stacks/stack_field.h"

namespace plumb::audit {
namespace {

constexpr terrain::Diagonal kTruthOfHeights = terrain::Diagonal::Alternating;

mesh::stacks::Parameters stacks_parameters(const MethodChoice& choice) {
  using mesh::dual_contouring::Kernel;
  using mesh::dual_contouring::Placement;
  mesh::stacks::Parameters parameters;
  parameters.variant = choice.variant == "published" ? mesh::stacks::Variant::Published
                                                     : mesh::stacks::Variant::Conservative;
  parameters.placement = word_parameter<Placement>(
      choice, "placement",
      {{"mean", Placement::Mean}, {"qef", Placement::Qef}, {"particle", Placement::Particle}});
  parameters.filter.kernel =
      word_parameter<Kernel>(choice, "filter", {{"gauss", Kernel::Gauss}, {"box", Kernel::Box}});
  parameters.filter.radius = integer_parameter(choice, "radius", parameters.filter.radius);
  if (parameters.filter.radius > 4)
    input_error("parameter radius: expected 0 to 4 voxels, got {}", parameters.filter.radius);
  return parameters;
}

// Frames of a path share a tree where there is a budget.
class PreparedStacks final : public PreparedMethod {
 public:
  PreparedStacks(mesh::stacks::Prepared prepared, int budget)
      : prepared_(std::move(prepared)), budget_(budget) {}

  DrawnSurface draw(const Camera& camera, const Tolerance& tolerance) const override {
    return mesh::stacks::draw(prepared_, camera, tolerance);
  }
  std::unique_ptr<MethodRun> start() const override {
    return std::make_unique<Flight>(mesh::stacks::Run(prepared_, budget_));
  }

 private:
  class Flight final : public MethodRun {
   public:
    explicit Flight(mesh::stacks::Run run) : run_(std::move(run)) {}
    DrawnSurface step(const Camera& camera, const Tolerance& tolerance) override {
      return run_.step(camera, tolerance);
    }

   private:
    mesh::stacks::Run run_;
  };

  mesh::stacks::Prepared prepared_;
  int budget_;
};

}  // namespace

Method stacks_row() {
  Method method;
  method.name = "stacks";
  method.summary = "stacks of material, their surface by dual contouring over an octree";
  method.variants = {"conservative", "published"};
  method.tolerance_units = {Unit::Pixel};
  method.truth = kTruthOfHeights;
  method.takes_stacks = true;
  method.size_variants = {"published"};
  method.parameters = {
      {"placement", "of vertices: mean, qef or particle (mean)"},
      {"filter", "that smoothes the densities: gauss or box (gauss)"},
      {"radius", "of the filter, voxels, 0 to 4 (1)"},
      {"budget",
       "node meshes that a frame of a path may make, as the paper's 40, but one change at least; "
       "0: all (0)"},
      {"voxel", "height of a voxel of a terrain of heights, metres (the mean spacing)"}};
  method.prepare = [](const terrain::Heightfield& field, const MethodChoice& choice) {
    if (field.stacks != nullptr && choice.parameters.contains("voxel"))
      input_error("parameter voxel: a terrain of stacks has its own, {} m", field.stacks->voxel_m);
    const double voxel_m = number_parameter(choice, "voxel", 0.0);
    const mesh::stacks::Parameters parameters = stacks_parameters(choice);
    const int budget = integer_parameter(choice, "budget", 0);
    if (field.stacks != nullptr)
      return std::make_unique<PreparedStacks>(mesh::stacks::prepare(*field.stacks, parameters),
                                              budget);
    return std::make_unique<PreparedStacks>(
        mesh::stacks::prepare(
            terrain::stacks_of(field, voxel_m), parameters,
            std::make_shared<const mesh::stacks::HeightSurface>(field, kTruthOfHeights)),
        budget);
  };
  method.full_detail = [](const terrain::Heightfield& field, const MethodChoice& choice) {
    mesh::stacks::Parameters parameters = stacks_parameters(choice);
    parameters.variant = mesh::stacks::Variant::Conservative;
    DrawnSurface finest = mesh::stacks::finest(mesh::stacks::prepare(*field.stacks, parameters));
    finest.patches.clear();  // one piece of one level
    finest.triangle_lod.clear();
    return finest;
  };
  return method;
}

}  // namespace plumb::audit
