#include "text_table.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace plumb::tool {
namespace {

std::string line_of(const std::vector<TextColumn>& columns, const std::vector<int>& widths,
                    const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto gap = static_cast<std::size_t>(widths[i] - letters_in(cells[i]));
    if (i > 0) line += "  ";
    if (columns[i].numeric) line.append(gap, ' ');
    line += cells[i];
    if (!columns[i].numeric) line.append(gap, ' ');
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

}  // namespace

int letters_in(std::string_view text) {
  return static_cast<int>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;  // not the rest of a longer letter
  }));
}

std::string text_table(const std::vector<TextColumn>& columns,
                       const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::string> headings;
  std::vector<int> widths;
  for (const TextColumn& column : columns) {
    headings.push_back(column.heading);
    widths.push_back(letters_in(column.heading));
  }
  for (const std::vector<std::string>& row : rows) {
    require(row.size() == columns.size(), "a row needs {} cells, got {}", columns.size(),
            row.size());
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], letters_in(row[i]));
  }
  std::string table;
  const bool named = std::any_of(headings.begin(), headings.end(),
                                 [](const std::string& heading) { return !heading.empty(); });
  if (named) table += line_of(columns, widths, headings);
  for (const std::vector<std::string>& row : rows) table += line_of(columns, widths, row);
  return table;
}

std::string wrapped(std::string_view text, int width, int indent) {
  require(indent >= 0 && indent < width, "an indent must lie in [0, {}), got {}", width, indent);
  std::string lines, line;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (word.empty()) continue;
    const bool begins = line.find_first_not_of(' ') == std::string::npos;
    if (!begins && letters_in(line) + 1 + letters_in(word) > width) {
      lines += line + "\n";
      line.assign(static_cast<std::size_t>(indent), ' ');
      line += word;
    } else {
      line += (begins ? "" : " ") + std::string(word);
    }
  }
  return line.empty() ? lines : lines + line + "\n";
}

std::string text_bar(double part, double whole, int width) {
  if (!(part > 0.0) || !(whole > 0.0)) return "";
  const int length = static_cast<int>(std::floor(part / whole * width + 0.5));
  return std::string(static_cast<std::size_t>(std::clamp(length, 1, width)), '#');
}

}  // namespace plumb::tool
