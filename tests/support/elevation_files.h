// The elevation files that tests use where they are present, and how each is read.
#pragma once

#include <optional>
#include <ostream>
#include <string>

#include "terrain/read_options.h"

namespace plumb::test_support {

/// A file of the folder shared/data that stands beside the project, if it does.
struct ElevationFile {
  const char* name;
  std::optional<terrain::Window> window =
      std::nullopt;  // of the ordinary run; all of it where absent
  terrain::Decode decode = terrain::Decode::Unspecified;
  std::optional<double> spacing_m = std::nullopt;

  friend std::ostream& operator<<(std::ostream& out, const ElevationFile& file) {
    return out << file.name;
  }
};

inline const ElevationFile kElevationFiles[] = {
    {"taiwan_central_8193.tif", terrain::Window{4000, 3000, 1025, 900}},
    {"narok_kenya_5840x4934.tif", terrain::Window{2000, 200, 1025, 900}},
    {"etopo5_global_4320x2161.tif", terrain::Window{800, 500, 1025, 700}},
    {"srtm3_alps_N46E008.tif", {}},
    {"srtm3_canberra_S36E149.tif", {}},
    {"N28W017.hgt", {}},
    {"N29W014.hgt", {}},
    {"N65E029.hgt", {}},
    {"bigtujunga_30m.tif", {}},
    {"jacksboro_fault_403x344.tif", {}},
    {"ahn_dsm_0p5m_963x840.tif", {}},
    {"martini_fuji_terrainrgb.png", {}, terrain::Decode::TerrainRgb, 31.0},
    {"delatin_14-2625-6369_terrainrgb.png", {}, terrain::Decode::TerrainRgb, 3.8},
};

inline std::string path_of(const ElevationFile& file) {
  return std::string(PLUMB_SOURCE_DIR) + "/../shared/data/" + file.name;
}

}  // namespace plumb::test_support
