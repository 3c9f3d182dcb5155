// A program outside the tree: makes a terrain, looks at it, and writes a page about it.
#include <core/camera.h>
#include <core/screen_error.h>
#include <report/html_page.h>
#include <terrain/camera_presets.h>
#include <terrain/statistics.h>
#include <terrain/terrain_source.h>

#include <cstdio>

int main() {
  const plumb::terrain::Heightfield field =
      plumb::terrain::load_terrain("generate:alpine?size=65&seed=7");
  const plumb::terrain::TerrainStatistics found = plumb::terrain::statistics_of(field);
  const plumb::Camera camera =
      plumb::make_camera(plumb::terrain::preset_camera(field, "oblique", 640, 360, 50.0));
  const double error_px =
      plumb::largest_displacement_px(plumb::relative_to(camera, field.world_origin_m()),
                                     plumb::terrain::bounds(field), {0.0, 0.0, 1.0}, 1.0);
  plumb::report::HtmlPage page("From outside");
  page.add_key_values("Terrain",
                      {{"relief", std::to_string(found.highest.height_m - found.lowest.height_m)}});
  std::printf("%d x %d samples, a metre reaches %.3f px\n", field.columns(), field.rows(),
              error_px);
  return found.heights == 65 * 65 && error_px > 0.0 && !page.text().empty() ? 0 : 1;
}
