#include "core/selfcheck/camera_check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/base/parallel.h"
#include "core/base/quantile.h"
#include "core/calibration/tangent.h"
#include "core/selfcheck/log_gray.h"
#include "core/selfcheck/neighbour_groups.h"

namespace foresight {
namespace {

/// The gradient of an image's logarithm, smoothed; `usual` is its typical length.
struct Gradient {
  FloatImage x, y;
  float usual = 0.0f;
};

Gradient GradientOf(const FloatImage& log_gray, double blur_px) {
  Gradient gradient{FloatImage(log_gray.width(), log_gray.height()),
                    FloatImage(log_gray.width(), log_gray.height()), 0.0f};
  const auto mat = [](FloatImage& image) {
    return cv::Mat(image.height(), image.width(), CV_32F, image.data());
  };
  FloatImage blurred = Blurred(log_gray, blur_px);
  const cv::Mat smooth = mat(blurred);
  cv::Mat x = mat(gradient.x), y = mat(gradient.y);
  cv::Sobel(smooth, x, CV_32F, 1, 0);
  cv::Sobel(smooth, y, CV_32F, 0, 1);
  std::vector<float> lengths;
  for (std::size_t i = 0; i < gradient.x.size(); i += 17)
    lengths.push_back(std::hypot(gradient.x.values()[i], gradient.y.values()[i]));
  const std::size_t most = 9 * lengths.size() / 10;
  gradient.usual = std::max(ValueAtRank(std::move(lengths), most), 1e-6f);
  return gradient;
}

/// What the search turns: the camera's three turns, and how far the edges of each class lie
/// outwards, px: before near and before far surfaces by the beam's width, then by its height.
constexpr int kTurns = 3, kClasses = 2, kOutward = 2 * kClasses, kUnknowns = kTurns + kOutward;
using Shift = Eigen::Matrix<double, kUnknowns, 1>;
using Outward = Eigen::Matrix<double, kOutward, 1>;

struct ImageEdge {
  std::size_t image = 0;
  Eigen::Vector3d point;    ///< in camera
  Eigen::Vector2d outward;  ///< across the edge to the far surface, in the image, of length 1
  Outward by_outward;       ///< how far it lies outwards by each unknown
  int group = 0;
};

/// Two sums of one pass, for jackknives.
struct Scores {
  std::vector<double> sums;
  std::vector<int> counts;

  double Mean(int without = -1) const {
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      if (static_cast<int>(i) == without) continue;
      sum += sums[i];
      count += counts[i];
    }
    return count > 0 ? sum / count : 0.0;
  }
};

class EdgeMatcher {
 public:
  EdgeMatcher(const CameraModel& camera, std::vector<ImageEdge> edges, int groups)
      : camera_(camera), edges_(std::move(edges)), groups_(groups) {
    LinearizeAt(Shift::Zero());
  }

  void SetGradients(const std::vector<Gradient>* gradients) { gradients_ = gradients; }

  /// A lens is slow to evaluate, and the search asks for each edge thousands of times: its pixel is
  /// linear in the turn near `shift`. 12 px away, as far as the search goes, that is off by 0.1 px.
  void LinearizeAt(const Shift& shift) {
    base_rad_ = shift.head<kTurns>();
    const Eigen::Quaterniond turn = RotationExp(base_rad_);
    places_.clear();
    for (const ImageEdge& edge : edges_) {
      const Eigen::Vector3d point = turn * edge.point;
      CameraModel::ByPoint by_point;
      const auto pixel = camera_.Project(point, &by_point, nullptr);
      // Without a pixel the place is NaN, which lies in no image.
      places_.push_back(pixel ? Place{*pixel, -by_point * Skew(point)} : Place());
    }
  }

  Scores ScoreOf(const Shift& shift) const {
    Scores scores{std::vector<double>(static_cast<std::size_t>(groups_), 0.0),
                  std::vector<int>(static_cast<std::size_t>(groups_), 0)};
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const ImageEdge& edge = edges_[i];
      const auto group = static_cast<std::size_t>(edge.group);
      ++scores.counts[group];
      scores.sums[group] += Strength((*gradients_)[edge.image], PixelOf(i, shift), edge.outward);
    }
    return scores;
  }

