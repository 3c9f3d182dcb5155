#include "audit/picture.h"

#include <fmt/format.h>

#include <span>
#include <vector>

#include "audit/surface_picture.h"
#include "core/box.h"
#include "core/check.h"
#include "core/parallel.h"
#include "raster/shading/blend.h"
#include "raster/shading/shade.h"
#include "reference/surface_height.h"

namespace plumb::audit {
namespace {

void add_header(const terrain::Heightfield& field, const PictureMaker& maker,
                std::map<std::string, image::MetadataValue>& header) {
  const terrain::Provenance& from = field.provenance;
  header["method"] = maker.method;
  if (!maker.variant.empty()) header["variant"] = maker.variant;
  for (const auto& [name, value] : maker.parameters) header["parameter." + name] = value;
  if (maker.tolerance) header["tolerance"] = to_text(*maker.tolerance);
  header["diagonal"] = std::string(name_of(maker.diagonal));
  header["terrain.source"] = from.source;
  header["terrain.checksum"] = fmt::format("{:016x}", terrain::checksum(field));
  header["terrain.window"] =
      fmt::format("{},{},{},{}", from.window_x, from.window_y, field.columns(), field.rows());
  header["program"] = "plumb " + maker.program_version;
  if (!maker.scene_toml.empty()) header["scene"] = maker.scene_toml;
}

image::AovImage finish(const terrain::Heightfield& field, const HitImage& hits,
                       const Camera& camera, const PictureMaker& maker,
                       std::span<const glm::dvec3> normals, const image::PatchPlanes& planes,
                       bool two_sided = true, std::span<const glm::vec3> albedo = {}) {
  raster::ShadeOptions options;
  options.albedo = albedo;
  options.two_sided = two_sided;
  const Box box = bounds(field);
  if (!box.empty()) {
    options.low_m = box.low.z;
    options.high_m = box.high.z;
  }
  if (maker.drape != nullptr && !box.empty()) {
    const glm::dvec2 origin(field.world_origin_m());
    options.drape = {maker.drape, origin + glm::dvec2(box.low), origin + glm::dvec2(box.high)};
  }
  image::ColourImage colours = raster::shade(hits, camera, normals, options);
  if (maker.layers != nullptr) {
    colours =
        raster::blend(colours, *maker.layers,
                      layer_normals(*maker.layers, camera, field, maker.diagonal), camera, options);
  }
  image::PixelAttributes attributes;
  attributes.normals = normals;
  attributes.ids = planes.ids;
  attributes.lods = planes.lods;
  attributes.colours = &colours;
  image::AovImage picture = image::make_aov(hits, camera, attributes);
  add_header(field, maker, picture.metadata);
  return picture;
}

}  // namespace

image::AovImage draw_picture(const terrain::Heightfield& field, const HitImage& drawn,
                             const DrawnSurface& surface, const Camera& camera,
                             const PictureMaker& maker) {
  const std::vector<glm::dvec3> normals =
      shading_normals(surface, drawn, camera, field, maker.diagonal);
  image::PatchPlanes planes = image::patch_planes(drawn, surface);
  for (std::size_t k = 0; k < drawn.size() && !surface.triangle_lod.empty(); ++k) {
    if (drawn.hit(k)) planes.lods[k] = surface.triangle_lod.at(drawn.primitive[k]);
  }
  // A picture that the user lays over the ground hides what it is made of.
  const std::vector<glm::vec3> albedo =
      maker.drape != nullptr ? std::vector<glm::vec3>() : vertex_albedo(surface, drawn, camera);
  return finish(field, drawn, camera, maker, normals, planes, surface.mesh != nullptr, albedo);
}

image::AovImage draw_truth_picture(const terrain::Heightfield& field, const HitImage& true_hits,
                                   const Camera& camera, const PictureMaker& maker) {
  const std::size_t triangles =
      2 * static_cast<std::size_t>(field.cell_columns()) * field.cell_rows();
  std::vector<glm::dvec3> normals(true_hits.size(), glm::dvec3(0.0));
  image::PatchPlanes planes{std::vector<int>(true_hits.size(), -1), {}};
  for (std::size_t k = 0; k < true_hits.size(); ++k) {
    if (!true_hits.hit(k)) continue;
    require(true_hits.primitive[k] < triangles, "a hit names triangle {}, the terrain has {}",
            true_hits.primitive[k], triangles);
    planes.ids[k] = 0;
  }
  planes.lods = planes.ids;
  parallel_for(static_cast<std::int64_t>(true_hits.size()), 16384, [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    if (!true_hits.hit(k)) return;
    normals[k] = reference::triangle_normal(field, maker.diagonal, true_hits.primitive[k]);
  });
  return finish(field, true_hits, camera, maker, normals, planes);
}

image::ColourImage preview_of(const image::AovImage& picture) {
  require(!picture.r.empty() && !picture.g.empty() && !picture.b.empty(),
          "a picture without colours has no preview");
  image::ColourImage colours(picture.width_px, picture.height_px);
  colours.r = picture.r;
  colours.g = picture.g;
  colours.b = picture.b;
  return colours;
}

}  // namespace plumb::audit
