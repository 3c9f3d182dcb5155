#include "image/plane_image.h"

#include <gtest/gtest.h>

#include <bit>
#include <utility>

namespace plumb::image {
namespace {

AovImage drawn() {
  AovImage picture;
  picture.width_px = 3;
  picture.height_px = 2;
  float next = 1.0f;
  for (const Channel& channel : channels()) {
    if (std::string_view(channel.name) == "overdraw") continue;
    for (std::size_t k = 0; k < picture.size(); ++k)
      (picture.*channel.values).push_back(next += 0.25f);
  }
  return picture;
}

TEST(PlaneChecksum, IsThatOfThePictureThatWasDrawn) {
  EXPECT_EQ(raw_checksum(planes_of(drawn())), raw_checksum(drawn()));
}

TEST(PlaneChecksum, KnowsNoOrderOfChannelsAndNoHeader) {
  const std::uint64_t sum = raw_checksum(planes_of(drawn()));
  PlaneImage picture = planes_of(drawn());
  std::swap(picture.planes[0], picture.planes[7]);
  picture.metadata["note"] = 1.0;
  EXPECT_EQ(raw_checksum(picture), sum);
  // Names that plumb does not have go by themselves.
  picture.planes.push_back({"A", std::vector<float>(6, 1.0f)});
  picture.planes.push_back({"velocity.X", std::vector<float>(6, 2.0f)});
  const std::uint64_t more = raw_checksum(picture);
  EXPECT_NE(more, sum);
  std::swap(picture.planes[1], picture.planes.back());
  EXPECT_EQ(raw_checksum(picture), more);
}

TEST(PlaneChecksum, ChangesWithABitANameTheShapeAndTheEncoding) {
  const PlaneImage picture = planes_of(drawn());
  const std::uint64_t sum = raw_checksum(picture);
  PlaneImage bit = picture, name = picture, shape = picture, encoding = picture, bits = picture;
  float& value = bit.planes[3].values[4];
  value = std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) ^ 1u);
  name.planes[0].name = "r";
  std::swap(shape.width_px, shape.height_px);
  encoding.encoding = Encoding::Srgb;
  bits.bits = 16;
  for (const PlaneImage* changed : {&bit, &name, &shape, &encoding})
    EXPECT_NE(raw_checksum(*changed), sum);
  EXPECT_EQ(raw_checksum(bits), sum);
}

}  // namespace
}  // namespace plumb::image