  /// The image's gradient where an edge lies: of length 1, less where it is weak.
  Eigen::Vector2d GradientAt(std::size_t edge, const Shift& shift) const {
    const Gradient& gradient = (*gradients_)[edges_[edge].image];
    const Eigen::Vector2d at = Sampled(gradient, PixelOf(edge, shift));
    return at / (at.norm() + gradient.usual);
  }

  /// The mean score without one group (-1 = with all); large offsets outwards cost a little.
  double Objective(const Shift& shift, int without) const {
    constexpr double kPenalty = 0.001, kUsual_px = 2.0;
    return ScoreOf(shift).Mean(without) -
           kPenalty * (shift.tail<kOutward>() / kUsual_px).squaredNorm();
  }

  /// Climbs from `start` with steps that are halved from `largest_px` to `least_px`.
  Shift Climb(Shift start, double largest_px, double least_px, bool turns, int without) const {
    double best = Objective(start, without);
    for (double step = largest_px; step >= least_px;) {
      bool better = false;
      for (int i = turns ? 0 : kTurns; i < kUnknowns; ++i)
        for (const double sign : {1.0, -1.0}) {
          Shift tried = start;
          tried[i] += sign * step * PerPixel(i);
          const double score = Objective(tried, without);
          if (score <= best) continue;
          best = score;
          start = tried;
          better = true;
          break;
        }
      if (!better) step *= 0.5;
    }
    return start;
  }

  /// How much of an unknown moves an edge by about a pixel.
  double PerPixel(int unknown) const {
    if (unknown < 2) return 1.0 / camera_.fx;
    return unknown == 2 ? 4.0 / camera_.width : 1.0;
  }

  const std::vector<ImageEdge>& edges() const { return edges_; }

 private:
  struct Place {
    Eigen::Vector2d pixel = Eigen::Vector2d::Constant(std::nan(""));
    Eigen::Matrix<double, 2, kTurns> by_turn = Eigen::Matrix<double, 2, kTurns>::Zero();
  };

  Eigen::Vector2d PixelOf(std::size_t edge, const Shift& shift) const {
    return places_[edge].pixel + places_[edge].by_turn * (shift.head<kTurns>() - base_rad_) +
           edges_[edge].by_outward.dot(shift.tail<kOutward>()) * edges_[edge].outward;
  }

  /// Interpolated; zero outside of the image.
  static Eigen::Vector2d Sampled(const Gradient& gradient, const Eigen::Vector2d& at) {
    const Eigen::Vector2d sampled(Interpolated(gradient.x, at), Interpolated(gradient.y, at));
    return sampled.allFinite() ? sampled : Eigen::Vector2d::Zero();
  }

  static double Strength(const Gradient& gradient, const Eigen::Vector2d& at,
                         const Eigen::Vector2d& across) {
    const double length = std::abs(Sampled(gradient, at).dot(across));
    return length / (length + gradient.usual);
  }

  const CameraModel& camera_;
  std::vector<ImageEdge> edges_;
  std::vector<Place> places_;  ///< one an edge
  Eigen::Vector3d base_rad_ = Eigen::Vector3d::Zero();
  int groups_;
  const std::vector<Gradient>* gradients_ = nullptr;
};

/// @param to_far from the near to the far surface, along the line, px
/// @param along along the edge, px; zero = across the line
ImageEdge InImage(std::size_t image, const Eigen::Vector3d& point, const Eigen::Vector2d& to_far,
                  const Eigen::Vector2d& along, int edge_class) {
  const Eigen::Vector2d across = along.isZero() ? to_far : Eigen::Vector2d(-along.y(), along.x());
  ImageEdge edge{image, point, across.normalized(), Outward::Zero(), 0};
  if (edge.outward.dot(to_far) < 0.0) edge.outward *= -1.0;
  // A beam reaches over an upright edge by half of its width, over a level one by half its height.
  const double upright = std::min(1.0, edge.outward.dot(to_far.normalized()));
  edge.by_outward[edge_class] = upright;
  edge.by_outward[kClasses + edge_class] = std::sqrt(1.0 - upright * upright);
  return edge;
}

