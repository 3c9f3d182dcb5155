#include "compare/diagnosis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "compare/alignment.h"
#include "compare/value_models.h"
#include "core/parallel.h"
#include "image/camera_metadata.h"
#include "image/srgb.h"
#include "support/random_scene.h"

namespace plumb::compare {
namespace {

using image::Encoding;
using image::PlaneImage;
using test_support::Random;

constexpr int kWidth = 160, kHeight = 90;

// A landscape of ridges before a sky, sampled at points: what a renderer without filtering draws.
double brightness(double x, double y) {
  const double ridge = 30.0 + 8.0 * std::sin(0.07 * x) + 3.0 * std::sin(0.31 * x + 1.0);
  if (y < ridge) return 0.85;
  const double slopes = std::sin(0.45 * x + 0.2 * y) + std::sin(0.13 * x - 0.4 * y + 2.0) +
                        0.7 * std::sin(0.9 * x + 0.7 * y + 0.5) + 0.5 * std::sin(1.3 * y - 0.6 * x);
  return 0.4 + 0.09 * slopes;
}

// The picture whose pixel centres lie at scale * (p - middle) + middle + by.
PlaneImage picture(const glm::dvec2& by = glm::dvec2(0.0), double scale = 1.0) {
  PlaneImage result{kWidth, kHeight, Encoding::Srgb, 8, {}, {}};
  const glm::dvec2 middle(0.5 * kWidth, 0.5 * kHeight);
  for (const char* name : {"R", "G", "B"}) {
    const double share = name[0] == 'R' ? 1.0 : name[0] == 'G' ? 0.9 : 0.7;
    image::Plane plane{name, {}};
    for (int j = 0; j < kHeight; ++j) {
      for (int i = 0; i < kWidth; ++i) {
        const glm::dvec2 p = scale * (glm::dvec2(i + 0.5, j + 0.5) - middle) + middle + by;
        plane.values.push_back(
            static_cast<float>(std::round(255.0 * share * brightness(p.x, p.y)) / 255.0));
      }
    }
    result.planes.push_back(std::move(plane));
  }
  return result;
}

PlaneImage changed(PlaneImage image, const std::function<double(double)>& change) {
  for (image::Plane& plane : image.planes) {
    for (float& value : plane.values) {
      value = static_cast<float>(std::round(255.0 * std::clamp(change(value), 0.0, 1.0)) / 255.0);
    }
  }
  return image;
}

// The first finding's kind; nothing if there is none.
std::optional<Systematic> found(const PlaneImage& reference, const PlaneImage& candidate) {
  const std::vector<Diagnosis> all = diagnose(reference, candidate);
  if (all.empty()) return std::nullopt;
  return all.front().kind;
}

TEST(Diagnosis, NamesWhatWasDoneToEveryNumber) {
  const PlaneImage reference = picture();
  EXPECT_EQ(found(reference, changed(reference, [](double x) { return x + 0.05; })),
            Systematic::Offset);
  EXPECT_EQ(found(reference, changed(reference, [](double x) { return 1.1 * x; })),
            Systematic::Gain);
  EXPECT_EQ(found(reference, changed(reference, [](double x) { return std::pow(x, 1.8); })),
            Systematic::Gamma);
  EXPECT_EQ(found(reference, changed(reference, [](double x) { return image::srgb_to_linear(x); })),
            Systematic::LinearAsSrgb);
  EXPECT_EQ(found(reference, changed(reference, [](double x) { return linear_to_srgb(x); })),
            Systematic::SrgbAsLinear);
}

TEST(Diagnosis, NamesWhereThePictureWent) {
  const PlaneImage reference = picture();
  PlaneImage upside_down = reference, mirrored = reference;
  for (std::size_t plane = 0; plane < 3; ++plane) {
    for (std::size_t k = 0; k < reference.size(); ++k) {
      const std::size_t row = k / kWidth, column = k % kWidth;
      const std::vector<float>& from = reference.planes[plane].values;
      upside_down.planes[plane].values[k] = from[(kHeight - 1 - row) * kWidth + column];
      mirrored.planes[plane].values[k] = from[row * kWidth + kWidth - 1 - column];
    }
  }
  EXPECT_EQ(found(reference, upside_down), Systematic::FlippedY);
  EXPECT_EQ(found(reference, mirrored), Systematic::FlippedX);
  // Pixel p shows what stood at p + by: the candidate is moved by -by.
  for (const glm::dvec2 by :
       {glm::dvec2(0.5, 0.5), glm::dvec2(-0.5, 0.0), glm::dvec2(0.0, 1.0), glm::dvec2(-2.0, 3.0),
        glm::dvec2(0.45, 0.0), glm::dvec2(6.0, -5.0)}) {
    const std::vector<Diagnosis> all = diagnose(reference, picture(by));
    ASSERT_FALSE(all.empty()) << by.x << ", " << by.y;
    EXPECT_EQ(all.front().kind, Systematic::Shift);
  }
  // As much as samplers may be apart.
  EXPECT_TRUE(diagnose(reference, picture(glm::dvec2(0.2, -0.2))).empty());
  const double aspect = static_cast<double>(kWidth) / kHeight;
  EXPECT_EQ(found(reference, picture(glm::dvec2(0.0), aspect)), Systematic::FieldOfViewAxis);
  EXPECT_EQ(found(reference, picture(glm::dvec2(0.0), 1.0 / aspect)), Systematic::FieldOfViewAxis);
}

TEST(Diagnosis, SaysByHowMuch) {
  const PlaneImage reference = picture();
  const Shift shift = find_shift(luma_of(reference), luma_of(picture({0.5, -1.0})));
  // Point samples of waves of four pixels and more, moved by straight lines between them: a tenth.
  EXPECT_NEAR(shift.by_px.x, -0.5, 0.1);
  EXPECT_NEAR(shift.by_px.y, 1.0, 0.1);
  const auto gain = diagnose(reference, changed(reference, [](double x) { return 0.8 * x; }));
  EXPECT_NE(gain.front().text.find("0.8"), std::string::npos) << gain.front().text;
}

TEST(Diagnosis, NamesNothingWhereThereIsNoSystem) {
  const PlaneImage reference = picture();
  EXPECT_FALSE(found(reference, reference));
  Random random(3);
  PlaneImage noisy = reference, cracked = reference;
  for (image::Plane& plane : noisy.planes) {
    for (float& value : plane.values) value += static_cast<float>(random.integer(-1, 1)) / 255.0f;
  }
  EXPECT_FALSE(found(reference, noisy));
  for (image::Plane& plane : cracked.planes) {
    for (int x = 40; x < 100; ++x) plane.values[static_cast<std::size_t>(70 * kWidth + x)] = 0.85f;
  }
  EXPECT_FALSE(found(reference, cracked));
  EXPECT_FALSE(found(reference, picture({0.1, 0.0})));
  EXPECT_FALSE(found(reference, picture({0.07, -0.07})));
}

// Depths of a plain that runs to a horizon, before a sky.
PlaneImage depths(const std::function<double(double z, double length)>& change) {
  Camera camera;
  camera.gamma_h = camera.gamma_v = 90.0;
  camera.centre_px = {0.5 * kWidth, 0.5 * kHeight};
  camera.width_px = kWidth;
  camera.height_px = kHeight;
  PlaneImage result{kWidth, kHeight, Encoding::Linear, 0, {}, {}};
  image::add_camera(camera, result.metadata);
  image::Plane plane{"Z", {}};
  for (int j = 0; j < kHeight; ++j) {
    for (int i = 0; i < kWidth; ++i) {
      const double down = (j + 0.5 - 30.0) / 90.0;
      const double z = down > 0.01 ? 5.0 / down + 3.0 * std::sin(0.2 * i) : -1.0;
      const glm::dvec2 side = (glm::dvec2(i + 0.5, j + 0.5) - camera.centre_px) / 90.0;
      const double length = std::sqrt(1.0 + side.x * side.x + side.y * side.y);
      plane.values.push_back(z > 0.0 ? static_cast<float>(change(z, length))
                                     : std::numeric_limits<float>::infinity());
    }
  }
  result.planes.push_back(std::move(plane));
  return result;
}

TEST(Diagnosis, NamesConventionsOfDepth) {
  const PlaneImage reference = depths([](double z, double) { return z; });
  EXPECT_FALSE(found(reference, reference));
  // Near 1 m, far 1000 m.
  EXPECT_EQ(found(reference,
                  depths([](double z, double) { return 1000.0 / 999.0 - 1000.0 / 999.0 / z; })),
            Systematic::WindowDepth);
  EXPECT_EQ(found(reference, depths([](double z, double) { return 1.0 / z; })),
            Systematic::WindowDepth);
  EXPECT_EQ(found(reference, depths([](double z, double) { return 100.0 * z; })),
            Systematic::DepthScale);
  EXPECT_EQ(found(reference, depths([](double z, double length) { return z * length; })),
            Systematic::DistanceAsDepth);
  Random random(4);
  EXPECT_FALSE(found(reference, depths([&](double z, double) {
                       return z * (1.0 + 1e-4 * random.uniform(-1.0, 1.0));
                     })));
}

TEST(Diagnosis, SameBitsOnAnyNumberOfThreads) {
  const PlaneImage reference = picture(), moved = picture({0.5, 0.25});
  const std::vector<Diagnosis> all = diagnose(reference, moved);
  for (const int threads : {1, 7}) {
    const ThreadLimit limit(threads);
    const std::vector<Diagnosis> again = diagnose(reference, moved);
    ASSERT_EQ(again.size(), all.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
      EXPECT_EQ(again[k].text, all[k].text);
      EXPECT_EQ(again[k].rms_after, all[k].rms_after);
    }
  }
}

}  // namespace
}  // namespace plumb::compare
