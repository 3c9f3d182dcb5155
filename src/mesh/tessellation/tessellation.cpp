#include "mesh/tessellation/tessellation.h"

#include <cmath>
#include <unordered_map>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"
#include "mesh/tessellation/patch_mesh.h"
#include "mesh/tessellation/seams.h"
#include "mesh/tessellation/skirts.h"

namespace plumb::mesh::tessellation {

using patch_quadtree::Container;
using patch_quadtree::PatchPlace;

namespace {

// Without a word of the user's the coded heights are to be no part of what is measured: a few
// hundredths of a millimetre on a terrain of metres, not below what its numbers can hold.
constexpr double kErrorOfSpacing = 2e-5, kErrorOfHeight = 3e-7;

// What closes a patch's rims: walls of the conservative variant, or the paper's skirts.
struct Rims {
  std::vector<SeamTriangle> seams;
  std::vector<Skirt> skirts;
};

// Puts patches together: vertices at one place are one vertex, where patches drew them alike.
class Joiner {
 public:
  Joiner(const Prepared& prepared, const PatchSelection& selection,
         const std::vector<Grid<float>>& heights_m, const ChosenLevels& levels)
      : prepared_(prepared), selection_(selection), heights_m_(heights_m), levels_(levels) {
    const auto& header = prepared.header();
    mesh_->origin_m = {header.origin_m, 0.0};
    surface_.kinds = {"ground", "skirts"};
  }

  void add(std::size_t at, const PatchMesh& drawn, const Rims& rims) {
    const PatchPlace& place = selection_.drawn[at];
    const int n = prepared_.header().layout.patch_cells;
    std::vector<std::uint32_t> number;
    number.reserve(drawn.points.size());
    for (const PatchPoint& point : drawn.points) {
      const bool on_rim = point.i == 0 || point.j == 0 || point.i == n || point.j == n;
      number.push_back(on_rim ? rim_vertex(at, point) : new_vertex(position(at, point)));
    }
    begin_patch(place, "", 0);
    for (std::size_t k = 0; k < drawn.triangles.size(); ++k) {
      const Triangle& t = drawn.triangles[k];
      mesh_->triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
      surface_.triangle_lod.push_back(static_cast<std::uint8_t>(place.level + drawn.thinned[k]));
    }
    if (end_patch()) claim_patch(at);
    begin_patch(place, "skirts of ", 1);
    for (const SeamTriangle& seam : rims.seams) wall(place.level, seam);
    for (const Skirt& skirt : rims.skirts) hang(at, skirt);
    end_patch();
  }

  DrawnSurface take() {
    surface_.cost.vertices = static_cast<std::int64_t>(mesh_->vertices_m.size());
    surface_.cost.triangles = static_cast<std::int64_t>(mesh_->triangles.size());
    surface_.mesh = std::move(mesh_);
    return std::move(surface_);
  }
  std::int64_t skirt_triangles() const { return skirt_triangles_; }

 private:
  struct RimVertex {
    float height_m;
    std::uint32_t number;
  };

  glm::dvec3 position(std::size_t at, const PatchPoint& point) const {
    const auto& header = prepared_.header();
    const PatchPlace& place = selection_.drawn[at];
    return {header.layout.sample_column(place, point.i) * header.dx_m,
            header.layout.sample_row(place, point.j) * header.dy_m,
            double{heights_m_[at](point.i + 1, point.j + 1)}};
  }
  std::uint32_t new_vertex(const glm::dvec3& place) {
    mesh_->vertices_m.push_back(place);
    return static_cast<std::uint32_t>(mesh_->vertices_m.size() - 1);
  }
  std::uint32_t rim_vertex(std::size_t at, const PatchPoint& point) {
    const auto& layout = prepared_.header().layout;
    const PatchPlace& place = selection_.drawn[at];
    const std::int64_t key = std::int64_t{layout.sample_row(place, point.j)} * layout.columns +
                             layout.sample_column(place, point.i);
    const float height_m = heights_m_[at](point.i + 1, point.j + 1);
    std::vector<RimVertex>& here = rim_[key];
    for (const RimVertex& vertex : here)
      if (vertex.height_m == height_m) return vertex.number;
    here.push_back({height_m, new_vertex(position(at, point))});
    return here.back().number;
  }

