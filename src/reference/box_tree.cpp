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
#include "reference/tree_place.h"

namespace plumb::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kInfinityF = std::numeric_limits<float>::infinity();

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

// Embree's parameter of a ray is t * scale - ahead.
struct RayScale {
  double scale, ahead;
};

// What travels with rays: Embree hands the context's address back to visit_on_ray.
struct RayWalk {
  EmbreeRayContext context;  // first, so that its address is the walk's
  RayVisitor* visitor;
  std::array<RayScale, BoxTree::kPacket> scales;
};

// A bit for each of at most 32 rays that are marked by -1 and not by 0.
unsigned bits_of(const int* valid, unsigned count) {
  unsigned bits = 0;
  for (unsigned k = 0; k < count; ++k) bits |= (static_cast<unsigned>(valid[k]) & 1u) << k;
  return bits;
}

// Embree may hand out a packet in parts: a ray knows its number.
void visit_on_ray(const RTCIntersectFunctionNArguments* arguments) {
  auto& walk = *reinterpret_cast<RayWalk*>(arguments->context);
  const unsigned count = arguments->N;
  RTCRayN* const rays = RTCRayHitN_RayN(arguments->rayhit, count);
  RTCHitN* const hits = RTCRayHitN_HitN(arguments->rayhit, count);
  for (unsigned left = bits_of(arguments->valid, count); left; left &= left - 1) {
    const auto k = static_cast<unsigned>(__builtin_ctz(left));
    const unsigned ray = RTCRayN_id(rays, count, k);
    const RayScale& scale = walk.scales[ray];
    const double wanted = walk.visitor->visit(arguments->primID, static_cast<int>(ray));
    const float limit = single_beyond(wanted * scale.scale - scale.ahead);
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

// Embree takes no notice of names that it does not know.
void require_instruction_set(const std::string& name) {
  for (const char* known : {"", "sse2", "sse4.2", "avx", "avx2", "avx512"}) {
    if (name == known) return;
  }
  throw std::invalid_argument(
      "instruction set must be sse2, sse4.2, avx, avx2, avx512 or empty, got '" + name + "'");
}

}  // namespace

struct BoxTree::Scene {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  TreePlace place;
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

  void build(std::uint32_t count, const std::function<Box(std::uint32_t)>& box_of,
             const std::string& instruction_set, TreeBuild how) {
    std::string config = instruction_set.empty() ? "" : "isa=" + instruction_set;
#ifdef PLUMB_PLAIN_THREADS
    // The thread sanitizer does not see that committing waits for Embree's threads: what they read
    // of our stack would count as a race with whatever stands there next.
    config += config.empty() ? "threads=1" : ",threads=1";
#endif
    device = rtcNewDevice(config.c_str());
    if (!device) throw std::runtime_error("Embree cannot start with '" + config + "'");
    rtcSetDeviceMemoryMonitorFunction(device, count_memory, &memory);
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    if (how == TreeBuild::Quick) rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    BoxSource source{&box_of, place.middle, place.margin};
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
  scene_->place = TreePlace(all);
  scene_->build(count, box_of, instruction_set, build);
}

BoxTree::~BoxTree() = default;
BoxTree::BoxTree(BoxTree&&) noexcept = default;
BoxTree& BoxTree::operator=(BoxTree&&) noexcept = default;

const Box& BoxTree::bounds() const { return scene_->place.bounds; }
std::int64_t BoxTree::peak_bytes() const { return scene_->memory.peak; }
std::int64_t BoxTree::bytes() const { return scene_->memory.now; }

void BoxTree::visit_rays(std::span<const Ray> rays, RayVisitor& visitor) const {
  if (!scene_->scene) return;
  require(rays.size() <= kPacket, "a packet has at most {} rays, got {}", kPacket, rays.size());
  RayWalk walk;
  walk.visitor = &visitor;
  start(walk.context);
  alignas(64) std::array<int, kPacket> valid{};
  alignas(64) RTCRayHit16 query{};
  for (std::size_t k = 0; k < rays.size(); ++k) {
    TreeEntry entry;
    if (!scene_->place.enter(rays[k], entry)) continue;
    valid[k] = -1;
    walk.scales[k] = {entry.scale, entry.start - scene_->place.margin};
    query.ray.org_x[k] = static_cast<float>(entry.origin.x);
    query.ray.org_y[k] = static_cast<float>(entry.origin.y);
    query.ray.org_z[k] = static_cast<float>(entry.origin.z);
    query.ray.dir_x[k] = static_cast<float>(entry.direction.x);
    query.ray.dir_y[k] = static_cast<float>(entry.direction.y);
    query.ray.dir_z[k] = static_cast<float>(entry.direction.z);
    query.ray.tfar[k] = single_beyond(entry.length);
    query.ray.mask[k] = 0xffffffffu;
    query.ray.id[k] = static_cast<unsigned>(k);
    query.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }
  intersect(scene_->scene, walk.context, valid.data(), query);
}

void BoxTree::visit_ball(const glm::dvec3& point, double radius, BallVisitor& visitor) const {
  if (!scene_->scene) return;
  const glm::dvec3 centre = point - scene_->place.middle;
  BallWalk walk{&visitor, scene_->place.margin + kSingleUlp * TreePlace::longest(glm::abs(centre))};
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
