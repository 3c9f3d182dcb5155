#include "slicing/slicing_method.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "core/check.h"

namespace plumb::slicing {
namespace {

const char* name_of(Axis axis) { return axis == Axis::X ? "x" : axis == Axis::Y ? "y" : "z"; }

// The used nodes of a cut, as patches and as the numbers that a picture names them by.
class UsedNodes {
 public:
  UsedNodes(const SlicingTree& tree, const SlicingCut& cut) : tree_(tree) {
    patch_of_node_.assign(tree.count(), kNoPrimitive);
    for (const SliceBundle& bundle : cut.bundles) {
      add(bundle.node, fmt::format("{} slices across {}", bundle.count, name_of(bundle.axis)),
          1 + index_of(bundle.axis));
    }
    for (const std::uint32_t index : cut.polygons) add(index, "polygons", 0);
  }

  std::vector<Patch> patches;
  std::vector<std::uint8_t> levels;  // of each
  std::vector<std::uint32_t> take_patch_of_node() { return std::move(patch_of_node_); }

 private:
  void add(std::uint32_t index, const std::string& what, int kind) {
    const SlicingNode& node = tree_.node(index);
    const auto number = static_cast<std::uint32_t>(patches.size());
    const int lod = tree_.levels() - 1 - tree_.level_of(index);
    patch_of_node_[index] = number;
    patches.push_back(
        {number, 1, lod,
         fmt::format("samples {}..{} x {}..{}, {}", node.i0, node.i1, node.j0, node.j1, what),
         kind});
    levels.push_back(static_cast<std::uint8_t>(lod));
  }

  const SlicingTree& tree_;
  std::vector<std::uint32_t> patch_of_node_;
};

Claim claim_of(const Parameters& parameters, double tolerance_px) {
  Claim claim{Measure::PixelError, tolerance_px, Unit::Pixel};
  if (parameters.cut.variant == Variant::Conservative &&
      parameters.heights != Interpolation::Triangulated) {
    claim.bound = std::numeric_limits<double>::infinity();
    claim.unreachable = true;
  }
  return claim;
}

Cost cost_of(const SlicingTree& tree, const SlicingCut& cut, const NodeMesh& polygons) {
  Cost cost;
  cost.slices = cut.slices;
  cost.triangles = static_cast<std::int64_t>(polygons.mesh.triangles.size());
  cost.vertices = 4 * cut.slices + static_cast<std::int64_t>(polygons.mesh.vertices_m.size());
  cost.nodes_visited = cut.nodes_visited;
  cost.bytes_resident = static_cast<std::int64_t>(tree.field().heights_m.size() * sizeof(float) +
                                                  tree.count() * sizeof(SlicingNode));
  return cost;
}

Layers blended(const Prepared& prepared, const SlicingCut& cut, const Camera& eye,
               const HitImage& hits) {
  const terrain::Heightfield& field = prepared.tree->field();
  BlendOptions options = prepared.parameters.blend;
  const Box box = terrain::bounds(field);
  if (!box.empty()) options.fog_base_m = box.low.z;
  return blend_slices(cut, relative_to(eye, field.world_origin_m()), *prepared.heights, hits,
                      options);
}

}  // namespace

Prepared prepare(const terrain::Heightfield& field, terrain::Diagonal diagonal,
                 const Parameters& parameters) {
  return {parameters, std::make_shared<const SlicingTree>(field, diagonal, parameters.leaf_cells),
          std::make_shared<const HeightLookup>(field, diagonal, parameters.heights)};
}

DrawnSurface draw(const Prepared& prepared, const Camera& camera, const Tolerance& tolerance) {
  const Parameters& parameters = prepared.parameters;
  if (tolerance.unit != Unit::Pixel || !(tolerance.value > 0.0))
    input_error("slicing needs a tolerance in pixels above zero, got {}", to_text(tolerance));
  const SlicingTree& tree = *prepared.tree;
  const Camera local = relative_to(camera, tree.field().world_origin_m());
  CutOptions options = parameters.cut;
  options.tolerance_px = tolerance.value;
  const auto cut = std::make_shared<const SlicingCut>(parameters.choice == CutChoice::Optimum
                                                          ? optimal_cut(tree, local, options)
                                                          : cut_tree(tree, local, options));
  const auto polygons = std::make_shared<const NodeMesh>(mesh_of_nodes(tree, cut->polygons));
  UsedNodes used(tree, *cut);
  DrawnSurface surface;
  surface.patches = std::move(used.patches);
  surface.triangle_lod = std::move(used.levels);
  surface.kinds = {"polygons", "slices across x", "slices across y", "slices across z"};
  surface.claims = {claim_of(parameters, tolerance.value)};
  surface.cost = cost_of(tree, *cut, *polygons);
  if (surface.claims[0].unreachable)
    surface.notes.push_back(
        "The bound holds for heights that are looked up triangulated; with others nothing is "
        "claimed.");
  surface.notes.push_back(fmt::format(
      "{} bundles of {} slices and {} nodes of polygons, {:.4g} s by the profile {} ({:.4g} "
      "vertices/s, {:.4g} pixels/s).",
      cut->bundles.size(), cut->slices, cut->polygons.size(), cut->cost_s, options.profile.name,
      options.profile.vertices_per_s, options.profile.pixels_per_s));
  surface.painter = [prepared, cut, polygons,
                     patch = used.take_patch_of_node()](const Camera& eye) {
    HybridFrame frame = draw_frame(*prepared.tree, *cut, *polygons, eye, *prepared.heights,
                                   prepared.parameters.renderer);
    for (std::uint32_t& primitive : frame.image.primitive) {
      if (primitive != kNoPrimitive) primitive = patch[primitive];
    }
    SurfacePicture picture{std::move(frame.image), frame.slice_fragments + frame.polygon_fragments};
    if (prepared.parameters.blend.blends())
      picture.layers = blended(prepared, *cut, eye, picture.image);
    return picture;
  };
  return surface;
}

}  // namespace plumb::slicing
