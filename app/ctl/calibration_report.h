#pragma once

#include <nlohmann/json.hpp>

#include "core/calibration/calibrate_chain.h"
#include "core/report/html_report.h"
#include "core/report/pdf_report.h"

namespace foresight {

struct ComparedValue;

/// Everything of a calibration of the chain but its residuals one by one.
nlohmann::ordered_json CalibrationJson(const ChainCalibration& found);

/// The same in lines for people.
std::string DescribeCalibration(const ChainCalibration& found);

/// A page with tables of values, deviations, images and lines, and charts of the residuals.
HtmlReport CalibrationReport(const ChainCalibration& found, const std::string& session);

/// One sheet: verdict, what was calibrated, values with their deviations, and small charts.
/// @param paper the same session as the paper's sequence has it; may be empty
PdfReport CalibrationSheet(const ChainCalibration& found, const CalibrationSession& session,
                           const std::vector<ComparedValue>& paper);

/// The point of the motor's axis next to the camera, in camera.
Eigen::Vector3d AxisPoint(const SensorRig& rig);

}  // namespace foresight
