#include "core/objects/marker_cells.h"

#include <opencv2/aruco.hpp>

#include "core/objects/predefined_dictionary.h"

namespace foresight {

std::vector<bool> MarkerCells(CalibrationBoard::Dictionary dictionary, int marker,
                              int* cells_a_side) {
  const auto markers = cv::aruco::getPredefinedDictionary(PredefinedDictionary(dictionary));
  const int cells = markers->markerSize + 2;
  cv::Mat image;
  markers->drawMarker(marker, cells, image, 1);
  std::vector<bool> white;
  for (int row = 0; row < cells; ++row)
    for (int column = 0; column < cells; ++column)
      white.push_back(image.at<std::uint8_t>(row, column) > 127);
  *cells_a_side = cells;
  return white;
}

}  // namespace foresight
