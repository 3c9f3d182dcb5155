#include "reference/box_tree.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/check.h"
#include "core/parallel.h"
#include "support/random_scene.h"

namespace plumb::reference {
namespace {

using test_support::Random;

class Collector final : public BallVisitor, public RayVisitor {
 public:
  explicit Collector(double limit) : limit_(limit) {}
  double visit(std::uint32_t primitive, int /*ray*/) override { return visit(primitive); }
  double visit(std::uint32_t primitive) override {
    seen.insert(primitive);
    return limit_;
  }
  std::set<std::uint32_t> seen;

 private:
  double limit_;
};

constexpr double kFar = 1e30;

std::vector<Box> random_boxes(Random& random, int count, double scene_m, double size_m) {
  std::vector<Box> boxes;
  for (int k = 0; k < count; ++k) {
    const auto coordinate = [&] { return random.uniform(0.0, scene_m); };
    const glm::dvec3 low{coordinate(), coordinate(), coordinate()};
    boxes.push_back({low, low + random.uniform(0.0, size_m)});
  }
  return boxes;
}

BoxTree tree_of(const std::vector<Box>& boxes) {
  return BoxTree(static_cast<std::uint32_t>(boxes.size()),
                 [&](std::uint32_t k) { return boxes[k]; });
}

// A 160 km scene whose boxes are points: a ray aimed at one in double meets it, and only a margin
// lets single precision see that.
TEST(BoxTree, LosesNoPointThatARayIsAimedAt) {
  Random random(1);
  const std::vector<Box> points = random_boxes(random, 500, 160e3, 0.0);
  const BoxTree tree = tree_of(points);
  for (int k = 0; k < 20000; ++k) {
    const auto aimed_at = static_cast<std::uint32_t>(random.integer(0, 499));
    const double reach = random.chance(0.5) ? 160e3 : 1e7;
    Ray ray;
    ray.origin_m = {random.uniform(-reach, reach), random.uniform(-reach, reach),
                    random.uniform(-reach, reach)};
    const glm::dvec3 apart = points[aimed_at].low - ray.origin_m;
    ray.direction = apart * random.uniform(1e-6, 2.0);
    Collector collector(kFar);
    tree.visit_rays(std::span(&ray, 1), collector);
    ASSERT_EQ(collector.seen.count(aimed_at), 1u) << "ray " << k;
  }
}

TEST(BoxTree, LosesNoPointOnAxisParallelRays) {
  Random random(2);
  const std::vector<Box> points = random_boxes(random, 200, 5e4, 0.0);
  const BoxTree tree = tree_of(points);
  for (std::uint32_t k = 0; k < 200; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      Ray ray;
      ray.direction = glm::dvec3(0.0);
      ray.direction[axis] = k % 2 == 0 ? 1.0 : -3.0;
      ray.origin_m = points[k].low - 2e5 * ray.direction;
      Collector collector(kFar);
      tree.visit_rays(std::span(&ray, 1), collector);
      ASSERT_EQ(collector.seen.count(k), 1u) << k << " along " << axis;
    }
  }
}

// The visitor's limit ends the walk: with every box on one line and a limit before the second, few
// of a thousand are visited, and the first always.
TEST(BoxTree, StopsBehindTheLimitThatTheVisitorGives) {
  std::vector<Box> boxes;
  for (int k = 0; k < 1000; ++k) {
    boxes.push_back({{k, -0.1, -0.1}, {k + 0.1, 0.1, 0.1}});
  }
  const BoxTree tree = tree_of(boxes);
  Ray ray;
  ray.origin_m = {-10.0, 0.0, 0.0};
  ray.direction = {2.0, 0.0, 0.0};
  Collector all(kFar), first(5.05);
  tree.visit_rays(std::span(&ray, 1), all);
  tree.visit_rays(std::span(&ray, 1), first);
  EXPECT_EQ(all.seen.size(), 1000u);
  EXPECT_EQ(first.seen.count(0), 1u);
  EXPECT_LT(first.seen.size(), 64u);
}

// Whoever breaks ties needs all of them: a thousand boxes at one place, and a limit that is their
// t.
TEST(BoxTree, VisitsWhatLiesExactlyAtTheLimit) {
  Random random(5);
  for (int scene = 0; scene < 20; ++scene) {
    std::vector<Box> boxes = random_boxes(random, 1000, 160e3, 0.0);
    for (int k = 100; k < 300; ++k) boxes[static_cast<std::size_t>(k)] = boxes[100];
    const BoxTree tree = tree_of(boxes);
    Ray ray;
    ray.origin_m = {random.uniform(-2e5, 2e5), random.uniform(-2e5, 2e5), 1e5};
    const double t = random.uniform(1e-4, 1e4);
    ray.direction = (boxes[100].low - ray.origin_m) / t;
    Collector collector(t);
    tree.visit_rays(std::span(&ray, 1), collector);
    const glm::dvec3 apart = boxes[100].low - ray.origin_m;
    Collector at_distance(std::sqrt(glm::dot(apart, apart)));
    tree.visit_ball(ray.origin_m, 1e9, at_distance);
    for (std::uint32_t k = 100; k < 300; ++k) {
      ASSERT_EQ(collector.seen.count(k), 1u);
      ASSERT_EQ(at_distance.seen.count(k), 1u);
    }
  }
}

TEST(BoxTree, VisitsNothingOutsideTheRaysOwnRange) {
  const BoxTree tree = tree_of({{{0.0, -1.0, -1.0}, {1.0, 1.0, 1.0}}});
  Ray ray;
  ray.origin_m = {-10.0, 0.0, 0.0};
  ray.direction = {1.0, 0.0, 0.0};
  ray.t_max = 9.0;
  Collector before(kFar), behind(kFar), within(kFar);
  tree.visit_rays(std::span(&ray, 1), before);
  ray.t_min = 12.0;
  ray.t_max = 20.0;
  tree.visit_rays(std::span(&ray, 1), behind);
  ray.t_min = 10.5;
  ray.t_max = 10.6;
  tree.visit_rays(std::span(&ray, 1), within);
  EXPECT_TRUE(before.seen.empty());
  EXPECT_TRUE(behind.seen.empty());
  EXPECT_EQ(within.seen.size(), 1u);
}

TEST(BoxTree, VisitsEveryBoxThatABallTouches) {
  Random random(3);
  const std::vector<Box> boxes = random_boxes(random, 400, 1e4, 100.0);
  const BoxTree tree = tree_of(boxes);
  for (int k = 0; k < 2000; ++k) {
    const double reach = random.chance(0.5) ? 1e4 : 1e8;
    const glm::dvec3 point{random.uniform(-reach, reach), random.uniform(-reach, reach),
                           random.uniform(-reach, reach)};
    const auto aimed_at = static_cast<std::uint32_t>(random.integer(0, 399));
    const glm::dvec3 apart = glm::clamp(point, boxes[aimed_at].low, boxes[aimed_at].high) - point;
    const double distance = std::sqrt(glm::dot(apart, apart));
    Collector collector(kFar);
    tree.visit_ball(point, distance, collector);
    ASSERT_EQ(collector.seen.count(aimed_at), 1u) << k;
  }
}

TEST(BoxTree, OfNoBoxesVisitsNothing) {
  const BoxTree tree(0, [](std::uint32_t) { return Box{}; });
  Collector collector(kFar);
  const Ray ray;
  tree.visit_rays(std::span(&ray, 1), collector);
  tree.visit_ball(glm::dvec3(0.0), 1.0, collector);
  EXPECT_TRUE(collector.seen.empty());
  EXPECT_TRUE(tree.bounds().empty());
}

TEST(BoxTree, NeedsNoMoreMemoryThanItSays) {
  Random random(4);
  std::vector<int> counts{1, 10, 1000, 30000, 300000};
#ifdef PLUMB_PLAIN_THREADS
  counts.pop_back();  // a quarter of an hour under the thread sanitizer
#endif
  for (const int count : counts) {
    const std::vector<Box> boxes = random_boxes(random, count, 1e4, 10.0);
    const BoxTree tree = tree_of(boxes);
    EXPECT_LE(tree.peak_bytes(), BoxTree::bytes_needed(static_cast<std::uint32_t>(count)))
        << count << " boxes, of which " << tree.bytes() << " bytes are kept";
    RecordProperty("peak_bytes_of_" + std::to_string(count), std::to_string(tree.peak_bytes()));
  }
}

TEST(BoxTree, RefusesWhatDoesNotFitBeforeWork) {
  // 0.7 TB of boxes that are never asked for.
  const auto never = [](std::uint32_t) -> Box { throw std::logic_error("asked for a box"); };
  try {
    BoxTree tree(4'000'000'000u, never);
    FAIL() << "nothing was refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("needs 8000"), std::string::npos) << error.what();
  }
}

TEST(BoxTree, RefusesAnInstructionSetThatIsNone) {
  EXPECT_THROW(BoxTree(
                   1,
                   [](std::uint32_t) {
                     return Box{{0, 0, 0}, {1, 1, 1}};
                   },
                   "mmx"),
               std::invalid_argument);
}

}  // namespace
}  // namespace plumb::reference
