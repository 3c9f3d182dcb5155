// The cheapest of many ways to draw that keeps an error, by what was measured of each.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace plumb::audit::plan {

/// One way to draw one view, measured.
struct Measurement {
  std::size_t view = 0;
  double error = 0.0;         // the largest, in the unit of the error asked for; +inf is legal
  double cost = 0.0;          // >= 0
  double triangles = 0.0;     // decides between equal costs
  bool keeps_claims = false;  // the audit's verdict was no broken one
};

/// A way to draw: method, variant, parameters and tolerance, and what came of it.
struct Candidate {
  std::string name;  // for people; the order of candidates decides between equals
  std::vector<Measurement> measurements;
};

/// What one candidate is worth over a set of views.
struct Worth {
  std::size_t candidate = 0;
  double error = 0.0;      // the largest over the views
  double cost = 0.0;       // mean over the views
  double triangles = 0.0;  // mean
  std::size_t worst_view = 0;
};

struct Choice {
  std::optional<Worth> best;       // nothing: no candidate keeps the error
  std::optional<Worth> runner_up;  // the cheapest of another method or variant: see `family`
  std::optional<Worth> nearest;    // the least error of all, where there is no best
  std::optional<Worth> dearest;    // of those that keep the error
  std::vector<Worth> fitting;      // all that keep the error, the best first
  std::optional<Worth> held_out;   // the best one over the views that were kept out of the search
  std::size_t candidates = 0;      // with a measurement of every view searched
  std::size_t incomplete = 0;      // without
};

struct Search {
  double error = 1.0;                      // that must be kept, > 0
  std::size_t views = 0;                   // numbered from 0
  std::vector<std::size_t> held_out = {};  // not looked at by the search
  bool claims_must_hold = true;            // a candidate that broke a claim is none
  /// For each candidate, what it is a setting of: those of one family differ by tolerance alone, so
  /// that the runner-up is another way to draw and no neighbour of the best.
  std::vector<std::size_t> family = {};
};

/// Of every `every`-th view one, from the last on: those that a search keeps out. None of fewer
/// than three views.
std::vector<std::size_t> views_held_out(std::size_t views, std::size_t every = 4);

/// The candidate of least mean cost whose error keeps the bound in every view that is searched.
///
///   (1) Among equal costs the fewest triangles win, then the earlier candidate.
///   (2) What is measured of held-out views changes no choice.
///   (3) A candidate without a measurement of some searched view is none, whatever the others say.
/// Throws std::invalid_argument if `error` is not above zero, a view is not below `views`, all
/// views are held out, or `family` has another size than `candidates`.
Choice choose(const std::vector<Candidate>& candidates, const Search& search);

}  // namespace plumb::audit::plan