std::vector<ImageEdge> EdgesInImages(const Scan& scan, const std::vector<DepthEdge>& edges,
                                     const std::vector<const CameraFrame*>& frames,
                                     const CameraCheckOptions& options) {
  std::vector<ImageEdge> seen;
  // Groups are of neighbours, so that one object's mistake is one group's.
  std::vector<double> azimuths;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const auto camera_from_base = scan.rig.CameraFromBase(frames[f]->motor_angle_rad);
    for (const DepthEdge& edge : edges) {
      const Eigen::Vector3d point = camera_from_base * edge.point;
      const auto pixel = scan.rig.camera.Project(point);
      const auto beyond = scan.rig.camera.Project(camera_from_base * (edge.point + edge.across));
      const auto further = scan.rig.camera.Project(camera_from_base * (edge.point + edge.along));
      const double margin = options.reach_px + options.most_outward_px;
      if (!pixel || !beyond || !further || !(pixel->x() > margin && pixel->y() > margin) ||
          !(pixel->x() < scan.rig.camera.width - margin) ||
          !(pixel->y() < scan.rig.camera.height - margin))
        continue;
      seen.push_back(InImage(f, point, *beyond - *pixel, *further - *pixel,
                             edge.jump_m > options.merge_m ? 1 : 0));
      azimuths.push_back(std::atan2(edge.point.x(), edge.point.z()));
    }
  }
  const std::vector<int> groups = NeighbourGroups(azimuths, options.groups);
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i].group = groups[i];
  return seen;
}

/// Fails with kCancelled.
Result<Shift> CoarseSearch(const EdgeMatcher& matcher, double reach_px, const RunContext& context) {
  constexpr double kStep_px = 3.0;
  std::vector<Shift> shifts = {Shift::Zero()};
  const int steps = static_cast<int>(reach_px / kStep_px);
  for (int x = -steps; x <= steps; ++x)
    for (int y = -steps; y <= steps; ++y)
      for (int roll = -2; roll <= 2; ++roll) {
        Shift shift = Shift::Zero();
        shift[0] = kStep_px * x * matcher.PerPixel(0);
        shift[1] = kStep_px * y * matcher.PerPixel(1);
        shift[2] = kStep_px * roll * matcher.PerPixel(2);
        shifts.push_back(shift);
      }
  std::vector<double> scores(shifts.size());
  const bool finished = ParallelFor(static_cast<int>(shifts.size()), context, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    scores[at] = matcher.Objective(shifts[at], -1);
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "the check was cancelled");
  return shifts[static_cast<std::size_t>(std::max_element(scores.begin(), scores.end()) -
                                         scores.begin())];
}

double ScoreAside(const EdgeMatcher& matcher, const Shift& best, double reach_px) {
  constexpr int kPlaces = 12;
  double sum = 0.0;
  for (int i = 0; i < kPlaces; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPlaces;
    Shift shift = best;
    shift[0] += reach_px * std::cos(angle) * matcher.PerPixel(0);
    shift[1] += reach_px * std::sin(angle) * matcher.PerPixel(1);
    sum += matcher.ScoreOf(shift).Mean() / kPlaces;
  }
  return sum;
}

/// The gain's mean over its deviation, by groups.
double GainSigmas(const Scores& after, const Scores& before) {
  const auto count = static_cast<double>(after.sums.size());
  double mean = 0.0, squares = 0.0;
  for (std::size_t g = 0; g < after.sums.size(); ++g)
    mean += (after.sums[g] - before.sums[g]) / count;
  for (std::size_t g = 0; g < after.sums.size(); ++g)
    squares += std::pow(after.sums[g] - before.sums[g] - mean, 2);
  return squares > 0.0 ? mean / std::sqrt(squares / (count - 1.0) / count) : 0.0;
}

/// What the directions of the image's edges leave open: each says where the image is across it, up
/// to what its class lies outwards.
Eigen::Matrix3d CovarianceOfDirections(const EdgeMatcher& matcher, const Shift& shift,
                                       const CameraModel& camera,
                                       const CameraCheckOptions& options) {
  Eigen::Matrix<double, kUnknowns, kUnknowns> normal;
  normal.setZero();
  for (int i = kTurns; i < kUnknowns; ++i)
    normal(i, i) = 1.0 / (options.outward_sigma_px * options.outward_sigma_px);
  constexpr double kAnyTurn_rad = 1.0;  // keeps the matrix regular
  for (int i = 0; i < kTurns; ++i) normal(i, i) = 1.0 / (kAnyTurn_rad * kAnyTurn_rad);
  for (std::size_t i = 0; i < matcher.edges().size(); ++i) {
    const ImageEdge& edge = matcher.edges()[i];
    CameraModel::ByPoint by_point;
    if (!camera.Project(edge.point, &by_point, nullptr)) continue;
    const Eigen::Vector2d across = matcher.GradientAt(i, shift);
    Shift row = Shift::Zero();
    row.head<3>() = -(across.transpose() * by_point * Skew(edge.point)).transpose();
    row.tail<kOutward>() = across.dot(edge.outward) * edge.by_outward;
    normal += row * row.transpose() / (options.edge_sigma_px * options.edge_sigma_px);
  }
  return normal.inverse().topLeftCorner<3, 3>();
}

}  // namespace

