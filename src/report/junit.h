// Results as JUnit XML, which test servers read.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plumb::report {

struct JUnitFailure {
  std::string message;  // one line
  std::string text;     // all that there is to say; may be empty
};

/// What was judged. At most one of `failure`, `error` and `skipped` is there; none: it passed.
struct JUnitCase {
  std::string class_name, name;
  std::optional<JUnitFailure> failure{};  // judged, and found wrong
  std::optional<std::string> error{};     // could not be judged, and why
  std::optional<std::string> skipped{};   // was not to be judged, and why
};

struct JUnitSuite {
  std::string name;
  std::vector<JUnitCase> cases;
};

/// One <testsuite> as a file, with its counts. Every time is zero, so that the same results give
/// the same bytes. Throws std::invalid_argument if a case has more than one outcome.
std::string to_junit_xml(const JUnitSuite& suite);

/// Text as an attribute or an element shows it, both: & < > " ' and what a reader would change in
/// an attribute (line ends, tabs) become references. What XML 1.0 cannot hold, control characters
/// and bytes that are not UTF-8, becomes U+FFFD, one a character or byte.
std::string escape_xml(std::string_view text);

}  // namespace plumb::report
