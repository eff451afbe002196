#include "core/fitting/solids/image_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/contract.h"
#include "core/base/quantile.h"
#include "core/fitting/solids/part_edges.h"
#include "core/fitting/solids/solid_tracer.h"

namespace foresight {
namespace {

constexpr int kMargin_px = 40;  // an object may be larger than what was seen of it
constexpr int kLeast_px = 20;
constexpr double kBlur_px = 0.8;
constexpr double kGreyLevel = 0.5;  // a gradient that is none, in an image without noise
constexpr int kReach_px = 4;        // of an edge beside the outline
constexpr double kReachSigma_px = 2.0;
constexpr double kPiece_px = 3.0;
constexpr double kAside_px = 1.5;  // of the rays beside a piece
constexpr double kStep_m = 0.012;  // from one surface to the next that an edge hides

struct Crop {
  int left, top, width, height;
};

/// What the image shows round the points.
Crop CropRound(const ColorImage& image, const ImageView& view,
               std::span<const Eigen::Vector3d> seen) {
  Eigen::Array2d low(image.width(), image.height()), high(-1.0, -1.0);
  for (const Eigen::Vector3d& point : seen) {
    const auto pixel = view.camera.Project(view.camera_from_base * point);
    if (!pixel || !view.camera.InImage(*pixel)) continue;
    low = low.min(pixel->array());
    high = high.max(pixel->array());
  }
  const int left = std::max(0, static_cast<int>(low.x()) - kMargin_px);
  const int top = std::max(0, static_cast<int>(low.y()) - kMargin_px);
  const int right = std::min(image.width(), static_cast<int>(high.x()) + kMargin_px);
  const int bottom = std::min(image.height(), static_cast<int>(high.y()) + kMargin_px);
  if (right - left < kLeast_px || bottom - top < kLeast_px) return {0, 0, 0, 0};
  return {left, top, right - left, bottom - top};
}

struct Gradient {
  cv::Mat x, y;  ///< of each colour, grey levels a pixel

