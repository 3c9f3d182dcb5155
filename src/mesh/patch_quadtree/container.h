// A file of patches: what its header says, where each record lies, and whether it is whole.
// Byte by byte in docs/formats/plumb-container.md.
#pragma once

#include <glm/vec2.hpp>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/byte_stream.h"
#include "mesh/patch_quadtree/patch_layout.h"
#include "mesh/patch_quadtree/quantiser.h"

namespace plumb::mesh::patch_quadtree {

/// What the records hold beside heights.
enum class Payload : std::uint32_t { Heights = 0, Tessellation = 1, RestrictedQuadtree = 2 };

/// How heights are coded: as the paper has it, or modelled.
enum class CodecVersion : std::uint32_t { Published = 1, Modelled = 2 };

struct ContainerHeader {
  CodecVersion version = CodecVersion::Modelled;
  Payload payload = Payload::Heights;
  PatchLayout layout;
  Quantiser quantiser;
  double error_m = 0.0;  // that no decoded height of the finest level exceeds
  double dx_m = 1.0, dy_m = 1.0;
  glm::dvec2 origin_m{0.0};
  std::uint64_t terrain_checksum = 0;  // of the terrain that was coded
  std::string source, crs;             // where it comes from, what its coordinates are in
  Bytes models;                        // of the codec, for all records
  Bytes parameters;                    // of the payload

  /// What no decoded height of a level exceeds: error_m, or twice as much with each level where the
  /// step doubles.
  double promised_m(int level) const {
    return quantiser.rule == StepRule::Same ? error_m : std::ldexp(error_m, level);
  }
};

/// Two streams for each patch, by its number: its heights (of version 1 a family's, under its
/// parent's number, the root's under the number of patches), and what the payload says of it.
struct ContainerRecords {
  std::vector<Bytes> heights, payload;
};

/// The whole file. Throws std::invalid_argument if there are not as many records as the layout
/// says, or if a part of the header, all of it or a record has 4 GiB or more.
Bytes container_bytes(const ContainerHeader& header, const ContainerRecords& records);

/// An open file: its header and table are read and checked at once, records when they are asked
/// for, from any thread.
class Container {
 public:
  /// Throws InputError, one line with the file and what is wrong: not such a file, of a version
  /// that is not known, cut off, damaged, or of sizes beyond what it can hold.
  explicit Container(const std::filesystem::path& path);
  /// The same of a file in memory; `name` is what its errors call it.
  explicit Container(Bytes file, std::string name = "<memory>");
  ~Container();
  Container(const Container&) = delete;
  Container& operator=(const Container&) = delete;

  /// The file's path, or what it is called.
  const std::string& name() const;
  const ContainerHeader& header() const;
  std::int64_t file_bytes() const;
  /// A record's bytes, checked. Throws InputError if they are damaged, naming the patch.
  Bytes heights(std::int64_t record) const;
  Bytes payload(std::int64_t record) const;
  /// How large they are, unread.
  std::int64_t heights_bytes(std::int64_t record) const;
  std::int64_t payload_bytes(std::int64_t record) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// True if what stands there is a file that begins as a container does, whatever its name.
bool is_container(const std::filesystem::path& path);

}  // namespace plumb::mesh::patch_quadtree
