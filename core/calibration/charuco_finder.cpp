#include "core/calibration/charuco_finder.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/aruco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "core/calibration/corner_grid.h"
#include "core/calibration/refine_corners.h"
#include "core/objects/predefined_dictionary.h"

namespace foresight {
namespace {

/// How far the markers beside a corner may disagree about it, in squares.
constexpr double kLargestDisagreement = 0.2;
constexpr double kLeastContrast = 15.0;

/// A marker that was seen: from the plane of the print, in squares from its upper left corner, to
/// pixels.
struct SeenMarker {
  cv::Matx33d pixels_from_print;

  Eigen::Vector2d Pixel(double x, double y) const {
    const cv::Vec3d p = pixels_from_print * cv::Vec3d(x, y, 1.0);
    return {p[0] / p[2], p[1] / p[2]};
  }
};
using MarkersByNumber = std::map<int, SeenMarker>;

struct Square {
  int column = 0;
  int row = 0;
};

std::vector<Square> SquaresOfMarkers(const CalibrationBoard& board) {
  std::vector<Square> squares(static_cast<std::size_t>(board.MarkerCount()));
  for (int row = 0; row <= board.rows; ++row)
    for (int column = 0; column <= board.columns; ++column)
      if (const int marker = board.MarkerAt(column, row); marker >= 0)
        squares[static_cast<std::size_t>(marker)] = {column, row};
  return squares;
}

MarkersByNumber DetectMarkers(const cv::Mat& image, const CalibrationBoard& board) {
  const cv::Ptr<cv::aruco::DetectorParameters> parameters = cv::aruco::DetectorParameters::create();
  parameters->adaptiveThreshWinSizeMax = 53;  // markers of a near board are large
  parameters->minMarkerPerimeterRate = 0.01;
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> numbers;
  cv::aruco::detectMarkers(
      image, cv::aruco::getPredefinedDictionary(PredefinedDictionary(board.dictionary)), corners,
      numbers, parameters);
  const std::vector<Square> squares = SquaresOfMarkers(board);
  MarkersByNumber markers;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] < 0 || numbers[i] >= board.MarkerCount()) continue;
    const Square& square = squares[static_cast<std::size_t>(numbers[i])];
    const float margin = static_cast<float>(0.5 * (1.0 - board.marker_per_square));
    const auto left = static_cast<float>(square.column) + margin;
    const auto top = static_cast<float>(square.row) + margin;
    const auto side = static_cast<float>(board.marker_per_square);
    const std::vector<cv::Point2f> print = {
        {left, top}, {left + side, top}, {left + side, top + side}, {left, top + side}};
    markers[numbers[i]] = {cv::getPerspectiveTransform(print, corners[i])};
  }
  return markers;
}

/// The markers in the two white squares that touch an inner corner.
std::vector<const SeenMarker*> MarkersBeside(const MarkersByNumber& markers,
                                             const CalibrationBoard& board, int column, int row) {
  std::vector<const SeenMarker*> beside;
  for (const int c : {column, column + 1})
    for (const int r : {row, row + 1})
      if (const auto at = markers.find(board.MarkerAt(c, r)); at != markers.end())
        beside.push_back(&at->second);
  return beside;
}

/// Whether black and white alternate around a corner, in the margin of the markers.
bool Alternates(const GrayImage& image, const SeenMarker& marker, const Eigen::Vector2d& shift,
                double x, double y, double reach, bool upper_left_is_black) {
  const auto grey = [&](double dx, double dy) {
    return GreyAt(image, marker.Pixel(x + dx, y + dy) + shift);
  };
  const auto a = grey(-reach, -reach), b = grey(reach, reach);
  const auto c = grey(reach, -reach), d = grey(-reach, reach);
  if (!a || !b || !c || !d) return false;
  const double contrast = upper_left_is_black ? std::min(*c, *d) - std::max(*a, *b)
                                              : std::min(*a, *b) - std::max(*c, *d);
  return contrast > kLeastContrast;
}

std::optional<Eigen::Vector2d> FindCorner(const GrayImage& image, const MarkersByNumber& markers,
                                          const CalibrationBoard& board, int column, int row) {
  const auto beside = MarkersBeside(markers, board, column, row);
  if (beside.empty()) return std::nullopt;
  const double x = column + 1.0, y = row + 1.0;  // in squares of the print
  Eigen::Vector2d guess = Eigen::Vector2d::Zero();
  for (const SeenMarker* marker : beside)
    guess += marker->Pixel(x, y) / static_cast<double>(beside.size());
  const SeenMarker& marker = *beside.front();
  const double square_px = std::min((marker.Pixel(x + 0.5, y) - marker.Pixel(x - 0.5, y)).norm(),
                                    (marker.Pixel(x, y + 0.5) - marker.Pixel(x, y - 0.5)).norm());
  for (const SeenMarker* other : beside)
    if (!((other->Pixel(x, y) - guess).norm() < kLargestDisagreement * square_px))
      return std::nullopt;
  // The window must stay clear of the markers, whose corners are near.
  const double margin = 0.5 * (1.0 - board.marker_per_square);
  auto corner = RefineCorner(image, guess, margin * square_px);
  // In a near board that window is wide: its corner was up to 0.7 px off.
  if (corner && margin * square_px > kLargestReach_px)
    corner = RefineCorner(image, *corner, kLargestReach_px);
  if (!corner || (*corner - guess).norm() > kLargestDisagreement * square_px) return std::nullopt;
  const Eigen::Vector2d shift = *corner - marker.Pixel(x, y);
  if (!Alternates(image, marker, shift, x, y, 0.6 * margin, CalibrationBoard::IsBlack(column, row)))
    return std::nullopt;
  return corner;
}

}  // namespace

CharucoSearch FindCharuco(const GrayImage& image, const CalibrationBoard& board) {
  const cv::Mat pixels(image.height(), image.width(), CV_8UC1,
                       const_cast<std::uint8_t*>(image.data()));  // never written
  CharucoSearch search;
  const MarkersByNumber markers = DetectMarkers(pixels, board);
  search.markers = static_cast<int>(markers.size());
  if (markers.empty()) {
    cv::Mat mirrored;
    cv::flip(pixels, mirrored, 1);
    search.mirrored = DetectMarkers(mirrored, board).size() >= 2;
    return search;
  }
  for (int id = 0; id < board.CornerCount(); ++id)
    if (const auto corner =
            FindCorner(image, markers, board, id % board.columns, id / board.columns)) {
      search.view.corner_ids.push_back(id);
      search.view.pixels.push_back(*corner);
    }
  return search;
}

}  // namespace foresight