  cv::Vec3f Along(int column, int row, const Eigen::Vector2f& direction) const {
    return direction.x() * x.at<cv::Vec3f>(row, column) +
           direction.y() * y.at<cv::Vec3f>(row, column);
  }
};

Gradient GradientOf(const ColorImage& image, const Crop& crop) {
  // OpenCV wants a pointer that it may write through; nothing does.
  const cv::Mat all(image.height(), image.width(), CV_8UC3, const_cast<Rgb8*>(image.data()));
  cv::Mat part;
  all(cv::Rect(crop.left, crop.top, crop.width, crop.height)).convertTo(part, CV_32FC3);
  cv::GaussianBlur(part, part, {}, kBlur_px);
  Gradient gradient;
  cv::Sobel(part, gradient.x, CV_32F, 1, 0, 3, 0.125);
  cv::Sobel(part, gradient.y, CV_32F, 0, 1, 3, 0.125);
  return gradient;
}

/// Of the gradients' lengths: texture and the camera's noise, where most pixels are no edge.
float MedianOf(const Gradient& gradient, const Crop& crop) {
  std::vector<double> lengths;
  lengths.reserve(static_cast<std::size_t>(crop.width) * static_cast<std::size_t>(crop.height));
  for (int y = 0; y < crop.height; ++y)
    for (int x = 0; x < crop.width; ++x) {
      const auto gx = gradient.x.at<cv::Vec3f>(y, x), gy = gradient.y.at<cv::Vec3f>(y, x);
      lengths.push_back(std::sqrt(gx.dot(gx) + gy.dot(gy)));
    }
  return static_cast<float>(Quantile(std::move(lengths), 0.5));
}

/// Directions of half a circle.
std::vector<Eigen::Vector2d> HalfACircle(int turns) {
  std::vector<Eigen::Vector2d> directions;
  for (int turn = 0; turn < turns; ++turn) {
    const double angle = std::numbers::pi * turn / turns;
    directions.emplace_back(std::cos(angle), std::sin(angle));
  }
  return directions;
}

/// Which of the directions is nearest, or nearest to the opposite way.
std::size_t TurnOf(const Eigen::Vector2d& direction, std::span<const Eigen::Vector2d> turns) {
  const auto further = [&direction](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return std::abs(direction.dot(a)) < std::abs(direction.dot(b));
  };
  return static_cast<std::size_t>(std::max_element(turns.begin(), turns.end(), further) -
                                  turns.begin());
}

/// At each pixel the largest value that lies along the direction, the less the further away.
Image<float> LargestAlong(const Image<float>& values, const Eigen::Vector2f& direction) {
  std::array<int, 2 * kReach_px + 1> dx{}, dy{};
  std::array<float, 2 * kReach_px + 1> part{};
  for (int k = -kReach_px; k <= kReach_px; ++k) {
    const auto i = static_cast<std::size_t>(k + kReach_px);
    dx[i] = static_cast<int>(std::lround(static_cast<float>(k) * direction.x()));
    dy[i] = static_cast<int>(std::lround(static_cast<float>(k) * direction.y()));
    part[i] = static_cast<float>(std::exp(-0.5 * k * k / (kReachSigma_px * kReachSigma_px)));
  }
  Image<float> largest(values.width(), values.height());
  for (int y = 0; y < values.height(); ++y)
    for (int x = 0; x < values.width(); ++x)
      for (std::size_t i = 0; i < part.size(); ++i)
        if (values.Contains(x + dx[i], y + dy[i]))
          largest(x, y) = std::max(largest(x, y), part[i] * values(x + dx[i], y + dy[i]));
  return largest;
}

}  // namespace

double ImageEdges::NatsOf(double response) {
  constexpr std::array<double, 11> kResponse = {0.25, 0.75, 1.25, 2.0,  3.5, 5.0,
                                                7.0,  10.0, 14.0, 20.0, 30.0};
  constexpr std::array<double, 11> kNats = {-1.7, -1.4, -1.15, -0.9, -0.65, -0.2,
                                            0.05, 0.5,  0.75,  1.15, 1.35};
  if (response <= kResponse.front()) return kNats.front();
  for (std::size_t i = 1; i < kResponse.size(); ++i)
    if (response < kResponse[i])
      return kNats[i - 1] + (kNats[i] - kNats[i - 1]) * (response - kResponse[i - 1]) /
                                (kResponse[i] - kResponse[i - 1]);
  return kNats.back();
}

ImageEdges::ImageEdges(const ColorImage& image, const ImageView& view,
                       std::span<const Eigen::Vector3d> seen, double independent_per_px)
    : view_(view),
      eye_(view.camera_from_base.Inverse().translation()),
      independent_per_px_(independent_per_px) {
  FORESIGHT_EXPECTS(image.width() == view.camera.width && image.height() == view.camera.height,
                    "the image is the camera's");
  const Crop crop = CropRound(image, view, seen);
  left_ = crop.left;
  top_ = crop.top;
  width_ = crop.width;
  height_ = crop.height;
  if (Empty()) return;
  FindEdges(image);
  const auto base_from_camera = view.camera_from_base.Inverse();
  rays_ = Image<Eigen::Vector3f>(width_, height_, Eigen::Vector3f::Zero());
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (const auto ray = view.camera.Unproject(Eigen::Vector2d(left_ + x, top_ + y)))
        rays_(x, y) = base_from_camera.Rotate(*ray).cast<float>();
}

void ImageEdges::FindEdges(const ColorImage& image) {
  const Crop crop{left_, top_, width_, height_};
  const Gradient gradient = GradientOf(image, crop);
  const float usual = MedianOf(gradient, crop) + static_cast<float>(kGreyLevel);
  turns_ = HalfACircle(kTurns);
  for (const Eigen::Vector2d& turn : turns_) {
    const Eigen::Vector2f across = turn.cast<float>();
    Image<float> response(width_, height_);
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const cv::Vec3f change = gradient.Along(x, y, across);
        response(x, y) = std::sqrt(change.dot(change)) / usual;
      }
    responses_.push_back(LargestAlong(response, across));
  }
}

std::optional<Eigen::Vector3d> ImageEdges::RayThrough(const Eigen::Vector2d& pixel) const {
  const int x = static_cast<int>(std::floor(pixel.x() + 0.5)) - left_;
  const int y = static_cast<int>(std::floor(pixel.y() + 0.5)) - top_;
  if (!rays_.Contains(x, y) || rays_(x, y).isZero()) return std::nullopt;
  return rays_(x, y).cast<double>();
}

std::optional<double> ImageEdges::ResponseAt(const Eigen::Vector2d& pixel, std::size_t turn) const {
  const Image<float>& response = responses_[turn];
  const Eigen::Vector2d at = pixel - Eigen::Vector2d(left_, top_);
  const int x = static_cast<int>(std::floor(at.x())), y = static_cast<int>(std::floor(at.y()));
  if (!response.Contains(x, y) || !response.Contains(x + 1, y + 1)) return std::nullopt;
  const double right = at.x() - x, down = at.y() - y;
  return (1.0 - down) * ((1.0 - right) * response(x, y) + right * response(x + 1, y)) +
         down * ((1.0 - right) * response(x, y + 1) + right * response(x + 1, y + 1));
}

