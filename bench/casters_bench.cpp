// Rays a second of both casters, beside Embree itself on the same triangles in the same run.
#include <array>
#include <vector>

#include "bare_embree.h"
#include "bench_support.h"
#include "core/instruction_set.h"
#include "reference/box_tree.h"
#include "reference/embree_caster.h"
#include "reference/height_blocks.h"
#include "reference/pyramid_caster.h"

namespace plumb::bench {
namespace {

constexpr double kRays = 1920.0 * 1080.0;

const reference::PyramidCaster& pyramid() {
  static const reference::PyramidCaster caster(bench_terrain(), terrain::Diagonal::Alternating);
  return caster;
}

const reference::EmbreeCaster& embree_caster() {
  static const reference::EmbreeCaster caster(bench_terrain(), terrain::Diagonal::Alternating);
  return caster;
}

void pyramid_build(benchmark::State& state) {
  bench_terrain();
  measure(state, [&] {
    const reference::PyramidCaster caster(bench_terrain(), terrain::Diagonal::Alternating);
    benchmark::DoNotOptimize(caster.pyramid().root());
  });
  state.counters["bytes_per_triangle"] = (static_cast<double>(pyramid().bytes()) +
                                          static_cast<double>(bench_terrain().heights_m.bytes())) /
                                         triangles_of(bench_terrain());
}

void pyramid_frame(benchmark::State& state, const char* preset, InstructionSet set) {
  const Camera camera = bench_camera(preset);
  const ForcedInstructionSet forced(set);
  pyramid();
  measure(state, [&] { benchmark::DoNotOptimize(pyramid().cast_frame(camera).depth_m.data()); });
  set_rate(state, "Mrays/s", kRays);
}

void embree_caster_frame(benchmark::State& state, const char* preset) {
  const Camera camera = bench_camera(preset);
  reference::CastStatistics statistics;
  embree_caster();
  measure(state, [&] {
    benchmark::DoNotOptimize(embree_caster().cast_frame(camera, &statistics).depth_m.data());
  });
  set_rate(state, "Mrays/s", kRays);
  state.counters["proposals_per_ray"] = static_cast<double>(statistics.proposals) / kRays;
}

// Embree's part of the caster's work alone: its tree of blocks proposes as it does for the caster,
// and what double arithmetic found is looked up instead of computed.
class Replay final : public reference::RayVisitor {
 public:
  Replay(const HitImage& hits, int cells_across) : hits_(hits), blocks_(hits.size()) {
    constexpr std::uint32_t kSide = reference::HeightBlocks::kSide;
    const auto across = static_cast<std::uint32_t>(cells_across);
    for (std::size_t pixel = 0; pixel < hits.size(); ++pixel) {
      const std::uint32_t cell = hits.primitive[pixel] / 2;
      const std::uint32_t i = cell % across / kSide, j = cell / across / kSide;
      blocks_[pixel] = hits.hit(pixel) ? j * ((across + kSide - 1) / kSide) + i : kNoPrimitive;
    }
  }
  void at(std::size_t pixel, int number) { pixels_[static_cast<std::size_t>(number)] = pixel; }
  double visit(std::uint32_t block, int number) override {
    const std::size_t pixel = pixels_[static_cast<std::size_t>(number)];
    return block == blocks_[pixel] ? hits_.depth_m[pixel] : kNoHit;
  }

 private:
  const HitImage& hits_;
  std::vector<std::uint32_t> blocks_;  // in which a pixel's hit lies
  std::array<std::size_t, reference::BoxTree::kPacket> pixels_{};
};

// Needs a terrain without voids, whose blocks are numbered row by row.
void embree_proposals(benchmark::State& state, const char* preset) {
  const Camera camera = bench_camera(preset);
  const terrain::Heightfield& field = bench_terrain();
  const reference::HeightBlocks blocks(field, terrain::Diagonal::Alternating);
  const reference::BoxTree tree(blocks.count(), [&](std::uint32_t k) { return blocks.box(k); });
  const HitImage hits = pyramid().cast_frame(camera);
  Replay replay(hits, field.cell_columns());
  std::array<reference::Ray, reference::BoxTree::kPacket> rays;
  measure(state, [&] {
    for (int y0 = 0; y0 < camera.height_px; y0 += 4) {
      for (int x0 = 0; x0 < camera.width_px; x0 += 4) {
        std::size_t count = 0;
        for (int k = 0; k < 16; ++k) {
          const int x = x0 + k % 4, y = y0 + k / 4;
          if (x >= camera.width_px || y >= camera.height_px) continue;
          replay.at(hits.index(x, y), static_cast<int>(count));
          rays[count++] = pyramid().camera_ray(camera, x + 0.5, y + 0.5);
        }
        tree.visit_rays(std::span(rays).first(count), replay);
      }
    }
  });
  set_rate(state, "Mrays/s", kRays);
  state.counters["bytes_per_triangle"] = static_cast<double>(tree.bytes()) / triangles_of(field);
}

// The tree is built for the view's eye, as single precision wants it.
void bare_frame(benchmark::State& state, const char* preset, bool packets) {
  const Camera camera = bench_camera(preset);
  const BareEmbree embree(bench_terrain(), camera.eye_m);
  std::int64_t hits = 0;
  measure(state,
          [&] { hits = packets ? embree.cast_packets(camera) : embree.cast_single(camera); });
  set_rate(state, "Mrays/s", kRays);
  state.counters["hits"] = static_cast<double>(hits) / kRays;
  state.counters["build_user_s"] = embree.build_user_s();
  state.counters["bytes_per_triangle"] =
      static_cast<double>(embree.bytes()) / triangles_of(bench_terrain());
}

}  // namespace
}  // namespace plumb::bench

int main(int argc, char** argv) {
  using namespace plumb::bench;
  add("pyramid/build", pyramid_build);
  for (const char* preset : kPresets) {
    const std::string view = std::string("/") + preset;
    add("embree/bare_packets_of_16" + view, bare_frame, preset, true);
    add("embree/bare_single" + view, bare_frame, preset, false);
    for (const auto set : plumb::available_instruction_sets())
      add(std::string("pyramid/") + name_of(set) + view, pyramid_frame, preset, set);
    add("embree/caster" + view, embree_caster_frame, preset);
    add("embree/caster_proposals_alone" + view, embree_proposals, preset);
  }
  return plumb::bench::run(argc, argv);
}
