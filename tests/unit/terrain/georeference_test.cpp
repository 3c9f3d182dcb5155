#include "terrain/georeference.h"

#include <gtest/gtest.h>

#include "core/check.h"

namespace plumb::terrain {
namespace {

// Published for WGS 84: 110,574 m and 111,320 m at the equator, 111,694 m at the poles.
TEST(MetresPerDegree, AreThoseOfTheEllipsoid) {
  EXPECT_NEAR(metres_per_degree(0.0).north, 110574.3, 0.1);
  EXPECT_NEAR(metres_per_degree(0.0).east, 111319.5, 0.1);
  EXPECT_NEAR(metres_per_degree(90.0).north, 111693.9, 0.1);
  EXPECT_EQ(metres_per_degree(90.0).east, 0.0);
  EXPECT_NEAR(metres_per_degree(60.0).east, 55800.0, 1.0);
}

TEST(MetresPerDegree, AreTheSameNorthAndSouth) {
  EXPECT_EQ(metres_per_degree(-35.5).east, metres_per_degree(35.5).east);
  EXPECT_EQ(metres_per_degree(-35.5).north, metres_per_degree(35.5).north);
}

TEST(MetresPerDegree, OfASphereAreEverywhereTheSameNorth) {
  const double moon = 1737400.0;
  EXPECT_NEAR(metres_per_degree(0.0, moon, 0.0).north, 30323.0, 1.0);
  EXPECT_DOUBLE_EQ(metres_per_degree(70.0, moon, 0.0).north,
                   metres_per_degree(0.0, moon, 0.0).north);
}

TEST(Units, KnownOnesAreMetresAndUnknownOnesZero) {
  EXPECT_EQ(metres_in_unit(""), 1.0);
  EXPECT_EQ(metres_in_unit("Metre"), 1.0);
  EXPECT_EQ(metres_in_unit("feet"), 0.3048);
  EXPECT_EQ(metres_in_unit("US survey foot"), 1200.0 / 3937.0);
  EXPECT_EQ(metres_in_unit("us-ft"), 1200.0 / 3937.0);
  EXPECT_EQ(metres_in_unit("dm"), 0.1);
  EXPECT_EQ(metres_in_unit("furlong"), 0.0);
}

// With the south pole at the centre, a degree eastwards has no length.
TEST(Place, ATerrainAroundAPoleCannotBeFlattenedSo) {
  FileGeoreference g;
  g.has_transform = true;
  g.frame = Frame::Geographic;
  g.transform = {0.0, 1.0, 0.0, -89.0, 0.0, -1.0};
  EXPECT_THROW(place(g, {0, 0, 2, 2}, {}, "pole.tif"), InputError);
}

TEST(Place, TheCentreIsThatOfTheWindow) {
  FileGeoreference g;
  g.has_transform = true;
  g.frame = Frame::Geographic;
  g.transform = {0.0, 1.0, 0.0, 90.5, 0.0, -1.0};  // rows stand at 90, 89, ..., degrees north
  const Placement placement = place(g, {0, 29, 3, 3}, {}, "globe.tif");  // 61, 60, 59
  EXPECT_EQ(placement.dx_m, metres_per_degree(60.0).east);
}

}  // namespace
}  // namespace plumb::terrain
