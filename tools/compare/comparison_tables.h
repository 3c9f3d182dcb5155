// The tables of a comparison's page.
#pragma once

#include <string>
#include <vector>

#include "compare/comparison.h"
#include "report/html_page.h"

namespace plumb::compare {

report::Verdict banner_of(CompareVerdict verdict);

/// Limits, broken ones first, then by what is used of them; those of channels that are not there
/// last.
report::Table limits_table(const Comparison& comparison);
/// All of them in their order, but those of single channels.
report::Table measurements_table(const Comparison& comparison);
/// A row a channel, folded.
report::Table channels_table(const Comparison& comparison);
report::Table systematic_table(const Comparison& comparison);
/// Coverage, numbers that are not finite, mask.
std::vector<report::KeyValue> shape_entries(const Comparison& comparison);
/// Size, encoding, channels, profile, command.
std::vector<report::KeyValue> subject_entries(const Comparison& comparison,
                                              const std::string& command);
/// Each jumps to its pixel in the viewer.
report::OffenderList worst_list(const Comparison& comparison, const std::string& viewer_id);

}  // namespace plumb::compare
