#include "reference/box_tree.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/check.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "reference/embree_version.h"

namespace plumb::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kInfinityF = std::numeric_limits<float>::infinity();
constexpr double kMargin = 1.0 / (1 << 18);     // of the scene's longest side; see the header
constexpr double kSingleUlp = 1.0 / (1 << 22);  // four roundings to single precision

// The next float at or beyond a double, downwards and upwards.
float round_down(double x) {
  const float f = static_cast<float>(x);
  return static_cast<double>(f) > x ? std::nextafter(f, -kInfinityF) : f;
}
float round_up(double x) {
  const float f = static_cast<float>(x);
  return static_cast<double>(f) < x ? std::nextafter(f, kInfinityF) : f;
}

struct BoxSource {
  const std::function<Box(std::uint32_t)>* box_of;
  glm::dvec3 middle;
  double margin;
};

void give_bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& source = *static_cast<const BoxSource*>(arguments->geometryUserPtr);
  const Box box = (*source.box_of)(arguments->primID);
  const glm::dvec3 low = box.low - source.middle - source.margin;
  const glm::dvec3 high = box.high - source.middle + source.margin;
  RTCBounds& bounds = *arguments->bounds_o;
  bounds.lower_x = round_down(low.x);
  bounds.lower_y = round_down(low.y);
  bounds.lower_z = round_down(low.z);
  bounds.upper_x = round_up(high.x);
  bounds.upper_y = round_up(high.y);
  bounds.upper_z = round_up(high.z);
}

// Embree's parameter of a ray is t * scale - start.
struct RayScale {
  double scale, start, margin;
  float limit(double t_max) const { return round_up(t_max * scale - start + margin); }
};

// What travels with rays: Embree hands the context's address back to visit_on_ray.
struct RayWalk {
  EmbreeRayContext context;  // first, so that its address is the walk's
  RayVisitor* visitor;
  std::array<RayScale, BoxTree::kPacket> scales;
};

// Embree may hand out a packet in parts: a ray knows its number.
void visit_on_ray(const RTCIntersectFunctionNArguments* arguments) {
  auto& walk = *reinterpret_cast<RayWalk*>(arguments->context);
  const unsigned count = arguments->N;
  RTCRayN* const rays = RTCRayHitN_RayN(arguments->rayhit, count);
  RTCHitN* const hits = RTCRayHitN_HitN(arguments->rayhit, count);
  for (unsigned k = 0; k < count; ++k) {
    if (arguments->valid[k] == 0) continue;
    const unsigned ray = RTCRayN_id(rays, count, k);
    const float limit =
        walk.scales[ray].limit(walk.visitor->visit(arguments->primID, static_cast<int>(ray)));
    if (!(limit < RTCRayN_tfar(rays, count, k))) continue;
    RTCRayN_tfar(rays, count, k) = limit;
    RTCHitN_geomID(hits, count, k) = arguments->geomID;
    RTCHitN_primID(hits, count, k) = arguments->primID;
  }
}

// Embree's own count of its memory, from any of its threads.
struct MemoryCount {
  std::atomic<std::int64_t> now{0}, peak{0};
};

bool count_memory(void* user, std::ptrdiff_t bytes, bool /*post*/) {
  auto& count = *static_cast<MemoryCount*>(user);
  const std::int64_t now = count.now.fetch_add(bytes) + bytes;
  std::int64_t peak = count.peak.load();
  while (now > peak && !count.peak.compare_exchange_weak(peak, now)) {
  }
  return true;
}

struct BallWalk {
  BallVisitor* visitor;
  double margin;

  // Distances of boxes are rounded relative to themselves; the margin covers the rest.
  float limit(double radius) const { return round_up(radius * (1.0 + kSingleUlp) + margin); }
};

bool visit_on_ball(RTCPointQueryFunctionArguments* arguments) {
  const auto& walk = *static_cast<const BallWalk*>(arguments->userPtr);
  const float limit = walk.limit(walk.visitor->visit(arguments->primID));
  if (!(limit < arguments->query->radius)) return false;
  arguments->query->radius = limit;
  return true;
}

// Cuts [low, high] to where origin + s * direction lies in the box. False if nothing is left.
bool cut_to_box(const glm::dvec3& origin, const glm::dvec3& direction, const Box& box, double& low,
                double& high) {
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) {
      if (origin[axis] < box.low[axis] || origin[axis] > box.high[axis]) return false;
      continue;
    }
    const double a = (box.low[axis] - origin[axis]) / direction[axis];
    const double b = (box.high[axis] - origin[axis]) / direction[axis];
    low = std::max(low, std::min(a, b));
    high = std::min(high, std::max(a, b));
  }
  return low <= high;
}

// Embree takes no notice of names that it does not know.
void require_instruction_set(const std::string& name) {
  for (const char* known : {"", "sse2", "sse4.2", "avx", "avx2", "avx512"}) {
    if (name == known) return;
  }
  throw std::invalid_argument(
      "instruction set must be sse2, sse4.2, avx, avx2, avx512 or empty, got '" + name + "'");
}

double longest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

}  // namespace

struct BoxTree::Scene {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  Box bounds;
  Box entered;  // `bounds` with the margin twice, relative to the middle
  glm::dvec3 middle{0.0};
  double margin = 0.0;
  MemoryCount memory;  // outlives the device, which the destructor's body releases

