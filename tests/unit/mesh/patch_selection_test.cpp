// What a frame says of the patches that it holds.
#include "mesh/tessellation/patch_selection.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace plumb::mesh::tessellation {
namespace {

// 320 x 320 m, every second column 100 m high: decimated it is flat, so that the four patches of
// 160 m are drawn whatever the tolerance.
Prepared fence(Variant variant) {
  Grid<float> heights_m(33, 33);
  for (int j = 0; j < 33; ++j)
    for (int i = 0; i < 33; ++i) heights_m(i, j) = i % 2 == 1 ? 100.0f : 0.0f;
  terrain::Heightfield field;
  field.heights_m = std::move(heights_m);
  field.dx_m = field.dy_m = 10.0;
  return prepare(field, {.variant = variant, .error_m = 0.001, .patch_cells = 16});
}

// A metre east of the middle.
Camera looking(const glm::dvec3& along) {
  const glm::dvec3 eye{161, 160, 50};
  return make_camera({.eye_m = eye, .target_m = eye + along, .width_px = 400, .height_px = 400});
}

std::string note_of(Variant variant, const Camera& camera, const Tolerance& tolerance) {
  const std::string note = draw(fence(variant), camera, tolerance).notes.front();
  return note.substr(0, note.find(", ", note.find("in view")));
}

TEST(PatchSelection, CountsPatchesInViewApartFromThoseResident) {
  for (const Variant variant : {Variant::Conservative, Variant::Published}) {
    for (const Tolerance& tolerance : {Tolerance{0.5, Unit::Metre}, Tolerance{0.5, Unit::Pixel}}) {
      EXPECT_EQ(note_of(variant, looking({100, 0, 0}), tolerance),
                "4 patches resident, 2 in view");  // the western half is behind
      EXPECT_EQ(note_of(variant, looking({-100, 0, 0}), tolerance),
                "4 patches resident, 4 in view");  // the eye stands in the eastern half's boxes
    }
  }
}

// All of it behind the eye: in metres it is drawn all the same, in pixels one patch is enough.
TEST(PatchSelection, CountsNoPatchInViewWhereNoneIs) {
  Camera camera = looking({100, 0, 0});
  camera.eye_m.x = 400;
  EXPECT_EQ(note_of(Variant::Conservative, camera, {0.5, Unit::Metre}),
            "4 patches resident, 0 in view");
  EXPECT_EQ(note_of(Variant::Conservative, camera, {0.5, Unit::Pixel}),
            "1 patches resident, 0 in view");
}

}  // namespace
}  // namespace plumb::mesh::tessellation
