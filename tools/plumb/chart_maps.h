// Maps of error and cost for some runs of a sweep: each is made again by its own command.
#pragma once

#include <string>
#include <vector>

#include "audit/chart/chart_page.h"

namespace plumb::tool {

/// The runs that `which` means, as rows of the table's runs:
///   "worst"           of each method and variant the run with the largest error
///   "TERRAIN/CAMERA"  of each the run there with the tolerance nearest to 1, by ratio; of a path
///                     the frame with its largest error
///   a key             that run (16 hexadecimal digits)
/// Throws InputError where there is none.
std::vector<std::size_t> runs_for_maps(const audit::chart::RunTable& table,
                                       const std::string& which);

/// Makes the runs again in the folder where this program runs, and keeps their maps in `folder` as
/// map-N-NAME.png. What cannot be made is said in `left_out`.
std::vector<audit::chart::MappedRun> make_maps(const std::string& folder,
                                               const audit::chart::RunTable& table,
                                               const std::vector<std::size_t>& runs,
                                               std::vector<std::string>& files,
                                               std::vector<std::string>& left_out);

}  // namespace plumb::tool
