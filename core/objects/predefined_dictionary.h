#pragma once

#include <opencv2/aruco.hpp>

#include "core/base/contract.h"
#include "core/objects/calibration_board.h"

namespace foresight {

/// OpenCV's name of a set of markers.
inline cv::aruco::PREDEFINED_DICTIONARY_NAME PredefinedDictionary(
    CalibrationBoard::Dictionary dictionary) {
  using D = CalibrationBoard::Dictionary;
  switch (dictionary) {
    case D::k4x4_50:
      return cv::aruco::DICT_4X4_50;
    case D::k4x4_100:
      return cv::aruco::DICT_4X4_100;
    case D::k4x4_250:
      return cv::aruco::DICT_4X4_250;
    case D::k5x5_50:
      return cv::aruco::DICT_5X5_50;
    case D::k5x5_100:
      return cv::aruco::DICT_5X5_100;
    case D::k5x5_250:
      return cv::aruco::DICT_5X5_250;
    case D::k6x6_50:
      return cv::aruco::DICT_6X6_50;
    case D::k6x6_100:
      return cv::aruco::DICT_6X6_100;
    case D::k6x6_250:
      return cv::aruco::DICT_6X6_250;
  }
  FORESIGHT_EXPECTS(false, "a dictionary of the enumeration");
  return {};
}

}  // namespace foresight
