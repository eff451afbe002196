#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace foresight {

/// One lidar sample projected into an image.
struct CsvSample {
  int line = 0;           ///< lidar line, from 0
  int beam = 0;           ///< beam within the line, from 0
  double u = 0.0;         ///< pixel column; (0, 0) is the centre of the first pixel
  double v = 0.0;         ///< pixel row
  double depth_mm = 0.0;  ///< along the camera's z axis

  bool operator==(const CsvSample&) const = default;
};

/// Reads `line,beam,u,v,depth_mm` with a header, the columns in any order, further columns ignored.
/// Fails with kIo, or with kBadData naming file:line and the value: a column is missing or named
/// twice, a row is short, a number is garbage or not finite, or line, beam or depth is negative.
Result<std::vector<CsvSample>> ReadCsvSamples(const std::filesystem::path& path);
/// Same, from text; `source` names it in an error.
Result<std::vector<CsvSample>> ParseCsvSamples(std::string_view text, const std::string& source);

/// Numbers survive the round trip exactly.
Status WriteCsvSamples(const std::filesystem::path& path, std::span<const CsvSample> samples);

}  // namespace foresight
