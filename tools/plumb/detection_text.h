// The outcome of `plumb compare --calibrate` and `--detection`, for people and programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/calibration.h"
#include "compare/detection.h"

namespace plumb::tool {

struct NamedTable {
  std::string name;
  compare::DetectionTable table;
};

struct DetectionOutcome {
  std::optional<compare::Calibration> calibration;  // if limits were to be proposed
  std::vector<NamedTable> tables;

  /// Every defect is caught, nothing harmless is, and every pair can be passed.
  bool good() const;
};

std::string detection_text(const DetectionOutcome& outcome);
std::string detection_json(const DetectionOutcome& outcome, const std::string& command_line);

}  // namespace plumb::tool
