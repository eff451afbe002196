#pragma once

#include <nlohmann/json.hpp>

#include "core/calibration/calibrate_chain.h"
#include "core/report/html_report.h"

namespace foresight {

/// Everything of a calibration of the chain but its residuals one by one.
nlohmann::ordered_json CalibrationJson(const ChainCalibration& found);

/// The same in lines for people.
std::string DescribeCalibration(const ChainCalibration& found);

/// A page with tables of values, deviations, images and lines, and charts of the residuals.
HtmlReport CalibrationReport(const ChainCalibration& found, const std::string& session);

}  // namespace foresight
