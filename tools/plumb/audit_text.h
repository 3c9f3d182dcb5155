// An audit as tables for a terminal.
#pragma once

#include <string>
#include <vector>

#include "audit/audit.h"
#include "text_table.h"

namespace plumb::tool {

/// Claims, errors and what else was found of one frame, and the verdict.
std::string audit_text(const audit::AuditResult& result);

/// One line of the table of a path's frames, whose columns are frame_columns().
std::vector<std::string> frame_row(std::size_t number, const audit::AuditResult& result);
const std::vector<TextColumn>& frame_columns();

}  // namespace plumb::tool
