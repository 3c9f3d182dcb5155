// One stage of the program whose bits must be the same everywhere.
#pragma once

#include <cstdint>
#include <vector>

namespace plumb::determinism {

/// A stage computes something from fixed inputs and returns the checksum of every bit of it.
struct Stage {
  const char* name;
  std::uint64_t (*run)();
};

/// One function a stage; a module's stages stand in stages/MODULE_stages.cpp and its row in
/// stage_hashes.cpp.
std::vector<Stage> core_stages();
std::vector<Stage> terrain_stages();
std::vector<Stage> raster_stages();
std::vector<Stage> reference_stages();
std::vector<Stage> report_stages();
std::vector<Stage> mesh_stages();
std::vector<Stage> contouring_stages();  // of mesh, too
std::vector<Stage> stack_stages();       // of mesh, too
std::vector<Stage> slicing_stages();
std::vector<Stage> audit_stages();
std::vector<Stage> compare_stages();

/// Numbers that look random and are the same everywhere.
class Sequence {
 public:
  explicit Sequence(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t x = (state_ += 0x9e3779b97f4a7c15ULL);
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
  }
  /// In [low, high).
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(next() >> 11) * 0x1p-53);
  }

 private:
  std::uint64_t state_;
};

}  // namespace plumb::determinism