  void wall(int level, const SeamTriangle& seam) {
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k)
      triangle[k] = seam[k].drawn >= 0
                        ? rim_vertex(static_cast<std::size_t>(seam[k].drawn), seam[k].point)
                        : new_vertex(seam[k].place_m);
    mesh_->triangles.push_back(triangle);
    surface_.triangle_lod.push_back(static_cast<std::uint8_t>(level));
    ++skirt_triangles_;
  }

  // Two triangles for each piece of the top; none where there is no height, or beyond the terrain.
  void hang(std::size_t at, const Skirt& skirt) {
    if (skirt.depth_m == 0.0) return;
    for (std::size_t k = 0; k + 1 < skirt.top.size(); ++k) {
      const glm::dvec3 a = position(at, skirt.top[k]), b = position(at, skirt.top[k + 1]);
      if (std::isnan(a.z) || std::isnan(b.z) || (a.x == b.x && a.y == b.y)) continue;
      const glm::dvec3 down{0.0, 0.0, skirt.depth_m};
      const std::uint32_t top_a = rim_vertex(at, skirt.top[k]),
                          top_b = rim_vertex(at, skirt.top[k + 1]);
      const std::uint32_t low_a = new_vertex(a - down), low_b = new_vertex(b - down);
      mesh_->triangles.push_back({low_a, low_b, top_b});
      mesh_->triangles.push_back({low_a, top_b, top_a});
      const auto lod = static_cast<std::uint8_t>(selection_.drawn[at].level);
      surface_.triangle_lod.insert(surface_.triangle_lod.end(), 2, lod);
      skirt_triangles_ += 2;
    }
  }

  void begin_patch(const PatchPlace& place, const char* what, int kind) {
    Patch patch;
    patch.first_triangle = static_cast<std::uint32_t>(mesh_->triangles.size());
    patch.lod = place.level;
    patch.name = fmt::format("{}patch ({}, {}) of level {}", what, place.px, place.py, place.level);
    patch.kind = kind;
    surface_.patches.push_back(std::move(patch));
  }
  // False if there is nothing in it: then it is no patch.
  bool end_patch() {
    Patch& patch = surface_.patches.back();
    patch.triangle_count =
        static_cast<std::uint32_t>(mesh_->triangles.size()) - patch.first_triangle;
    if (patch.triangle_count > 0) return true;
    surface_.patches.pop_back();
    return false;
  }
  void claim_patch(std::size_t at) {
    double bound_m = 0.0;
    for (const double bound : levels_.patches[at].bound_m.values())
      bound_m = std::max(bound_m, bound);
    surface_.claims.push_back({Measure::SampleError, bound_m, Unit::Metre, Scope::Patch,
                               static_cast<int>(surface_.patches.size()) - 1});
  }

  const Prepared& prepared_;
  const PatchSelection& selection_;
  const std::vector<Grid<float>>& heights_m_;
  const ChosenLevels& levels_;
  std::shared_ptr<TriangleMesh> mesh_ = std::make_shared<TriangleMesh>();
  DrawnSurface surface_;
  std::unordered_map<std::int64_t, std::vector<RimVertex>> rim_;  // looked up, never walked
  std::int64_t skirt_triangles_ = 0;
};

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

void add_notes(const Prepared& prepared, const PatchSelection& selection, const LevelCounts& counts,
               std::int64_t skirt_triangles, DrawnSurface& surface) {
  surface.notes.push_back(
      fmt::format("{} patches drawn, {} visited, {} blocks; {} triangles of {} between patches",
                  selection.drawn.size(), selection.visited, counts.blocks, skirt_triangles,
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
  Joiner joiner(prepared, selection, heights_m, levels);
  for (std::size_t k = 0; k < drawn.size(); ++k) joiner.add(k, drawn[k], rims[k]);
  DrawnSurface surface = joiner.take();
  add_claims(prepared, view, levels.counts, surface);
  add_notes(prepared, selection, levels.counts, joiner.skirt_triangles(), surface);
  surface.cost.nodes_visited = selection.visited;
  surface.cost.bytes_resident = bytes_resident(selection, prepared);
  surface.cost.bytes_encoded = prepared.container->file_bytes();
  return surface;
}

}  // namespace plumb::mesh::tessellation
