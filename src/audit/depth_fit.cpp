#include "audit/depth_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "audit/camera_fit.h"
#include "audit/coarse_truth.h"
#include "audit/depth_readings.h"
#include "audit/depth_samples.h"
#include "audit/plan_fit.h"
#include "audit/turned_cameras.h"

namespace plumb::audit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A frame of which less than this share shows terrain, or should, is too little to be refused.
constexpr double kLeastShare = 1.0 / 16.0;
constexpr double kFewPixels = 16.0;     // that show terrain; fewer explain nothing
constexpr double kNoDifference = 1e-6;  // single precision leaves as much
constexpr double kLeastFactor = 0.01;   // of heights: a level plane explains nothing
constexpr double kTellsApart = 0.5;     // of the misfit, between the truth and its turned view
constexpr double kPromised = 0.9;       // of a frame that keeps to the tolerance as it was meant

// What explains the frame best so far.
struct Choice {
  std::string text;
  double mean = kInfinity;
  Plainness plainness = Plainness::OneMistake;
  bool is_slight = false;
};

class FrameFit {
 public:
  FrameFit(const HeightfieldTruth& truth, const HitImage& true_hits,
           const image::DepthBuffer& buffer, const DepthMeaning& meaning, const Camera& camera,
           const Tolerance& tolerance)
      : truth_(truth),
        stated_{meaning, camera, camera},
        tolerance_(tolerance),
        samples_(truth, true_hits, buffer, camera),
        ranges_(samples_.ranges_of(stated_)),
        before_(difference_of(ranges_, samples_.true_depths())) {}

  std::optional<Misfit> misfit() {
    if (before_.pixels == 0 || before_.mean == 0.0) return std::nullopt;
    points_ = samples_.points_of(ranges_);
    fit_ = plan_fit(truth_, points_);
    within_ = samples_.share_within(ranges_, tolerance_);
    coarsest_ = coarsest_misfit();
    look_at_readings();
    const bool most_is_within = within_ >= 0.5;
    // What is fitted explains every small error; it is worth a word only where errors are large.
    if (!most_is_within) look_at_fits();
    if (!best_.text.empty()) {
      return Misfit{fmt::format("the frame fits if {}: depths are then off by {:.3g} % in "
                                "the mean, as stated by {:.3g} %",
                                best_.text, 100.0 * best_.mean, 100.0 * before_.mean),
                    !(best_.is_slight && most_is_within)};
    }
    if (most_is_within || !is_stranger()) return std::nullopt;
    return Misfit{stranger_text(), true};
  }

 private:
  // How many times smaller a reading's misfit must be.
  double needed_for(const DepthReading& reading) const {
    const bool is_fitted =
        reading.plainness == Plainness::Fitted || reading.plainness == Plainness::FittedTwice;
    if (before_.mean <= coarsest_ && (reading.is_slight || is_fitted)) return kFarBetterThanCoarse;
    const bool of_numbers =
        !is_fitted && reading.camera == stated_.camera && reading.seen_by == stated_.camera;
    if (!of_numbers) return kFarBetter;
    const bool is_what_was_promised =
        within_ < 0.5 &&
        samples_.share_within(samples_.ranges_of(reading), tolerance_) >= kPromised;
    return is_what_was_promised ? 1.0 : kFarBetterNumbers;
  }

  void offer(const DepthReading& reading, double mean) {
    if (!(mean * needed_for(reading) <= before_.mean)) return;
    // Plainer ones are offered first.
    const bool goes_before = reading.plainness == best_.plainness || best_.text.empty()
                                 ? mean < best_.mean
                                 : mean * kFarBetter + kNoDifference < best_.mean;
    if (goes_before) best_ = {reading.text, mean, reading.plainness, reading.is_slight};
  }

  void try_reading(const DepthReading& reading) {
    if (best_.mean == 0.0) return;  // none is better
    const DepthDifference now =
        difference_of(samples_.ranges_of(reading), samples_.depths_through(reading.seen_by));
    // A reading in which next to nothing is seen explains nothing.
    const auto seen =
        std::min(static_cast<double>(points_.size()), static_cast<double>(samples_.true_pixels()));
    if (static_cast<double>(now.pixels) < std::max(kFewPixels, 0.5 * seen)) return;
    offer(reading, now.mean);
  }

