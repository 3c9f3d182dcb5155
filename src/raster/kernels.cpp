#include "raster/triangle_filter.h"
#include "raster/vertex_kernel.h"

namespace plumb::raster {

bool transform_vertices_sse2(const WindowTransform&, const double*, std::int64_t, ScreenVertex*);
bool transform_vertices_avx2(const WindowTransform&, const double*, std::int64_t, ScreenVertex*);
bool transform_vertices_avx512(const WindowTransform&, const double*, std::int64_t, ScreenVertex*);

std::uint32_t filter_triangles_sse2(const TriangleFilter&, const std::uint32_t*, std::uint32_t,
                                    std::uint32_t*);
std::uint32_t filter_triangles_avx2(const TriangleFilter&, const std::uint32_t*, std::uint32_t,
                                    std::uint32_t*);
std::uint32_t filter_triangles_avx512(const TriangleFilter&, const std::uint32_t*, std::uint32_t,
                                      std::uint32_t*);

TransformVertices transform_vertices(InstructionSet set) {
  return kernel_for(set, transform_vertices_sse2, transform_vertices_avx2,
                    transform_vertices_avx512);
}

FilterTriangles filter_triangles(InstructionSet set) {
  return kernel_for(set, filter_triangles_sse2, filter_triangles_avx2, filter_triangles_avx512);
}

}  // namespace plumb::raster
