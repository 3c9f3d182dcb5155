// Words for a POSIX shell.
#pragma once

#include <string>
#include <vector>

namespace plumb {

/// The word as a shell must be given it: in quotes, unless it needs none.
std::string shell_quoted(const std::string& word);

/// The words as a line, with blanks between.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace plumb