std::vector<ImageEdges::Piece> ImageEdges::WhereSomethingEnds(
    std::span<const Piece> pieces, std::span<const Eigen::Vector3d> beside,
    const RangesAlong& ranges_along) {
  std::vector<double> range_m(beside.size());
  ranges_along(beside, range_m);
  std::vector<Piece> outline;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double a_m = range_m[2 * i], b_m = range_m[2 * i + 1];
    const bool both_miss = std::isinf(a_m) && std::isinf(b_m);
    if (!both_miss && std::abs(a_m - b_m) > kStep_m) outline.push_back(pieces[i]);
  }
  return outline;
}

std::vector<ImageEdges::Piece> ImageEdges::PiecesAlong(std::span<const Edge> edges,
                                                       const RangesAlong& ranges_along) const {
  std::vector<Piece> pieces;
  if (Empty()) return pieces;
  std::vector<Eigen::Vector3d> beside;
  for (const Edge& edge : edges) {
    const Eigen::Vector2d along = edge.to_px - edge.from_px;
    const double length_px = along.norm();
    if (!(length_px > 0.0)) continue;
    const Eigen::Vector2d across = Eigen::Vector2d(-along.y(), along.x()) / length_px;
    const std::size_t turn = TurnOf(across, turns_);
    const int count = std::max(1, static_cast<int>(length_px / kPiece_px + 0.5));
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector2d at = edge.from_px + (i + 0.5) / count * along;
      const auto response = ResponseAt(at, turn);
      if (!response) continue;
      if (ranges_along) {
        const auto ray_a = RayThrough(at - kAside_px * across);
        const auto ray_b = RayThrough(at + kAside_px * across);
        if (!ray_a || !ray_b) continue;
        beside.push_back(*ray_a);
        beside.push_back(*ray_b);
      }
      pieces.push_back({at, *response, length_px / count, turn});
    }
  }
  return ranges_along ? WhereSomethingEnds(pieces, beside, ranges_along) : pieces;
}

std::vector<ImageEdges::Piece> ImageEdges::PiecesOf(
    std::span<const SolidPart> parts,
    const Rigid<frame::Base, frame::Object>& base_from_object) const {
  if (Empty()) return {};
  std::vector<Edge> edges;
  for (const SolidPart& part : parts) {
    const auto base_from_part = base_from_object * part.object_from_part;
    const auto camera_from_part = view_.camera_from_base * base_from_part;
    // Most edges go on where the last one ended.
    Eigen::Vector3d last = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    std::optional<Eigen::Vector2d> last_px;
    for (const PartEdge& edge : EdgesSeenFrom(part, base_from_part.Inverse() * eye_)) {
      const auto from =
          edge.from == last ? last_px : view_.camera.Project(camera_from_part * edge.from);
      const auto to = view_.camera.Project(camera_from_part * edge.to);
      if (from && to) edges.push_back({*from, *to});
      last = edge.to;
      last_px = to;
    }
  }
  const PlacedSolids solids = SolidTracer(parts, base_from_object).Placed();
  return PiecesAlong(edges,
                     [&](std::span<const Eigen::Vector3d> directions, std::span<double> ranges_m) {
                       RayColumns rays;
                       rays.Reserve(directions.size());
                       for (const Eigen::Vector3d& direction : directions)
                         rays.Add(eye_.data(), direction.data(), 0.0);
                       rays.Pad();
                       std::vector<double> padded_m(rays.Padded());
                       EnterColumns(solids, rays, padded_m);
                       std::copy_n(padded_m.begin(), ranges_m.size(), ranges_m.begin());
                     });
}

std::vector<ImageEdges::Piece> ImageEdges::Moved(std::span<const Piece> pieces,
                                                 const Eigen::Vector2d& by_px) const {
  std::vector<Piece> moved;
  for (const Piece& piece : pieces)
    if (const auto response = ResponseAt(piece.pixel + by_px, piece.turn))
      moved.push_back({piece.pixel + by_px, *response, piece.length_px, piece.turn});
  return moved;
}

OutlineSupport ImageEdges::SupportOf(std::span<const Piece> pieces) const {
  OutlineSupport support;
  for (const Piece& piece : pieces) {
    support.nats += independent_per_px_ * piece.length_px * NatsOf(piece.response);
    support.length_px += piece.length_px;
  }
  return support;
}

OutlineSupport ImageEdges::SupportOf(
    std::span<const SolidPart> parts,
    const Rigid<frame::Base, frame::Object>& base_from_object) const {
  return SupportOf(PiecesOf(parts, base_from_object));
}

}  // namespace foresight
