// A tree of boxes that loses none: what a ray or a ball may meet.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "core/box.h"
#include "reference/ray.h"

namespace plumb::reference {

/// Told which primitives a ball may meet.
class BallVisitor {
 public:
  virtual ~BallVisitor() = default;
  /// Returns the radius beyond which nothing is wanted from now on. Must not throw.
  virtual double visit(std::uint32_t primitive) = 0;
};

/// Told which primitives may be met by which ray of a packet.
class RayVisitor {
 public:
  virtual ~RayVisitor() = default;
  /// Returns the t beyond which nothing is wanted for that ray from now on. Must not throw.
  virtual double visit(std::uint32_t primitive, int ray) = 0;
};

/// How much work goes into a tree: a quick one suits few questions, each of which costs more.
enum class TreeBuild { Careful, Quick };

/// Embree's tree of boxes, in single precision, with a margin that makes its answers safe for
/// arithmetic in double.
///
///   (1) Every primitive whose box meets the ray at some t in [t_min, t_max], t_max as the visitor
///       last gave it, is visited; so is every one whose box meets the ball.
///   (2) Others may be visited as well. Which, and in what order, depends on the processor: a
///       visitor's result must not.
///
/// Rounding a point of the scene to single precision moves it by 2^-24 of its distance from the
/// scene's middle, rounding a direction moves the ray's points by 2^-24 of their distance from its
/// start, and the tests of the boxes round a few times more. Rays start where they enter the
/// scene's box, computed in double, so that no distance is longer than the box; each box is
/// widened by 2^-18 of the scene's longest side, which is 64 roundings.
class BoxTree {
 public:
  /// box_of(k), k < count, is called from several threads, and not after the constructor returns;
  /// boxes are finite and not empty. `instruction_set` is "" for the best there is, or one of
  /// Embree's: "sse2", "sse4.2", "avx", "avx2", "avx512".
  /// Throws InputError if the tree cannot fit into memory, std::invalid_argument for another
  /// instruction set, std::runtime_error if Embree fails.
  BoxTree(std::uint32_t count, const std::function<Box(std::uint32_t)>& box_of,
          const std::string& instruction_set = {}, TreeBuild build = TreeBuild::Careful);
  ~BoxTree();
  BoxTree(BoxTree&&) noexcept;
  BoxTree& operator=(BoxTree&&) noexcept;

  /// Up to kPacket rays, best if they go much the same way. They are in the boxes' coordinates;
  /// finite, their directions not zero.
  void visit_rays(std::span<const Ray> rays, RayVisitor& visitor) const;
  static constexpr int kPacket = 16;
  /// radius >= 0, may be infinite; the point is finite.
  void visit_ball(const glm::dvec3& point, double radius, BallVisitor& visitor) const;

  /// Around all boxes; empty if there are none.
  const Box& bounds() const;

  /// More than the bytes that building a tree takes: what the constructor asks for.
  static std::int64_t bytes_needed(std::uint32_t count);
  /// Bytes that Embree held at most while building, and holds now.
  std::int64_t peak_bytes() const;
  std::int64_t bytes() const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace plumb::reference
