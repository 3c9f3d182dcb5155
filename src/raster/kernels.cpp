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
  switch (set) {
    case InstructionSet::Sse2:
      return transform_vertices_sse2;
    case InstructionSet::Avx2:
      return transform_vertices_avx2;
    case InstructionSet::Avx512:
      return transform_vertices_avx512;
  }
  return transform_vertices_sse2;
}

FilterTriangles filter_triangles(InstructionSet set) {
  switch (set) {
    case InstructionSet::Sse2:
      return filter_triangles_sse2;
    case InstructionSet::Avx2:
      return filter_triangles_avx2;
    case InstructionSet::Avx512:
      return filter_triangles_avx512;
  }
  return filter_triangles_sse2;
}

}  // namespace plumb::raster
