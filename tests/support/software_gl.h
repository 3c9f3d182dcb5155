// Mesa's software rasteriser (llvmpipe), headless: another renderer's opinion of coverage.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace plumb::test_support {

/// A corner in the window, y downwards; drawn with perspective depth one.
struct WindowCorner {
  float x_px, y_px;
  float depth;  // 0 (nearest) .. 1, where the depth test is on
};

/// An OpenGL 4.5 context without a display. One at a time.
class SoftwareGl {
 public:
  /// Null, with the reason, where there is no such driver.
  static std::unique_ptr<SoftwareGl> create(std::string& why_not);
  ~SoftwareGl();
  SoftwareGl(const SoftwareGl&) = delete;
  SoftwareGl& operator=(const SoftwareGl&) = delete;

  std::string renderer() const;

  /// Loads a mesh: corners, and three indices a triangle.
  void load(std::span<const WindowCorner> corners, std::span<const std::uint32_t> indices);
  /// Draws it into width x height pixels (powers of two keep window coordinates exact) and returns
  /// each pixel's triangle plus one, row by row from the top; 0 where there is none. Without the
  /// depth test the last triangle wins. The fill rule is top-left.
  std::vector<std::uint32_t> draw(int width_px, int height_px, bool depth_test);

 private:
  SoftwareGl() = default;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace plumb::test_support
