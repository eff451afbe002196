#pragma once

#include "core/calibration/board_detector.h"
#include "core/calibration/corner_grid.h"

namespace foresight {

ImageRating RateImage(const GrayImage& image, const CornerGrid& grid);
/// Of a view that may be partial: coverage and spacing; of a ChArUco board also levels and
/// saturation, where a black and a white square are whole.
ImageRating RateView(const GrayImage& image, const CalibrationBoard& board, const BoardView& view);

/// Why an image in which the board was found cannot be used; empty where it can.
std::string RatingFault(const ImageRating& rating);

/// What may be wrong with an image in which no board was found: "overexposed", "blurred", ...;
/// empty where nothing is.
std::string ImageFault(const GrayImage& image);

}  // namespace foresight