Result<CameraCheck> CheckCamera(const Scan& scan, const RegisteredScan& cloud,
                                const CameraCheckOptions& options, const RunContext& context) {
  std::vector<const CameraFrame*> frames;
  for (const CameraFrame& frame : scan.frames)
    if (frame.image.width() == scan.rig.camera.width &&
        frame.image.height() == scan.rig.camera.height)
      frames.push_back(&frame);
  if (frames.empty())
    return Fail(ErrorCode::kTooFewPoints, "the scan has no image of the camera's size");
  const std::vector<DepthEdge> edges = FindDepthEdges(cloud, options.edges);
  EdgeMatcher matcher(scan.rig.camera, EdgesInImages(scan, edges, frames, options), options.groups);
  CameraCheck check;
  check.edges = static_cast<int>(matcher.edges().size());
  check.images = static_cast<int>(frames.size());
  if (check.edges < options.least_edges)
    return Fail(ErrorCode::kTooFewPoints,
                "{} depth edges in the images, {} are needed: scan where things stand before "
                "others",
                check.edges, options.least_edges);

  std::vector<FloatImage> grays;
  for (const CameraFrame* frame : frames) grays.push_back(LogGray(frame->image));
  std::vector<Gradient> gradients(frames.size());
  const auto use_blur = [&](double blur_px) {
    for (std::size_t i = 0; i < grays.size(); ++i) gradients[i] = GradientOf(grays[i], blur_px);
    matcher.SetGradients(&gradients);
  };
  constexpr double kCoarse_px = 4.0, kMiddle_px = 2.5, kFine_px = 1.5, kLeast_px = 0.1;
  // From where the rig has it, and from the best place within reach: of texture, too.
  use_blur(kCoarse_px);
  Shift near = matcher.Climb(Shift::Zero(), 2.0, 0.5, true, -1);
  FORESIGHT_TRY(Shift far, CoarseSearch(matcher, options.reach_px, context));
  use_blur(kMiddle_px);
  near = matcher.Climb(near, 2.0, 0.5, true, -1);
  far = matcher.Climb(far, 2.0, 0.5, true, -1);
  use_blur(kFine_px);
  near = matcher.Climb(near, 1.0, kLeast_px, true, -1);
  far = matcher.Climb(far, 1.0, kLeast_px, true, -1);
  const bool far_is_better =
      GainSigmas(matcher.ScoreOf(far), matcher.ScoreOf(near)) > options.least_far_sigmas;
  Shift best = far_is_better ? far : near;
  matcher.LinearizeAt(best);
  best = matcher.Climb(best, 0.5, kLeast_px, true, -1);

  const Shift unturned = matcher.Climb(Shift::Zero(), 1.0, kLeast_px, false, -1);
  check.turn_rad = best.head<3>();
  check.outward_px = best.segment<kClasses>(kTurns);
  check.score = matcher.ScoreOf(best).Mean();
  check.score_before = matcher.ScoreOf(unturned).Mean();
  check.score_aside = ScoreAside(matcher, best, options.reach_px);
  check.gain_sigmas = GainSigmas(matcher.ScoreOf(best), matcher.ScoreOf(unturned));
  std::vector<Eigen::Vector3d> turns(static_cast<std::size_t>(options.groups));
  const bool finished = ParallelFor(options.groups, context, [&](int group) {
    turns[static_cast<std::size_t>(group)] =
        matcher.Climb(best, 1.0, kLeast_px, true, group).head<3>();
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "the check was cancelled");
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& turn : turns) mean += turn / options.groups;
  check.covariance = CovarianceOfDirections(matcher, best, scan.rig.camera, options);
  for (const Eigen::Vector3d& turn : turns)
    check.covariance +=
        (options.groups - 1.0) / options.groups * (turn - mean) * (turn - mean).transpose();
  return check;
}

}  // namespace foresight
