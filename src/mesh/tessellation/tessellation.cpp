#include "mesh/tessellation/tessellation.h"

#include <cmath>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"
#include "mesh/tessellation/patch_joiner.h"

namespace plumb::mesh::tessellation {

using patch_quadtree::Container;

namespace {

// Without a word of the user's the coded heights are to be no part of what is measured: a few
// hundredths of a millimetre on a terrain of metres, not below what its numbers can hold.
constexpr double kErrorOfSpacing = 2e-5, kErrorOfHeight = 3e-7;

void add_claims(const Prepared& prepared, const ViewTest& view, const LevelCounts& counts,
                DrawnSurface& surface) {
  const bool is_published = prepared.parameters.variant == Variant::Published;
  const bool reached = is_published || counts.unreachable == 0;
  const double bound =
      reached ? view.tolerance.value : std::max(view.tolerance.value, counts.worst_reach);
  std::vector<Claim> claims;
  const auto claim = [&](Measure measure) {
    claims.push_back({measure, bound, view.tolerance.unit, Scope::Frame, -1, !reached});
  };
  claim(Measure::SampleError);
  if (!is_published) claim(Measure::SurfaceError);
  if (!view.in_metres()) claim(Measure::PixelError);
  surface.out_of_reach_m = counts.worst_m;
  surface.claims.insert(surface.claims.begin(), claims.begin(), claims.end());
}

void add_notes(const Prepared& prepared, const ViewTest& view, const PatchSelection& selection,
               const LevelCounts& counts, std::int64_t skirt_triangles, DrawnSurface& surface) {
  surface.notes.push_back(fmt::format(
      "{} patches resident, {} in view, {} visited, {} blocks; {} triangles of {} between patches",
      selection.drawn.size(), patches_in_view(prepared, view, selection), selection.visited,
      counts.blocks, skirt_triangles,
      prepared.parameters.variant == Variant::Published ? "skirts" : "walls"));
  if (counts.unreachable > 0)
    surface.notes.push_back(fmt::format(
        "{} blocks of the finest level miss the tolerance in full detail: heights coded within "
        "{:g} m, diagonals of blocks of {}",
        counts.unreachable, prepared.header().error_m, prepared.bounds->block_cells));
  if (prepared.parameters.variant != Variant::Published) return;
  for (std::size_t k = 0; k < kCauses; ++k) {
    const auto cause = static_cast<Cause>(k);
    if (prepared.parameters.mends[k]) {
      surface.notes.push_back(fmt::format("mended: {}", name_of(cause)));
      continue;
    }
    const bool of_patches = cause == Cause::DistanceTest || cause == Cause::BilinearError;
    const std::int64_t of = of_patches                     ? selection.tested
                            : cause == Cause::InnerMinimum ? counts.blocks
                                                           : counts.sides;
    surface.notes.push_back(fmt::format("{}: {} of {} {} would be finer", name_of(cause),
                                        counts.finer[k], of,
                                        of_patches                     ? "patches"
                                        : cause == Cause::InnerMinimum ? "blocks"
                                                                       : "sides"));
  }
}

std::int64_t bytes_resident(const PatchSelection& selection, const Prepared& prepared) {
  const auto patches = static_cast<std::int64_t>(selection.drawn.size());
  const std::int64_t side = prepared.header().layout.side(),
                     blocks = prepared.header().layout.patch_cells / prepared.pieces->block_cells();
  const std::int64_t levels = prepared.pieces->coarsest() + 1;
  // A 16-bit height a sample and a byte a bound, as the paper counts; the bounds of every patch.
  return patches * 2 * side * side +
         blocks * blocks * levels * prepared.header().layout.patch_count();
}

double least_error_m(const terrain::Heightfield& field) {
  const Box box = terrain::bounds(field);
  const double highest = box.empty() ? 0.0 : std::max(std::abs(box.low.z), std::abs(box.high.z));
  return std::max(kErrorOfSpacing * std::max(field.dx_m, field.dy_m), kErrorOfHeight * highest);
}

Prepared prepared_from(std::shared_ptr<const Container> container, Parameters parameters) {
  Prepared prepared;
  prepared.container = std::move(container);
  prepared.decoder = std::make_shared<patch_quadtree::PatchDecoder>(*prepared.container);
  prepared.bounds = std::make_shared<const Bounds>(read_bounds(*prepared.container));
  prepared.pieces = std::make_shared<const BlockPieces>(prepared.bounds->block_cells);
  prepared.foretold = std::make_shared<const ThinnedForetold>(*prepared.pieces);
  prepared.truth_pieces = std::make_shared<const BlockPieces>(kTruthBlockCells);
  prepared.geometries =
      std::make_shared<const BlockGeometries>(*prepared.pieces, prepared.header().layout);
  parameters.error_m = prepared.header().error_m;
  parameters.patch_cells = prepared.header().layout.patch_cells;
  parameters.block_cells = prepared.bounds->block_cells;
  prepared.parameters = parameters;
  return prepared;
}

}  // namespace

const char* name_of(Cause cause) {
  static constexpr std::array<const char*, kCauses> kNames{
      "edge-midpoint", "view-from-above", "not-monotone",  "mixed-factors",
      "inner-minimum", "distance-test",   "bilinear-error"};
  return kNames[static_cast<std::size_t>(cause)];
}

Prepared prepare(const terrain::Heightfield& field, const Parameters& parameters) {
  BuildOptions options;
  options.heights.error_m = parameters.error_m > 0.0 ? parameters.error_m : least_error_m(field);
  options.heights.version = static_cast<patch_quadtree::CodecVersion>(parameters.format_version);
  options.heights.patch_cells = parameters.patch_cells;
  options.block_cells = parameters.block_cells;
  return prepared_from(std::make_shared<const Container>(build(field, options)), parameters);
}

Prepared prepare(const terrain::Heightfield& field, const std::filesystem::path& file,
                 const Parameters& parameters) {
  auto container = std::make_shared<const Container>(file);
  if (container->header().terrain_checksum != terrain::checksum(field))
    input_error("'{}' was built from another terrain: {}", file.string(),
                container->header().source);
  return prepared_from(std::move(container), parameters);
}

DrawnSurface draw(const Prepared& prepared, const Camera& camera, const Tolerance& tolerance) {
  require(tolerance.unit != Unit::Count && tolerance.value >= 0.0,
          "tolerance must be >= 0 metres or pixels, got {}", tolerance.value);
  const ViewTest view{relative_to(camera, {prepared.header().origin_m, 0.0}), tolerance};
  const PatchSelection selection = select_patches(prepared, view);
  const std::vector<Grid<float>> heights_m = decode_drawn(prepared, selection);
  const ChosenLevels levels = choose_levels(prepared, view, selection, heights_m);
  std::vector<PatchMesh> drawn(selection.drawn.size());
  std::vector<Rims> rims(selection.drawn.size());
  const auto for_each_patch = [&](const auto& body) {
    parallel_for(static_cast<std::int64_t>(drawn.size()), 1,
                 [&](std::int64_t k) { body(static_cast<std::size_t>(k)); });
  };
  for_each_patch([&](std::size_t k) {
    drawn[k] = mesh_of_patch(prepared, selection.drawn[k], heights_m[k], levels.patches[k]);
  });
  const bool is_published = prepared.parameters.variant == Variant::Published;
  for_each_patch([&](std::size_t k) {
    if (is_published) {
      rims[k].skirts = skirts_of(prepared, selection, levels, k);
    } else {
      rims[k].seams = seams_of(prepared, view, selection, heights_m, levels, drawn, k);
    }
  });
  PatchJoiner joiner(prepared, selection, heights_m, levels);
  for (std::size_t k = 0; k < drawn.size(); ++k) joiner.add(k, drawn[k], rims[k]);
  DrawnSurface surface = joiner.take();
  add_claims(prepared, view, levels.counts, surface);
  add_notes(prepared, view, selection, levels.counts, joiner.rim_triangles(), surface);
  surface.cost.nodes_visited = selection.visited;
  surface.cost.bytes_resident = bytes_resident(selection, prepared);
  surface.cost.bytes_encoded = prepared.container->file_bytes();
  return surface;
}

}  // namespace plumb::mesh::tessellation
