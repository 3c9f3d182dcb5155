// Frames of generated terrains from several places, and what is found wrong with them.
#pragma once

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "audit/depth_fit.h"
#include "support/stranger_frames.h"

namespace plumb::audit {

using test_support::Ground;
using test_support::ground;
using test_support::written;

struct View {
  const char* preset;
  int width, height;
};
inline const std::vector<View> kViews{{"oblique", 160, 90}, {"top", 61, 37}, {"valley", 97, 121}};
inline const std::vector<const char*> kTerrains{"alpine?seed=7", "canyon?seed=3", "dunes?seed=5"};

inline std::optional<Misfit> misfit(const Ground& there, const image::DepthBuffer& buffer,
                                    const DepthMeaning& meaning, const Camera& camera,
                                    const Tolerance& tolerance = {}) {
  return misfit_of_depth(there.truth, there.truth.caster.cast_frame(camera), buffer, meaning,
                         camera, tolerance);
}

// A frame as it was drawn, and how it is taken.
struct Frame {
  Camera drawn_by;
  DepthMeaning written_as;
};

inline void for_every_view(const std::function<void(const Ground&, const Camera&)>& look,
                           int size = 129) {
  for (const char* generator : kTerrains) {
    const std::string terrain = fmt::format("generate:{}&size={}", generator, size);
    const auto there = ground(terrain);
    for (const View& view : kViews) {
      SCOPED_TRACE(terrain + " " + view.preset);
      look(*there, there->camera(view.preset, view.width, view.height));
    }
  }
}

// Draws through `frame`'s camera, reads as linear depth through `camera`.
inline void expect_named(const Ground& there, const Camera& camera, const Frame& frame,
                         const std::string& words, const DepthMeaning& read_as = {},
                         const Tolerance& tolerance = {}) {
  const image::DepthBuffer buffer =
      written(there.truth.caster.cast_frame(frame.drawn_by), frame.drawn_by, frame.written_as);
  const auto found = misfit(there, buffer, read_as, camera, tolerance);
  ASSERT_TRUE(found) << words;
  EXPECT_TRUE(found->refuses) << found->text;
  EXPECT_NE(found->text.find(words), std::string::npos) << found->text;
  EXPECT_EQ(found->text.find('\n'), std::string::npos);
}

inline constexpr DepthConvention kConventions[] = {
    DepthConvention::Linear, DepthConvention::Distance, DepthConvention::Window,
    DepthConvention::Ndc, DepthConvention::ReverseZ};

}  // namespace plumb::audit