  // The number that nearly all pixels of the true sky hold, if it is none as stated.
  std::optional<double> cleared_number() const {
    std::vector<float> numbers;
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      const bool sky = !(samples_.true_depths()[k] < kInfinity);
      if (sky && !(ranges_[k] && ranges_[k]->is_sky()))
        numbers.push_back(samples_.number_at(k, stated_.meaning));
    }
    if (static_cast<double>(numbers.size()) < kFewPixels) return std::nullopt;
    std::sort(numbers.begin(), numbers.end());
    const float middle = numbers[numbers.size() / 2];
    const auto [first, last] = std::equal_range(numbers.begin(), numbers.end(), middle);
    const auto same = static_cast<double>(last - first);
    return same >= kPromised * static_cast<double>(numbers.size()) ? std::optional(double{middle})
                                                                   : std::nullopt;
  }

  // Another number for sky, negative depths, or both.
  void look_at_numbers() {
    const auto sky = cleared_number();
    const std::string sky_text =
        sky ? fmt::format("its number for sky is {0:.9g} (--depth-sky {0:.9g})", *sky) : "";
    DepthReading reading = stated_;
    if (sky) {
      reading.meaning.sky = sky;
      reading.text = sky_text;
      try_reading(reading);
    }
    const bool sky_is_told = sky && !std::isinf(*sky);
    if (!sky_is_told) reading.meaning.sky = stated_.meaning.sky;
    for (const DepthConvention convention : {DepthConvention::Linear, DepthConvention::Distance}) {
      reading.meaning.convention = convention;
      reading.meaning.metres_per_unit = -stated_.meaning.metres_per_unit;
      reading.text = fmt::format(
          "its numbers are {} {} (--depth-convention {} --depth-scale {:g}){}",
          reading.meaning.metres_per_unit < 0.0 ? "negative" : "positive",
          convention == DepthConvention::Linear ? "depths" : "distances", name_of(convention),
          reading.meaning.metres_per_unit, sky_is_told ? ", and " + sky_text : "");
      try_reading(reading);
    }
  }

  void look_at_readings() {
    look_at_numbers();
    const std::vector<DepthReading> readings = other_readings(stated_, truth_.field());
    for (const Plainness plainness : {Plainness::OneMistake, Plainness::TwoMistakes}) {
      for (const DepthReading& reading : readings) {
        if (reading.plainness == plainness) try_reading(reading);
      }
    }
  }

  void look_at_fits() {
    for (const DepthConvention convention : {DepthConvention::Linear, DepthConvention::Distance})
      try_unit(convention);
    try_planes(false);
    try_planes(true);
    try_heights();
    try_camera();
  }

  // Another camera not far from the stated one.
  void try_camera() {
    // It goes before a plainer one only if it is better by more than nothing.
    if (best_.plainness != Plainness::FittedTwice && best_.mean <= kNoDifference) return;
    DepthReading reading = stated_;
    reading.camera = reading.seen_by = fitted_camera(samples_, ranges_, stated_.camera);
    reading.plainness = Plainness::FittedTwice;
    reading.text = camera_text(reading.camera, stated_.camera);
    if (!(reading.camera == stated_.camera)) try_reading(reading);
  }

  // Another unit of view depth or distance.
  void try_unit(DepthConvention convention) {
    DepthReading reading = stated_;
    reading.meaning.convention = convention;
    reading.plainness = Plainness::Fitted;
    const DepthRanges ranges = samples_.ranges_of(reading);
    std::vector<double> factors;
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      if (ranges[k] && !ranges[k]->is_sky() && samples_.true_depths()[k] < kInfinity)
        factors.push_back(samples_.true_depths()[k] / ranges[k]->value);
    }
    if (static_cast<double>(factors.size()) < kFewPixels) return;
    const double unit = reading.meaning.metres_per_unit * middle_of(std::move(factors));
    reading.meaning.metres_per_unit = unit;
    const bool other = convention != stated_.meaning.convention;
    reading.text =
        fmt::format("{}its unit is {} (--depth-scale {:.6g})",
                    other ? convention_text(convention) + ", and " : "", unit_text(unit), unit);
    try_reading(reading);
  }

  // Window depth of other near and far planes.
  void try_planes(bool other_rows) {
    DepthReading reading = stated_;
    if (other_rows) reading.meaning.rows_from_bottom = !reading.meaning.rows_from_bottom;
    std::vector<StoredDepth> stored;
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      const float number = samples_.number_at(k, reading.meaning);
      if (samples_.true_depths()[k] < kInfinity)
        stored.push_back({number, samples_.true_depths()[k]});
    }
    if (const auto fitted = reading_of_planes(reading, stored, stated_.meaning))
      try_reading(*fitted);
  }

  // Heights off by a constant or a factor: what is drawn still stands over the right places.
  void try_heights() {
    if (fit_.over_terrain < kFewestPoints || 2 * fit_.over_terrain < fit_.points ||
        !(fit_.off_m > 0.0))
      return;
    DepthReading reading = stated_;
    reading.plainness = Plainness::Fitted;
    reading.seen_by.eye_m.z -= fit_.shift_m;
    reading.text =
        fmt::format("its heights are {:.4g} m too {}, or its camera's eye is as much too {}",
                    std::abs(fit_.shift_m), fit_.shift_m > 0.0 ? "large" : "small",
                    fit_.shift_m > 0.0 ? "high" : "low");
    try_reading(reading);
    if (!(fit_.factor > kLeastFactor && fit_.factor < 1.0 / kLeastFactor)) return;
    // Heights f h + c through a camera are heights h through one whose heights are (z - c) / f.
    reading.seen_by = stated_.camera;
    reading.seen_by.eye_m.z = (reading.seen_by.eye_m.z - fit_.offset_m) / fit_.factor;
    for (glm::dvec3* axis : {&reading.seen_by.right, &reading.seen_by.up, &reading.seen_by.forward})
      axis->z /= fit_.factor;
    reading.plainness = Plainness::FittedTwice;
    reading.text = fmt::format("its heights are the terrain's times {:.6g} plus {:.6g} m",
                               fit_.factor, fit_.offset_m);
    try_reading(reading);
  }

  // Farther from the truth than its own levels of detail through the same camera, or as far as any
  // other ground.
  bool is_stranger() {
    const auto all = static_cast<double>(samples_.size());
    if (static_cast<double>(before_.pixels) < std::max(kFewPixels, kLeastShare * all)) return false;
    other_ground_ = misfit_of_other_ground();
    return points_.empty() || samples_.drawn_difference(ranges_) > coarsest_ ||
           before_.mean >= kChance * other_ground_;
  }

  // The frame's least misfit with other ground: with the terrain as it looks turned or mirrored.
  double misfit_of_other_ground() const {
    double least = kInfinity;
    for (const Camera& camera : turned_cameras(truth_, stated_.camera)) {
      const std::vector<double> turned = samples_.depths_of(truth_, camera);
      // Ground that is the same when it is turned says nothing.
      if (difference_of(exact_ranges(turned), samples_.true_depths()).mean >=
          kTellsApart * before_.mean)
        least = std::min(least, difference_of(ranges_, turned).mean);
    }
    return least;
  }

  // The largest misfit of the terrain's own levels of detail through the stated camera.
  double coarsest_misfit() const {
    double coarsest = 0.0;
    for (const auto& coarse : coarse_truths(truth_)) {
      coarsest = std::max(coarsest, samples_.drawn_difference(exact_ranges(
                                        samples_.depths_of(coarse->truth, stated_.camera))));
    }
    return coarsest;
  }

  std::string stranger_text() const {
    const double all = static_cast<double>(samples_.size());
    std::string text = fmt::format(
        "nothing that is known to go wrong explains the frame, so it is of another camera or "
        "another terrain, or its eye is under the ground that it draws: it shows something in "
        "{:.3g} % of its pixels, the truth in {:.3g} %; {:.3g} % of these keep to {}; depths are "
        "off by {:.3g} % in the mean, those of every {}th sample of the terrain would be by {:.3g} "
        "%",
        100.0 * static_cast<double>(fit_.points) / all,
        100.0 * static_cast<double>(samples_.true_pixels()) / all, 100.0 * within_,
        to_text(tolerance_), 100.0 * before_.mean, kCoarsestStride, 100.0 * coarsest_);
    if (other_ground_ < kInfinity)
      text +=
          fmt::format(", from those of the terrain turned or mirrored the frame's are by {:.3g} %",
                      100.0 * other_ground_);
    return text;
  }

  const HeightfieldTruth& truth_;
  DepthReading stated_;
  Tolerance tolerance_;
  DepthSamples samples_;
  DepthRanges ranges_;  // by the stated reading
  DepthDifference before_;
  std::vector<glm::dvec3> points_;
  PlanFit fit_;
  Choice best_;
  double coarsest_ = 0.0, within_ = 0.0, other_ground_ = kInfinity;
};

}  // namespace

std::optional<Misfit> misfit_of_depth(const HeightfieldTruth& truth, const HitImage& true_hits,
                                      const image::DepthBuffer& buffer, const DepthMeaning& meaning,
                                      const Camera& camera, const Tolerance& tolerance) {
  return FrameFit(truth, true_hits, buffer, meaning, camera, tolerance).misfit();
}

}  // namespace plumb::audit
