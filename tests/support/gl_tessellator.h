// The tessellation stage of Mesa's software driver, read back by transform feedback.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "support/software_gl.h"

namespace plumb::test_support {

enum class GlSpacing { Equal, FractionalOdd, FractionalEven };

/// gl_TessCoord.xy, in the order in which the stage gives them.
struct GlTessellation {
  std::vector<std::array<float, 2>> points;   // each once (`point_mode`)
  std::vector<std::array<float, 2>> corners;  // three a triangle
};

/// Tessellates patches of the quad domain, `ccw`. The context must outlive it.
class GlTessellator {
 public:
  explicit GlTessellator(const SoftwareGl& context);
  ~GlTessellator();
  GlTessellator(const GlTessellator&) = delete;
  GlTessellator& operator=(const GlTessellator&) = delete;

  /// outer, inner as gl_TessLevelOuter and gl_TessLevelInner. One patch a draw: Mesa goes wrong,
  /// without an error, where a draw evaluates 65,536 vertices or more.
  GlTessellation tessellate(GlSpacing spacing, const std::array<float, 4>& outer,
                            const std::array<float, 2>& inner);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace plumb::test_support