  Scene() = default;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }

  void check(const char* what) const {
    if (const RTCError error = rtcGetDeviceError(device); error == RTC_ERROR_OUT_OF_MEMORY) {
      input_error("Embree ran out of memory while {}", what);
    } else if (error != RTC_ERROR_NONE) {
      throw std::runtime_error(
          fmt::format("Embree failed while {} (error {})", what, static_cast<int>(error)));
    }
  }

  void place(const Box& all) {
    bounds = all;
    middle = 0.5 * (all.low + all.high);
    margin = kMargin * longest(all.high - all.low);
    if (margin == 0.0) margin = std::numeric_limits<float>::min();
    entered = {all.low - middle - 2.0 * margin, all.high - middle + 2.0 * margin};
  }

  void build(std::uint32_t count, const std::function<Box(std::uint32_t)>& box_of,
             const std::string& instruction_set, TreeBuild how) {
    const std::string config = instruction_set.empty() ? "" : "isa=" + instruction_set;
    device = rtcNewDevice(config.c_str());
    if (!device) throw std::runtime_error("Embree cannot start with '" + config + "'");
    rtcSetDeviceMemoryMonitorFunction(device, count_memory, &memory);
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    if (how == TreeBuild::Quick) rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    BoxSource source{&box_of, middle, margin};
    rtcSetGeometryUserPrimitiveCount(geometry, count);
    rtcSetGeometryUserData(geometry, &source);
    rtcSetGeometryBoundsFunction(geometry, give_bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, visit_on_ray);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcCommitScene(scene);
    rtcSetGeometryUserData(geometry, nullptr);
    rtcReleaseGeometry(geometry);
    check("building a tree");
  }
};

BoxTree::BoxTree(std::uint32_t count, const std::function<Box(std::uint32_t)>& box_of,
                 const std::string& instruction_set, TreeBuild build)
    : scene_(std::make_unique<Scene>()) {
  require_instruction_set(instruction_set);
  if (count == 0) return;
  require_memory(bytes_needed(count), "the tree of boxes");
  const Box all = parallel_ordered_reduce(
      count, 4096, Box{},
      [&](std::int64_t begin, std::int64_t end, Box box) {
        for (std::int64_t k = begin; k < end; ++k) box.add(box_of(static_cast<std::uint32_t>(k)));
        return box;
      },
      [](Box a, const Box& b) {
        a.add(b);
        return a;
      });
  scene_->place(all);
  scene_->build(count, box_of, instruction_set, build);
}

BoxTree::~BoxTree() = default;
BoxTree::BoxTree(BoxTree&&) noexcept = default;
BoxTree& BoxTree::operator=(BoxTree&&) noexcept = default;

const Box& BoxTree::bounds() const { return scene_->bounds; }
std::int64_t BoxTree::peak_bytes() const { return scene_->memory.peak; }
std::int64_t BoxTree::bytes() const { return scene_->memory.now; }

std::optional<BoxTree::Entry> BoxTree::enter(const Ray& ray) const {
  if (!scene_->scene) return std::nullopt;
  const double scale = longest(glm::abs(ray.direction));
  Entry entry;
  entry.direction = ray.direction / scale;
  const glm::dvec3 origin = ray.origin_m - scene_->middle;
  double low = ray.t_min * scale, high = ray.t_max * scale;
  if (!cut_to_box(origin, entry.direction, scene_->entered, low, high)) return std::nullopt;
  entry.origin = origin + low * entry.direction;
  entry.length = high - low + scene_->margin;
  entry.scale = scale;
  entry.start = low;
  return entry;
}

void BoxTree::visit_rays(std::span<const Ray> rays, RayVisitor& visitor) const {
  if (!scene_->scene) return;
  require(rays.size() <= kPacket, "a packet has at most {} rays, got {}", kPacket, rays.size());
  RayWalk walk;
  walk.visitor = &visitor;
  start(walk.context);
  alignas(64) std::array<int, kPacket> valid{};
  alignas(64) RTCRayHit16 query{};
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const std::optional<Entry> entry = enter(rays[k]);
    if (!entry) continue;
    valid[k] = -1;
    walk.scales[k] = {entry->scale, entry->start, scene_->margin};
    query.ray.org_x[k] = static_cast<float>(entry->origin.x);
    query.ray.org_y[k] = static_cast<float>(entry->origin.y);
    query.ray.org_z[k] = static_cast<float>(entry->origin.z);
    query.ray.dir_x[k] = static_cast<float>(entry->direction.x);
    query.ray.dir_y[k] = static_cast<float>(entry->direction.y);
    query.ray.dir_z[k] = static_cast<float>(entry->direction.z);
    query.ray.tfar[k] = round_up(entry->length);
    query.ray.mask[k] = 0xffffffffu;
    query.ray.id[k] = static_cast<unsigned>(k);
    query.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }
  intersect(scene_->scene, walk.context, valid.data(), query);
}

void BoxTree::visit_ball(const glm::dvec3& point, double radius, BallVisitor& visitor) const {
  if (!scene_->scene) return;
  const glm::dvec3 centre = point - scene_->middle;
  BallWalk walk{&visitor, scene_->margin + kSingleUlp * longest(glm::abs(centre))};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  RTCPointQuery query{};
  query.x = static_cast<float>(centre.x);
  query.y = static_cast<float>(centre.y);
  query.z = static_cast<float>(centre.z);
  query.radius = radius < kInfinity ? walk.limit(radius) : kInfinityF;
  rtcPointQuery(scene_->scene, &query, &context, visit_on_ball, &walk);
}

std::int64_t BoxTree::bytes_needed(std::uint32_t count) {
  // Embree 3.13 took 115 to 160 bytes a box; the test BoxTree.NeedsNoMoreMemoryThanItSays holds it.
  return std::int64_t{1 << 20} + std::int64_t{200} * count;
}

}  // namespace plumb::reference
