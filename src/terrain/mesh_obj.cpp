#include "terrain/mesh_obj.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/check.h"
#include "terrain/text_tokens.h"

namespace plumb::terrain {
namespace {

constexpr std::size_t kMostJoinedBytes = std::size_t{1} << 26;

template <class... Args>
[[noreturn]] void fail(const ForwardFile& file, std::int64_t line,
                       fmt::format_string<Args...> message, Args&&... args) {
  input_error("{}: line {}: {}", file.name(), line,
              fmt::format(message, std::forward<Args>(args)...));
}

// Lines without their comments, continued ones joined.
class ObjLines {
 public:
  explicit ObjLines(ForwardFile& file) : file_(file) {}

  bool next(std::string_view& line) {
    if (!file_.read_line(line)) return false;
    number_ = file_.line();
    if (number_ == 1 && line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
    if (!without_comment(line)) return true;
    joined_.assign(line);
    for (bool goes_on = true; goes_on;) {
      if (!file_.read_line(line)) break;
      goes_on = without_comment(line);
      joined_.append(" ").append(line);
      if (joined_.size() > kMostJoinedBytes)
        fail(file_, number_, "it goes on for more than {} bytes", kMostJoinedBytes);
    }
    line = joined_;
    return true;
  }
  std::int64_t number() const { return number_; }  // of the line's first line

 private:
  // Takes comment and backslash away; true if the next line belongs to this one.
  static bool without_comment(std::string_view& line) {
    const std::size_t comment = line.find('#');
    if (comment != line.npos) {
      line = line.substr(0, comment);
      return false;
    }
    if (!line.ends_with('\\')) return false;
    line.remove_suffix(1);
    return true;
  }

  ForwardFile& file_;
  std::string joined_;
  std::int64_t number_ = 0;
};

class ObjReader {
 public:
  explicit ObjReader(ForwardFile& file) : file_(file), lines_(file) {}

  PolygonSoup read() {
    std::string_view rest;
    while (lines_.next(rest)) {
      const std::string_view word = next_token(rest);
      if (word == "v") read_vertex(rest);
      if (word == "f") read_face(rest);
    }
    if (soup_.vertices_m.empty())
      input_error("{}: expected lines 'v X Y Z', there are none", file_.name());
    if (farthest_ >= soup_.vertices_m.size())
      fail(file_, farthest_line_, "expected a vertex of the file, 1 to {}, got {}",
           soup_.vertices_m.size(), farthest_ + 1);
    return std::move(soup_);
  }

 private:
  void read_vertex(std::string_view rest) {
    glm::dvec3 p{0.0};
    for (int axis = 0; axis < 3; ++axis) p[axis] = coordinate(next_token(rest));
    const std::string_view weight = next_token(rest);
    if (!weight.empty() && next_token(rest).empty()) divide(p, weight);
    if (soup_.vertices_m.size() >= kMostVertices)
      fail(file_, lines_.number(), "expected at most {} vertices", kMostVertices);
    soup_.vertices_m.push_back(p);
  }
  double coordinate(std::string_view token) const {
    const auto value = number_in(token);
    if (!value || !std::isfinite(*value))
      fail(file_, lines_.number(), "expected three finite numbers after 'v', got {}",
           token.empty() ? "the line's end" : shown(token));
    return *value;
  }
  void divide(glm::dvec3& p, std::string_view token) const {
    const auto weight = number_in(token);
    if (!weight || !std::isfinite(*weight) || *weight == 0.0 || !std::isfinite(p.x / *weight) ||
        !std::isfinite(p.y / *weight) || !std::isfinite(p.z / *weight))
      fail(file_, lines_.number(),
           "expected as fourth number of a vertex a weight that leaves it finite, got {}",
           shown(token));
    p /= *weight;
  }

  void read_face(std::string_view rest) {
    std::uint32_t size = 0;
    for (std::string_view token = next_token(rest); !token.empty(); token = next_token(rest)) {
      soup_.corners.push_back(corner(token));
      ++size;
    }
    soup_.sizes.push_back(size);
  }
  std::uint32_t corner(std::string_view token) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), number);
    const auto here = static_cast<std::int64_t>(soup_.vertices_m.size());
    if (error != std::errc() || (end != token.data() + token.size() && *end != '/') || number == 0)
      fail(file_, lines_.number(),
           "expected corners of a face (V, V/VT, V//VN or V/VT/VN, from 1 or from -1 backwards), "
           "got {}",
           shown(token));
    if (number < -here || number > static_cast<std::int64_t>(kMostVertices))
      fail(file_, lines_.number(), "expected a vertex, -{} to -1 or 1 to {}, got {}", here, here,
           number);
    const std::int64_t index = number > 0 ? number - 1 : here + number;
    if (static_cast<std::uint64_t>(index) > farthest_ || farthest_line_ == 0) {
      farthest_ = static_cast<std::uint64_t>(index);
      farthest_line_ = lines_.number();
    }
    return static_cast<std::uint32_t>(index);
  }

  ForwardFile& file_;
  ObjLines lines_;
  PolygonSoup soup_;
  std::uint64_t farthest_ = 0;  // index of all corners, and where it first stands
  std::int64_t farthest_line_ = 0;
};

}  // namespace

PolygonSoup read_obj(ForwardFile& file) { return ObjReader(file).read(); }

}  // namespace plumb::terrain
