// What a method promises about the surface that it draws, in terms that an audit can check.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace plumb {

/// What is measured; see docs/algorithms/ground-truth.md.
enum class Measure {
  SampleError,   // largest vertical deviation of the drawn surface from the height samples
  SurfaceError,  // the same between the samples as well, where drawn and true edges cross
  PixelError,    // distance on screen between a drawn point and the truth above or below it
  Coverage,      // holes, overshoots and see-through cracks
  NearestError,  // distance to the nearest point of the other surface, both ways
};

enum class Unit { Metre, Pixel, Count };

enum class Scope { Frame, Patch };

/// "`measure` stays at or below `bound` `unit`s in `scope`."
struct Claim {
  Measure measure = Measure::SampleError;
  double bound = 0.0;  // >= 0; +inf promises nothing
  Unit unit = Unit::Pixel;
  Scope scope = Scope::Frame;
  int patch = -1;            // the patch meant, where scope is Patch
  bool unreachable = false;  // the tolerance asked for cannot be met here; `bound` is what can

  friend bool operator==(const Claim&, const Claim&) = default;
};

/// How far a method may stray: a bound in metres for every sample, or in pixels on the screen.
struct Tolerance {
  double value = 1.0;  // >= 0
  Unit unit = Unit::Pixel;

  friend bool operator==(const Tolerance&, const Tolerance&) = default;
};

const char* name_of(Measure measure);  // "sample-error", "surface-error", "pixel-error",
                                       // "coverage", "nearest-error"
const char* name_of(Unit unit);    // "m", "px", ""
const char* name_of(Scope scope);  // "frame", "patch"

/// "1px", "0.5px", "5m". Throws InputError for anything else, negative or not finite numbers
/// included; its line begins with what the text is `named`.
Tolerance parse_tolerance(const std::string& text, const std::string& named = "tolerance");
std::string to_text(const Tolerance& tolerance);

}  // namespace plumb
