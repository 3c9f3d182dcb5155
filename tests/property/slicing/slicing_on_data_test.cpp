// What slices promise on real elevation, held against the truth by the audit.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "audit/audit.h"
#include "slicing/slicing_method.h"
#include "support/elevation_files.h"
#include "terrain/camera_presets.h"
#include "terrain/terrain_source.h"

namespace plumb::slicing {
namespace {

using test_support::ElevationFile;
using test_support::kElevationFiles;

class SlicedFile : public testing::TestWithParam<ElevationFile> {};

// Conservative slices keep half a pixel, one and two from every preset view, alone and with
// polygons; of the published ones the figures are printed.
TEST_P(SlicedFile, KeepsItsConservativePromise) {
  const ElevationFile& file = GetParam();
  const std::string path = test_support::path_of(file);
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  terrain::ReadOptions options;
  options.window = file.window;
  options.decode = file.decode;
  options.spacing_x_m = file.spacing_m;
  const terrain::Heightfield field = terrain::load_terrain(path, options);
  const audit::HeightfieldTruth truth(field, terrain::Diagonal::Alternating);
  for (const Variant variant : {Variant::Conservative, Variant::Published}) {
    Parameters parameters;
    parameters.cut.variant = variant;
    for (const double tolerance_px : {0.5, 1.0, 2.0}) {
      parameters.cut.hybrid = tolerance_px == 2.0;
      const Prepared prepared = prepare(field, terrain::Diagonal::Alternating, parameters);
      for (const auto& preset : terrain::preset_help()) {
        // Straight down on a square a diagonal of rays meets the edges of boxes.
        const int width_px = preset.name == "top" ? 181 : 240;
        const int height_px = preset.name == "top" ? 181 : 135;
        const Camera camera =
            make_camera(terrain::preset_camera(field, preset.name, width_px, height_px, 50.0));
        audit::AuditOptions audit_options;
        audit_options.band.pixels = tolerance_px;
        audit_options.nearest = false;
        const audit::AuditResult result = audit::audit_surface(
            truth, draw(prepared, camera, {tolerance_px, Unit::Pixel}), camera, audit_options);
        std::printf("%s %s %s %g px: max %.3f p99 %.3f holes %d see-through %d set aside %d\n",
                    file.name, variant == Variant::Published ? "published" : "conservative",
                    preset.name.c_str(), tolerance_px, result.vertical.max, result.vertical.p99,
                    static_cast<int>(result.coverage.holes),
                    static_cast<int>(result.coverage.see_through),
                    static_cast<int>(result.pixels_set_aside));
        if (variant == Variant::Published) continue;
        EXPECT_TRUE(result.holds()) << preset.name << " at " << tolerance_px << " px";
        EXPECT_GT(result.vertical.count, 0);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Slices, SlicedFile, testing::ValuesIn(kElevationFiles));

}  // namespace
}  // namespace plumb::slicing
