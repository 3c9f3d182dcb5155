// Where the samples of files that GDAL reads stand.
#include <cmath>

#include "core/reproducible_math.h"
#include "terrain/georeference.h"
#include "written_files.h"

namespace plumb::terrain {
namespace {

GeoTiff grid(int columns, int rows) {
  GeoTiff tiff;
  tiff.columns = columns;
  tiff.rows = rows;
  for (int k = 0; k < columns * rows; ++k) tiff.values.push_back(k);
  return tiff;
}

Heightfield reload(const GeoTiff& tiff, const ReadOptions& options = {}) {
  const TemporaryFolder folder;
  const std::string file = folder.file("terrain.tif");
  write(file, tiff);
  return load_terrain(file, options);
}

std::string refusal(const GeoTiff& tiff, const ReadOptions& options = {}) {
  return input_error_of([&] { reload(tiff, options); });
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(GdalPlace, ASampleStandsAtItsPixelsCentre) {
  GeoTiff tiff = grid(3, 2);
  tiff.crs = "EPSG:32611";
  tiff.transform = {{500000.0, 30.0, 0.0, 4000000.0, 0.0, -20.0}};
  const Heightfield field = reload(tiff);
  EXPECT_EQ(field.dx_m, 30.0);
  EXPECT_EQ(field.dy_m, 20.0);
  EXPECT_EQ(field.origin_m.x, 500015.0);
  EXPECT_EQ(field.origin_m.y, 4000000.0 - 40.0 + 10.0);  // the southern row's centre
  EXPECT_EQ(field.provenance.crs, "EPSG:32611");
}

// Both kinds of GeoTIFF state the same corner here; GDAL shifts the one by half a pixel.
TEST(GdalPlace, PixelsThatArePointsStandWherePixelsThatAreAreasDo) {
  GeoTiff tiff = grid(3, 2);
  tiff.crs = "EPSG:32611";
  tiff.transform = {{500000.0, 30.0, 0.0, 4000000.0, 0.0, -30.0}};
  const Heightfield area = reload(tiff);
  const TemporaryFolder folder;
  // The tie point of a point raster is the centre of its pixel.
  write_text(folder.file("point.asc"),
             "ncols 3\nnrows 2\nxllcenter 500015\nyllcenter 3999955\ncellsize 30\n0 1 2\n3 4 5\n");
  const Heightfield point = load_terrain(folder.file("point.asc"));
  EXPECT_EQ(point.origin_m, area.origin_m);
  EXPECT_EQ(point.heights_m, area.heights_m);
}

TEST(GdalPlace, AReprojectedGridIsCountedFromItsOwnCorner) {
  GeoTiff tiff = grid(40, 30);
  tiff.crs = "EPSG:4326";
  tiff.transform = {{8.0, 0.001, 0.0, 46.0, 0.0, -0.001}};
  ReadOptions options;
  options.crs = "EPSG:32632";
  options.window = Window{5, 5, 30, 20};
  const Heightfield field = reload(tiff, options);
  EXPECT_EQ(field.provenance.crs, "EPSG:32632");
  EXPECT_EQ(field.provenance.file_columns, field.columns());
  EXPECT_EQ(field.provenance.file_rows, field.rows());
  EXPECT_EQ(field.provenance.window_x, 0);
  EXPECT_EQ(field.provenance.window_y, 0);
}

// GDAL would call the first grid one of integers, which have no NaN, and the second one of float32.
TEST(GdalPlace, TextThatIsNoNumberOrInfiniteIsVoid) {
  const TemporaryFolder folder;
  for (const char* first : {"1", "1.5"}) {
    write_text(folder.file("g.asc"),
               std::string("ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 30\n") + first +
                   " nan 3\n4 inf 6\n");
    const Heightfield field = load_terrain(folder.file("g.asc"));
    EXPECT_EQ(field.provenance.voids_not_finite, 2) << first;
    EXPECT_EQ(field.heights_m(0, 1), std::stof(first));
    EXPECT_TRUE(std::isnan(field.heights_m(1, 0)));
    EXPECT_TRUE(std::isnan(field.heights_m(1, 1)));
  }
}

TEST(GdalPlace, RowsThatRunNorthAreNotFlipped) {
  GeoTiff tiff = grid(2, 2);
  tiff.crs = "EPSG:32611";
  tiff.transform = {{0.0, 1.0, 0.0, 100.0, 0.0, 1.0}};
  const Heightfield field = reload(tiff);
  EXPECT_EQ(field.heights_m(0, 0), 0.0f);
  EXPECT_EQ(field.heights_m(0, 1), 2.0f);
  EXPECT_EQ(field.origin_m.y, 100.5);
}

TEST(GdalPlace, AWindowIsCountedFromTheTopLeftOfTheFile) {
  GeoTiff tiff = grid(4, 3);
  tiff.crs = "EPSG:32611";
  tiff.transform = {{1000.0, 10.0, 0.0, 2000.0, 0.0, -10.0}};
  ReadOptions options;
  options.window = Window{1, 0, 2, 2};
  const Heightfield field = reload(tiff, options);
  EXPECT_EQ(as_in_file(field), (std::vector<float>{1, 2, 5, 6}));
  EXPECT_EQ(field.origin_m.x, 1015.0);
  EXPECT_EQ(field.origin_m.y, 2000.0 - 15.0);
  EXPECT_EQ(field.provenance.window_x, 1);
  EXPECT_EQ(field.provenance.window_y, 0);
  EXPECT_EQ(field.provenance.file_columns, 4);
  EXPECT_EQ(field.provenance.file_rows, 3);
}

TEST(GdalPlace, FeetOfTheCoordinateSystemBecomeMetres) {
  GeoTiff tiff = grid(2, 2);
  tiff.crs = "EPSG:2229";  // California zone 5, US survey feet
  tiff.transform = {{3937.0, 39.37, 0.0, 7874.0, 0.0, -39.37}};
  const Heightfield field = reload(tiff);
  EXPECT_NEAR(field.dx_m, 12.0, 1e-9);  // 39.37 US survey feet are 12 m by definition
  EXPECT_NEAR(field.dy_m, 12.0, 1e-9);
  EXPECT_NEAR(field.origin_m.x, 1206.0, 1e-6);
  EXPECT_NEAR(field.origin_m.y, 2400.0 - 18.0, 1e-6);
  EXPECT_TRUE(assumes(field, "horizontal units"));
}

TEST(GdalPlace, DegreesBecomeMetresOnATangentPlane) {
  GeoTiff tiff = grid(3, 3);
  tiff.crs = "EPSG:4326";
  tiff.transform = {{10.0, 0.001, 0.0, 45.0015, 0.0, -0.001}};  // centred on 45 degrees north
  const Heightfield field = reload(tiff);
  // Published lengths of a degree at 45 degrees on WGS 84: 78846.8 m and 111131.7 m.
  EXPECT_NEAR(field.dx_m, 78.8468, 0.0001);
  EXPECT_NEAR(field.dy_m, 111.1317, 0.0001);
  EXPECT_EQ(field.origin_m, glm::dvec2(0.0));
  EXPECT_TRUE(assumes(field, "plane that touches the earth"));
  EXPECT_FALSE(assumes(field, "taken as flat"));
}

TEST(GdalPlace, MoreThanADegreeIsSaidToBeFlat) {
  GeoTiff tiff = grid(3, 3);
  tiff.crs = "EPSG:4326";
  tiff.transform = {{10.0, 0.6, 0.0, 45.0, 0.0, -0.6}};
  EXPECT_TRUE(assumes(reload(tiff), "spans 1.20 degrees and the earth was taken as flat"));
  tiff.crs = "EPSG:32611";
  tiff.transform = {{0.0, 60000.0, 0.0, 0.0, 0.0, -60000.0}};
  EXPECT_TRUE(assumes(reload(tiff), "taken as flat"));
}

TEST(GdalPlace, WebMercatorIsScaledByTheCosineOfTheLatitude) {
  GeoTiff tiff = grid(3, 3);
  tiff.crs = "EPSG:3857";
  // y = R ln(tan(75 degrees)) is 60 degrees north, where lengths are doubled.
  const double y = 6378137.0 * std::log(std::tan(radians(75.0)));
  tiff.transform = {{1000.0, 10.0, 0.0, y + 15.0, 0.0, -10.0}};
  const Heightfield field = reload(tiff);
  EXPECT_NEAR(field.dx_m, 5.0, 1e-9);
  EXPECT_NEAR(field.dy_m, 5.0, 1e-9);
  EXPECT_NEAR(field.origin_m.x, 502.5, 1e-6);
  EXPECT_TRUE(assumes(field, "Mercator"));
}

TEST(GdalPlace, TheUsersSpacingOverridesTheFiles) {
  GeoTiff tiff = grid(2, 2);
  tiff.crs = "EPSG:4326";
  ReadOptions options;
  options.spacing_x_m = 20.0;
  options.spacing_y_m = 30.0;
  const Heightfield field = reload(tiff, options);
  EXPECT_EQ(field.dx_m, 20.0);
  EXPECT_EQ(field.dy_m, 30.0);
  EXPECT_EQ(field.origin_m, glm::dvec2(0.0));
  EXPECT_TRUE(assumes(field, "the user's"));
}

TEST(GdalPlace, WithoutACoordinateSystemCoordinatesAreMetresAndThatIsSaid) {
  GeoTiff tiff = grid(2, 2);
  tiff.transform = {{100.0, 5.0, 0.0, 200.0, 0.0, -5.0}};
  const Heightfield field = reload(tiff);
  EXPECT_EQ(field.dx_m, 5.0);
  EXPECT_TRUE(assumes(field, "coordinates were taken as metres"));
}

TEST(GdalPlace, WithoutACoordinateSystemArcSecondsAreDegreesAndThatIsSaid) {
  GeoTiff tiff = grid(2, 2);
  tiff.transform = {{-84.0, 1.0 / 3600.0, 0.0, 36.0, 0.0, -1.0 / 3600.0}};
  const Heightfield field = reload(tiff);
  EXPECT_NEAR(field.dy_m, 30.8, 0.1);
  EXPECT_TRUE(assumes(field, "was taken as degrees"));
}

TEST(GdalPlace, ARotatedTransformNamesTheToolThatRemovesIt) {
  GeoTiff tiff = grid(2, 2);
  tiff.transform = {{0.0, 1.0, 0.2, 0.0, 0.2, -1.0}};
  const std::string message = refusal(tiff);
  EXPECT_TRUE(contains(message, "gdalwarp")) << message;
  EXPECT_TRUE(contains(message, "terrain.tif")) << message;
}

TEST(GdalPlace, WithoutASpacingTheErrorAsksForOne) {
  GeoTiff tiff = grid(2, 2);
  tiff.transform.reset();
  EXPECT_TRUE(contains(refusal(tiff), "--spacing"));
  ReadOptions options;
  options.require_spacing = false;
  const Heightfield field = reload(tiff, options);
  EXPECT_EQ(field.dx_m, 1.0);
  EXPECT_TRUE(assumes(field, "1 m was assumed"));
}

// A plane that rises 1 m each 10 m eastwards keeps its slope under any projection that keeps
// lengths, up to the scale of the two zones (0.9996 at least) and the turn of the grid.
TEST(GdalPlace, ReprojectionKeepsASlope) {
  GeoTiff tiff;
  tiff.columns = 41;
  tiff.rows = 41;
  for (int k = 0; k < 41 * 41; ++k) tiff.values.push_back(100.0 + (k % 41));
  tiff.crs = "EPSG:32632";
  tiff.transform = {{500000.0, 10.0, 0.0, 5200000.0, 0.0, -10.0}};
  ReadOptions options;
  options.crs = "EPSG:2056";
  const Heightfield field = reload(tiff, options);
  EXPECT_NEAR(field.dx_m, 10.0, 0.2);
  EXPECT_EQ(field.dx_m, field.dy_m);
  const int i = field.columns() / 2, j = field.rows() / 2;
  const double slope =
      (field.heights_m(i + 5, j) - field.heights_m(i - 5, j)) / (10.0 * field.dx_m);
  // The grids are turned by the meridian convergence, 1.2 degrees here: cos = 0.9998; and scaled by
  // 0.9996. Both together stay within 0.1 %; float32 steps at 120 m are 1e-5 m of 10 m.
  EXPECT_NEAR(slope, 0.1, 0.0001);
  EXPECT_TRUE(assumes(field, "GDAL's warper"));
  EXPECT_GT(field.provenance.voids_declared, 0);  // corners of the turned square
}

TEST(GdalPlace, ReprojectionNeedsTwoKnownSystems) {
  GeoTiff tiff = grid(4, 4);
  ReadOptions options;
  options.crs = "EPSG:2056";
  EXPECT_TRUE(contains(refusal(tiff, options), "names no coordinate system"));
  tiff.crs = "EPSG:32632";
  tiff.transform = {{500000.0, 10.0, 0.0, 5200000.0, 0.0, -10.0}};
  options.crs = "EPSG:nonsense";
  EXPECT_TRUE(contains(refusal(tiff, options), "--crs EPSG:nonsense"));
}

}  // namespace
}  // namespace plumb::terrain
