// What stands before the data of a PLY file. Not for users of the library.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "terrain/forward_file.h"

namespace plumb::terrain {

enum class PlyType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };
enum class PlyFormat { Ascii, LittleEndian, BigEndian };

std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float64;    // of the value, or of each value of a list
  std::optional<PlyType> count_type;  // of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;  // at least one where count > 0
};

struct PlyHeader {
  PlyFormat format = PlyFormat::Ascii;
  std::vector<PlyElement> elements;
  /// The three words of "comment origin_m X Y Z", where plumb's own files say what must be added to
  /// each vertex; nothing where there is no such comment.
  std::optional<std::string> origin_m;
};

/// Reads up to and with the line "end_header". Throws InputError with the line and what was
/// expected there.
PlyHeader read_ply_header(ForwardFile& file);

/// The three numbers of PlyHeader::origin_m; nothing if these are not what it holds.
std::optional<glm::dvec3> ply_origin_m(const std::string& text);

}  // namespace plumb::terrain
