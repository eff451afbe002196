#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/calibration/calibrate_chain.h"
#include "core/report/html_report.h"

namespace foresight {

/// One value of a calibration, as we and as the paper's sequence find it from the same session.
struct ComparedValue {
  std::string name;
  std::string unit;  ///< "px", "deg", "mm", "ms", "s" or ""
  double ours = 0.0;
  double sigma = 0.0;  ///< of ours; NaN = not known
  double paper = 0.0;  ///< NaN = the paper's sequence does not have it
};

/// The joint calibration beside Section III-B as printed. Directions and places do not depend on
/// the gauge; angles of directions are against ours.
std::vector<ComparedValue> CompareWithPaper(const ChainCalibration& ours,
                                            const ChainCalibration& paper);

nlohmann::ordered_json ToJson(const std::vector<ComparedValue>& values);
/// Lines of columns: ours, sigma, the paper's, the difference in deviations.
std::string Describe(const std::vector<ComparedValue>& values);
HtmlReport::Table TableOf(const std::vector<ComparedValue>& values);

}  // namespace foresight
