// The tightest limits that pass what should pass, and what they would catch.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compare/comparison.h"
#include "compare/detection.h"
#include "compare/profile.h"

namespace plumb::compare {

/// What a metric reached over the pairs that should pass, and the limit proposed for it.
struct CalibratedLimit {
  Limit limit;
  double reached = 0.0;
  std::string worst_pair;  // the candidate that reached it; empty if all are equal
  double built_in = 0.0;   // the base profile's limit
  bool measured = false;   // of any pair; else the limit stays as it was
};

struct Calibration {
  Profile proposed;
  std::vector<CalibratedLimit> limits;
  /// Pairs that no limit can pass: a difference with a system, or numbers that are not finite.
  std::vector<std::string> hopeless;
  int pairs = 0;
};

/// Collects pairs that should pass, one after the other.
class Calibrator {
 public:
  /// Its limits are those that are set: "default" if in doubt.
  explicit Calibrator(Profile base);
  void add(const PicturePair& pair);
  /// A limit is what was reached, rounded up to two digits; nothing reached is zero. Throws
  /// InputError without pairs.
  Calibration finish() const;

 private:
  Profile base_;
  Calibration found_;
};

/// The number rounded up to two significant digits (towards the strict side where more is better,
/// so rounded down); 0 stays 0.
double rounded_outwards(double value, bool more_is_better);

}  // namespace plumb::compare
