#include "core/calibration/saddle_points.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace foresight {
namespace {

constexpr int kRingSamples = 16;
constexpr double kRingRadius_px = 3.5;  // within the squares of the smallest boards
/// Grey levels; what is fainter is noise.
constexpr double kLeastSaddleContrast = 10.0;
/// Fifteen times the corners of boards of 9x6 and 7x6; of a room's clutter the weakest are left
/// out.
constexpr std::size_t kMostPoints = 1500;
/// Two maxima of equal response in one window are one corner that lies between pixels.
constexpr double kApart_px = 3.0;
/// The image at full size, and at half of it for blurred edges.
constexpr std::array<double, 2> kScales = {1.0, 0.5};

/// Points of an image by where they are: whether one is near is told in constant time.
class PointCells {
 public:
  PointCells(int width, int height)
      : columns_(width / kCell_px + 1),
        cells_(static_cast<std::size_t>(columns_) * (height / kCell_px + 1)) {}

  void Add(const Eigen::Vector2d& point) { cells_[IndexOf(point)].push_back(point); }
  /// @pre distance_px <= kCell_px
  bool HasNear(const Eigen::Vector2d& point, double distance_px) const {
    const int column = CellOf(point.x()), row = CellOf(point.y());
    const int rows = static_cast<int>(cells_.size()) / columns_;
    for (int y = std::max(0, row - 1); y <= std::min(rows - 1, row + 1); ++y)
      for (int x = std::max(0, column - 1); x <= std::min(columns_ - 1, column + 1); ++x)
        for (const Eigen::Vector2d& other : cells_[static_cast<std::size_t>(y * columns_ + x)])
          if ((other - point).norm() < distance_px) return true;
    return false;
  }

  static constexpr int kCell_px = 4;

 private:
  static int CellOf(double at) { return static_cast<int>(at) / kCell_px; }
  std::size_t IndexOf(const Eigen::Vector2d& point) const {
    return static_cast<std::size_t>(CellOf(point.y()) * columns_ + CellOf(point.x()));
  }

