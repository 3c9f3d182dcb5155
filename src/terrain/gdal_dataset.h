// GDAL's datasets without GDAL's headers. Not for users of the library.
#pragma once

#include <memory>
#include <string>

#include "terrain/georeference.h"

class GDALDataset;
class OGRSpatialReference;

namespace plumb::terrain {

/// Collects what GDAL complains of on this thread while it lives, in place of its standard error.
class Complaints {
 public:
  Complaints();
  ~Complaints();
  Complaints(const Complaints&) = delete;
  Complaints& operator=(const Complaints&) = delete;

  void add(const std::string& message, bool is_warning);
  /// " (GDAL: what it said)", one line, failures before warnings; empty if it said nothing.
  std::string text() const;
  /// True if it failed at something.
  bool has_failures() const { return !failures_.empty(); }

 private:
  std::string failures_, warnings_;
};

struct CloseDataset {
  void operator()(GDALDataset* dataset) const;
};
using Dataset = std::unique_ptr<GDALDataset, CloseDataset>;

/// Makes GDAL know its formats; calls after the first do nothing.
void register_formats();

/// A file with at least one raster. Throws InputError with the complaints.
Dataset open_dataset(const std::string& file, const Complaints& complaints);

/// True if `file` holds the samples of an SRTM tile or is called one (.hgt), but GDAL takes it for
/// no format at all, as it does where the name does not state the tile's corner.
bool is_unnamed_hgt(const std::string& file, const ReadOptions& options);

/// The samples of such a file (1201 x 1201 or 3601 x 3601 big-endian int16, a degree across and up;
/// -32768 is void) where options.origin places them, in memory. Throws InputError if the file has
/// another size or there is no origin.
Dataset open_unnamed_hgt(const std::string& file, const ReadOptions& options);

/// What a coordinate system says of the place of what is laid out in it.
void describe(const OGRSpatialReference& crs, FileGeoreference& georeference);

/// What a dataset says about its place.
FileGeoreference georeference_of(GDALDataset& dataset);

/// The heights of a window of `source`, resampled (bilinear; voids are NaN) into options.crs, in
/// memory. Throws InputError that names `file` if either coordinate system is unknown.
struct Reprojected {
  Dataset copy;    // of the heights, where they stood
  Dataset result;  // reads the copy as it is read, so it goes first
};
Reprojected reproject(const Heightfield& heights, GDALDataset& source, const Window& window,
                      const std::string& crs, const std::string& file,
                      const Complaints& complaints);

}  // namespace plumb::terrain
