// Tables of text, aligned for people.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace plumb::tool {

struct TextColumn {
  std::string heading;
  bool numeric = false;  // set flush right
};

/// Letters that a UTF-8 text shows (combining marks count as one each).
int letters_in(std::string_view text);

/// Columns two spaces apart, headings first (no line for them if all are empty); no spaces at the
/// ends of lines. Throws std::invalid_argument if a row has not as many cells as there are columns.
std::string text_table(const std::vector<TextColumn>& columns,
                       const std::vector<std::vector<std::string>>& rows);

/// The text's words in lines of at most `width` letters, each with a line end; all but the first
/// begin with `indent` spaces. A longer word has a line of its own. Throws std::invalid_argument
/// unless 0 <= indent < width.
std::string wrapped(std::string_view text, int width, int indent);

/// "part" of "whole" as a bar of at most `width` '#'; anything above zero shows one.
std::string text_bar(double part, double whole, int width);

}  // namespace plumb::tool