  int columns_;
  std::vector<std::vector<Eigen::Vector2d>> cells_;
};

float At(const cv::Mat& image, double x, double y) {
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const auto fx = static_cast<float>(x - left), fy = static_cast<float>(y - top);
  const float* upper = image.ptr<float>(top) + left;
  const float* lower = image.ptr<float>(top + 1) + left;
  return (1.0f - fy) * ((1.0f - fx) * upper[0] + fx * upper[1]) +
         fy * ((1.0f - fx) * lower[0] + fx * lower[1]);
}

/// Looks around a pixel on a ring. @pre the ring is in the image
std::optional<SaddlePoint> Inspect(const cv::Mat& image, int x, int y) {
  static const auto kRing = [] {
    std::array<Eigen::Vector2d, kRingSamples> ring;
    for (int k = 0; k < kRingSamples; ++k) {
      const double angle = 2.0 * M_PI * k / kRingSamples;
      ring[static_cast<std::size_t>(k)] = {kRingRadius_px * std::cos(angle),
                                           kRingRadius_px * std::sin(angle)};
    }
    return ring;
  }();
  std::array<double, kRingSamples> grey{};
  for (std::size_t k = 0; k < grey.size(); ++k)
    grey[k] = At(image, x + kRing[k].x(), y + kRing[k].y());
  const auto [least, most] = std::minmax_element(grey.begin(), grey.end());
  const double contrast = *most - *least;
  if (contrast < kLeastSaddleContrast) return std::nullopt;
  const double middle = 0.5 * (*most + *least);
  std::array<double, 4> crossings{};
  std::size_t count = 0, first_rising = 0;
  for (std::size_t k = 0; k < grey.size(); ++k) {
    const double here = grey[k] - middle, next = grey[(k + 1) % grey.size()] - middle;
    if ((here > 0.0) == (next > 0.0)) continue;
    if (count == crossings.size()) return std::nullopt;
    if (next > 0.0 && count < 2) first_rising = count;
    crossings[count++] =
        2.0 * M_PI / kRingSamples * (static_cast<double>(k) + here / (here - next));
  }
  if (count != crossings.size()) return std::nullopt;
  // Both lines go straight through the point, and cross at more than a sliver.
  // On a ring of 3.5 px, half a pixel of noise or of a corner's place bends a line by 0.3 rad; a
  // board seen 70 deg from its front has sectors of 0.66 rad.
  constexpr double kMostBend_rad = 0.6, kLeastSector_rad = 0.3;
  for (std::size_t i = 0; i < 2; ++i)
    if (std::abs(crossings[i + 2] - crossings[i] - M_PI) > kMostBend_rad) return std::nullopt;
  for (std::size_t i = 0; i < 4; ++i) {
    const double sector =
        i < 3 ? crossings[i + 1] - crossings[i] : crossings[0] + 2.0 * M_PI - crossings[3];
    if (sector < kLeastSector_rad) return std::nullopt;
  }
  SaddlePoint point{.pixel = Eigen::Vector2d(x, y), .edges = {}, .contrast = contrast};
  for (std::size_t i = 0; i < 4; ++i) {
    const double angle = crossings[(i + first_rising) % 4];
    point.edges[i] = {std::cos(angle), std::sin(angle)};
  }
  return point;
}

/// Minus the determinant of the second derivatives where that is positive.
cv::Mat SaddleResponse(const cv::Mat& image) {
  cv::Mat xx, yy, xy;
  cv::Sobel(image, xx, CV_32F, 2, 0, 3);
  cv::Sobel(image, yy, CV_32F, 0, 2, 3);
  cv::Sobel(image, xy, CV_32F, 1, 1, 3);
  return xy.mul(xy) - xx.mul(yy);
}

std::vector<SaddlePoint> FindAtScale(const cv::Mat& image) {
  cv::Mat smooth;
  image.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {5, 5}, 1.0);
  const cv::Mat response = SaddleResponse(smooth);
  cv::Mat highest;
  cv::dilate(response, highest, cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));
  std::vector<SaddlePoint> points;
  PointCells taken(image.cols, image.rows);
  const int margin = static_cast<int>(kRingRadius_px) + 2;
  constexpr float kLeastResponse = 8.0f;  // a corner of the least contrast, blurred over 4 px
  for (int y = margin; y < image.rows - margin; ++y) {
    const float* here = response.ptr<float>(y);
    const float* high = highest.ptr<float>(y);
    for (int x = margin; x < image.cols - margin; ++x) {
      if (here[x] < kLeastResponse || here[x] != high[x]) continue;
      if (taken.HasNear(Eigen::Vector2d(x, y), kApart_px)) continue;
      const auto point = Inspect(smooth, x, y);
      if (!point) continue;
      points.push_back(*point);
      taken.Add(point->pixel);
    }
  }
  return points;
}

}  // namespace

std::vector<SaddlePoint> FindSaddlePoints(const GrayImage& image) {
  const cv::Mat pixels(image.height(), image.width(), CV_8UC1,
                       const_cast<std::uint8_t*>(image.data()));  // never written
  std::vector<SaddlePoint> points;
  PointCells finer(image.width(), image.height());
  for (const double scale : kScales) {
    cv::Mat scaled = pixels;
    if (scale != 1.0) cv::resize(pixels, scaled, {}, scale, scale, cv::INTER_AREA);
    if (scaled.rows < 16 || scaled.cols < 16) break;
    std::vector<SaddlePoint> found = FindAtScale(scaled);
    for (SaddlePoint& point : found) {
      point.pixel = (point.pixel + Eigen::Vector2d(0.5, 0.5)) / scale - Eigen::Vector2d(0.5, 0.5);
      if (scale == 1.0 || !finer.HasNear(point.pixel, 2.0 / scale)) points.push_back(point);
    }
    if (scale == 1.0)
      for (const SaddlePoint& point : points) finer.Add(point.pixel);
  }
  if (points.size() > kMostPoints) {
    std::nth_element(points.begin(), points.begin() + kMostPoints, points.end(),
                     [](const auto& a, const auto& b) { return a.contrast > b.contrast; });
    points.resize(kMostPoints);
  }
  return points;
}

}  // namespace foresight
