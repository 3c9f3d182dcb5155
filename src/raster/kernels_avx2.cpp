#include "core/lanes_avx2.h"
#include "raster/pairs_avx2.h"
#include "raster/triangle_filter_body.h"
#include "raster/vertex_kernel_body.h"

namespace plumb::raster {

bool transform_vertices_avx2(const WindowTransform& to, const double* vertices, std::int64_t count,
                             ScreenVertex* window) {
  return VertexKernel<Avx2Lanes>(to).run(vertices, count, window);
}

std::uint32_t filter_triangles_avx2(const TriangleFilter& how, const std::uint32_t* corners,
                                    std::uint32_t count, std::uint32_t* kept) {
  return filter<Avx2Pairs>(how, corners, count, kept);
}

}  // namespace plumb::raster
