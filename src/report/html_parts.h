// Pieces of HTML that several parts of a page use.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/html_page.h"

namespace plumb::report {

/// <th> for each column, <td> for each cell.
std::string header_cells(const std::vector<Column>& columns);
std::string body_cells(const std::vector<Column>& columns, const std::vector<std::string>& cells);

/// The class of a row, with a space before it; "" for a plain one.
const char* row_class(RowKind kind);

/// The bytes of a PNG file as an address of its own. Throws std::invalid_argument if they are not a
/// PNG's, or (unless width_px is 0) of another size.
std::string png_address(std::span<const std::uint8_t> png, std::string_view name, int width_px = 0,
                        int height_px = 0);

/// The elements that draw live charts, for the end of the body.
std::string live_scripts(const LiveCharts& charts);

/// Throws std::invalid_argument unless the text is made of letters, digits and hyphens.
void require_id(std::string_view id);

}  // namespace plumb::report
