#include "terrain/mesh_ply.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/check.h"
#include "core/memory.h"
#include "terrain/ply_header.h"
#include "terrain/ply_values.h"

namespace plumb::terrain {
namespace {

constexpr int kSkipped = -1;

bool is_corners(const PlyProperty& property) {
  return property.count_type &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

// For each property of a vertex its axis, or kSkipped.
std::vector<int> axes_of(const ForwardFile& file, const PlyElement& element) {
  std::vector<int> axes;
  std::array<int, 3> found{};
  for (const PlyProperty& property : element.properties) {
    const std::size_t axis = std::string_view("xyz").find(property.name);
    const bool is_axis = property.name.size() == 1 && axis < 3 && !property.count_type;
    axes.push_back(is_axis ? static_cast<int>(axis) : kSkipped);
    if (is_axis) ++found[axis];
  }
  if (found != std::array<int, 3>{1, 1, 1})
    input_error("{}: expected properties x, y and z of element 'vertex', once each", file.name());
  return axes;
}

const PlyElement& element_named(const ForwardFile& file, const PlyHeader& header,
                                const std::string& name) {
  const PlyElement* found = nullptr;
  for (const PlyElement& element : header.elements) {
    if (element.name != name) continue;
    if (found != nullptr) input_error("{}: expected one element '{}', got two", file.name(), name);
    found = &element;
  }
  if (found == nullptr || found->count == 0)
    input_error("{}: expected element '{}', {}", file.name(), name,
                found == nullptr ? "which the header lacks" : "of which there is none");
  return *found;
}

template <class Values>
class PlyReader {
 public:
  PlyReader(ForwardFile& file, Values values, const PlyHeader& header, PolygonSoup& soup)
      : file_(file),
        values_(std::move(values)),
        vertices_(element_named(file, header, "vertex")),
        faces_(element_named(file, header, "face")),
        axes_(axes_of(file, vertices_)),
        soup_(soup) {
    if (vertices_.count > kMostVertices)
      input_error("{}: the header promises {} vertices, expected at most {}", file.name(),
                  vertices_.count, kMostVertices);
    const auto corners =
        std::find_if(faces_.properties.begin(), faces_.properties.end(), is_corners);
    if (corners == faces_.properties.end())
      input_error("{}: expected a list 'vertex_indices' or 'vertex_index' of element 'face'",
                  file.name());
    corners_at_ = static_cast<std::size_t>(corners - faces_.properties.begin());
  }

  void read(const PlyElement& element) {
    require_room(element);
    if (&element == &vertices_) reserve(soup_.vertices_m, element.count);
    if (&element == &faces_) reserve(soup_.sizes, element.count);
    for (row_ = 0; row_ < element.count; ++row_) {
      values_.begin_row();
      if (&element == &vertices_) {
        read_vertex();
      } else if (&element == &faces_) {
        read_face();
      } else {
        for (const PlyProperty& property : element.properties) skip(property);
      }
      values_.end_row();
    }
  }

 private:
  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> message, Args&&... args) const {
    input_error("{}: {}: {}", file_.name(), values_.where(),
                fmt::format(message, std::forward<Args>(args)...));
  }

  // A header may promise anything: what is left of the file must be able to keep it.
  void require_room(const PlyElement& element) const {
    std::uint64_t least = 0;
    for (const PlyProperty& property : element.properties)
      least += Values::least_bytes(property.count_type.value_or(property.type));
    if (element.count > 0 && file_.left() / least < element.count)
      input_error(
          "{}: the header promises {} of element {}, at least {} bytes each, but from byte {} on "
          "the file has {} bytes",
          file_.name(), element.count, shown(element.name), least, file_.at(), file_.left());
  }
  template <class T>
  void reserve(std::vector<T>& into, std::uint64_t count) const {
    require_memory(static_cast<std::int64_t>(count * sizeof(T)), file_.name());
    into.reserve(count);
  }

  void read_vertex() {
    glm::dvec3 p{0.0};
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      if (axes_[k] == kSkipped) {
        skip(vertices_.properties[k]);
      } else {
        p[axes_[k]] = values_.next(vertices_.properties[k].type);
      }
    }
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      fail("vertex {}: expected finite coordinates, got {}, {}, {}", row_, p.x, p.y, p.z);
    soup_.vertices_m.push_back(p);
  }

  void read_face() {
    for (std::size_t k = 0; k < faces_.properties.size(); ++k) {
      const PlyProperty& property = faces_.properties[k];
      if (k != corners_at_) {
        skip(property);
        continue;
      }
      const std::uint64_t count = count_of(property);
      for (std::uint64_t c = 0; c < count; ++c) read_corner(property.type);
      soup_.sizes.push_back(static_cast<std::uint32_t>(count));
    }
  }
  void read_corner(PlyType type) {
    const double index = values_.next(type);
    if (!(index >= 0.0 && index < static_cast<double>(vertices_.count)) ||
        index != std::floor(index))
      fail("face {}: expected indices of vertices, 0 to {}, got {}", row_, vertices_.count - 1,
           index);
    soup_.corners.push_back(static_cast<std::uint32_t>(index));
  }

  // How long a list is; the file must be able to hold it.
  std::uint64_t count_of(const PlyProperty& property) {
    const double count = values_.next(*property.count_type);
    if (!(count >= 0.0 && count <= 4294967295.0) || count != std::floor(count))
      fail("list {}: expected a count, got {}", shown(property.name), count);
    return static_cast<std::uint64_t>(count);
  }
  void skip(const PlyProperty& property) {
    values_.skip(property.type, property.count_type ? count_of(property) : 1);
  }

  ForwardFile& file_;
  Values values_;
  const PlyElement& vertices_;
  const PlyElement& faces_;
  std::vector<int> axes_;
  PolygonSoup& soup_;
  std::size_t corners_at_ = 0;
  std::uint64_t row_ = 0;
};

template <class Values>
void read_data(ForwardFile& file, Values values, const PlyHeader& header, PlyPolygons& polygons) {
  PlyReader<Values> reader(file, std::move(values), header, polygons.soup);
  for (const PlyElement& element : header.elements) reader.read(element);
}

bool has_float_coordinates(const ForwardFile& file, const PlyHeader& header) {
  const PlyElement& vertices = element_named(file, header, "vertex");
  const std::vector<int> axes = axes_of(file, vertices);
  for (std::size_t k = 0; k < axes.size(); ++k) {
    if (axes[k] != kSkipped && vertices.properties[k].type == PlyType::Float32) return true;
  }
  return false;
}

}  // namespace

PlyPolygons read_ply(ForwardFile& file) {
  const PlyHeader header = read_ply_header(file);
  PlyPolygons polygons;
  polygons.origin_m = header.origin_m;
  polygons.single_precision = has_float_coordinates(file, header);
  if (header.format == PlyFormat::Ascii) {
    read_data(file, TextPlyValues(file), header, polygons);
  } else {
    read_data(file, BinaryPlyValues(file, header.format == PlyFormat::BigEndian), header, polygons);
  }
  return polygons;
}

}  // namespace plumb::terrain
