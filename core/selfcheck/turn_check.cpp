#include "core/selfcheck/turn_check.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/quantile.h"
#include "core/base/tukey_weight.h"
#include "core/calibration/tangent.h"
#include "core/geometry/angles.h"
#include "core/selfcheck/log_gray.h"
#include "core/selfcheck/neighbour_groups.h"

namespace foresight {
namespace {

/// The unknowns of the adjustment: those of TurnCheck, the camera's shift along the head's y and z,
/// and what the plate is off by at each image beside.
constexpr int kShiftY = TurnCheck::kUnknowns, kShiftZ = kShiftY + 1, kFirstImage = kShiftZ + 1;
using Unknowns = Eigen::VectorXd;

/// A point's surroundings are followed, not a pixel alone.
constexpr int kSide = 3, kPatch = kSide * kSide;
constexpr double kStep_px = 2.0;
using Patch = Eigen::Matrix<double, kPatch, 1>;

struct View {
  const CameraFrame* frame = nullptr;
  double plate_rad = 0.0;
  double bend = 0.0;  ///< of the unknown kBend
  FloatImage log_gray;
  FloatImage band;  ///< without what is much wider than the blur
};

/// A point of one image that is looked for in another.
struct FollowedPoint {
  std::size_t from = 0, to = 0;
  int group = 0;
  std::array<Eigen::Vector2d, kPatch> pixels;     ///< in `from`
  std::array<Eigen::Vector3d, kPatch> in_camera;  ///< where they are seen, at the point's range
};

Eigen::Vector2d GradientAt(const FloatImage& image, const Eigen::Vector2d& at) {
  const Eigen::Vector2d right(1.0, 0.0), down(0.0, 1.0);
  return 0.5 * Eigen::Vector2d(Interpolated(image, at + right) - Interpolated(image, at - right),
                               Interpolated(image, at + down) - Interpolated(image, at - down));
}

/// What an image's noise alone makes of its gradient's length once it is blurred: the noise of a
/// pixel, against the mean of its neighbours, by sqrt(2) / (sqrt(8 pi) sigma^2).
double GradientNoise(const FloatImage& image, double blur_px) {
  std::vector<float> offs;
  constexpr int kStep = 5;
  for (int y = 1; y + 1 < image.height(); y += kStep)
    for (int x = 1; x + 1 < image.width(); x += kStep)
      offs.push_back(std::abs(image(x, y) - 0.25f * (image(x - 1, y) + image(x + 1, y) +
                                                     image(x, y - 1) + image(x, y + 1))));
  constexpr double kMadToSigma = 1.4826, kOfDifference = 0.894;  // sqrt(4 / 5)
  const double noise = kMadToSigma * kOfDifference * UpperMedian(std::move(offs));
  return noise / (std::sqrt(4.0 * std::numbers::pi) * blur_px * blur_px);
}

/// A beam's end as an image shows it.
struct SeenPoint {
  Eigen::Vector2d pixel;
  double range_m = 0.0;      ///< of the surface there
  double azimuth_rad = 0.0;  ///< about the motor's axis' normal, in base
  double contrast = 0.0;
};

/// The surface around each place of an image: the plane through the beams' ends there, whose
/// reciprocal range is linear in the pixel.
class SurfacesSeen {
 public:
  SurfacesSeen(int width, int height)
      : wide_(width / kTile_px + 1),
        high_(height / kTile_px + 1),
        tiles_(static_cast<std::size_t>(wide_ * high_), Sums::Zero()) {}

  void Add(const Eigen::Vector2d& pixel, double range_m) {
    Eigen::Vector4d row;
    row << 1.0, pixel, 1.0 / range_m;
    tiles_[Index(Tile(pixel.x()), Tile(pixel.y()))] += row * row.transpose();
  }

  /// After the last Add.
  void Fit() {
    std::vector<double> rms;
    for (int y = 0; y < high_; ++y)
      for (int x = 0; x < wide_; ++x) {
        planes_.push_back(FitAround(x, y));
        if (std::isfinite(planes_.back().rms)) rms.push_back(planes_.back().rms);
      }
    constexpr double kAboveUsual = 1.2, kEven = 0.004;
    most_rms_ = std::max(kEven, kAboveUsual * UpperMedian(std::move(rms)));
  }

  /// NaN where it is not one surface: beside an outline nobody knows how far away what the image
  /// shows is.
  double RangeAt(const Eigen::Vector2d& pixel) const {
    const Plane& plane = planes_[Index(Tile(pixel.x()), Tile(pixel.y()))];
    if (!(plane.rms < most_rms_)) return std::nan("");
    return 1.0 / (plane.reciprocal[0] + plane.reciprocal.tail<2>().dot(pixel));
  }

 private:
  using Sums = Eigen::Matrix4d;  ///< of 1, the pixel and the reciprocal range, by each other
  struct Plane {
    Eigen::Vector3d reciprocal = Eigen::Vector3d::Zero();  ///< 1 / m, by 1 and the pixel
    double rms = std::nan("");                             ///< of the range
  };

  Plane FitAround(int tile_x, int tile_y) const {
    Sums sums = Sums::Zero();
    for (int y = std::max(0, tile_y - kReach); y <= std::min(high_ - 1, tile_y + kReach); ++y)
      for (int x = std::max(0, tile_x - kReach); x <= std::min(wide_ - 1, tile_x + kReach); ++x)
        sums += tiles_[Index(x, y)];
    constexpr double kLeastBeams = 12.0;
    Plane plane;
    if (sums(0, 0) < kLeastBeams) return plane;
    // About the middle, or the squares of pixels drown what is left.
    const Eigen::Vector4d mean = sums.col(0) / sums(0, 0);
    const Eigen::Matrix3d about =
        (sums - sums(0, 0) * mean * mean.transpose()).bottomRightCorner<3, 3>();
    const Eigen::Matrix2d spread = about.topLeftCorner<2, 2>();
    constexpr double kLeastSpread_px2 = 4.0;
    if (spread.selfadjointView<Eigen::Lower>().eigenvalues()[0] < kLeastSpread_px2 * sums(0, 0))
      return plane;
    const Eigen::Vector2d slope = spread.ldlt().solve(about.topRightCorner<2, 1>());
    const double left = about(2, 2) - slope.dot(about.topRightCorner<2, 1>());
    plane.reciprocal << mean[3] - slope.dot(mean.segment<2>(1)), slope;
    plane.rms = std::sqrt(std::max(0.0, left) / (sums(0, 0) - 3.0)) / mean[3];
    return plane;
  }

  /// Beams are 12 mrad high: those of a near surface end half of that before its outline.
  static constexpr int kTile_px = 8, kReach = 2;
  static int Tile(double pixel) { return static_cast<int>(pixel) / kTile_px; }
  std::size_t Index(int x, int y) const { return static_cast<std::size_t>(y * wide_ + x); }

  int wide_, high_;
  std::vector<Sums> tiles_;
  std::vector<Plane> planes_;
  double most_rms_ = 0.0;
};

/// The points with most contrast, spread over the image.
std::vector<SeenPoint> PointsOf(const Scan& scan, const RegisteredScan& cloud, const View& view,
                                double blur_px, std::size_t most) {
  constexpr double kMargin_px = 12.0;
  constexpr int kTile_px = 32;
  constexpr std::size_t kMostOfTile = 12;
  const auto camera_from_base = scan.rig.CameraFromBase(view.frame->motor_angle_rad);
  const CameraModel& camera = scan.rig.camera;
  const int tiles_wide = camera.width / kTile_px + 1;
  std::vector<std::vector<SeenPoint>> tiles(
      static_cast<std::size_t>(tiles_wide * (camera.height / kTile_px + 1)));
  SurfacesSeen surfaces(camera.width, camera.height);
  for (int line = 0; line < cloud.lines; ++line)
    for (int beam = 0; beam < cloud.beams; ++beam) {
      if (!cloud.Valid(line, beam)) continue;
      const Eigen::Vector3d in_base = cloud.points[cloud.Index(line, beam)].cast<double>();
      const Eigen::Vector3d point = camera_from_base * in_base;
      const auto pixel = camera.Project(point);
      if (!pixel || !(pixel->x() > kMargin_px && pixel->y() > kMargin_px) ||
          !(pixel->x() < camera.width - kMargin_px && pixel->y() < camera.height - kMargin_px))
        continue;
      surfaces.Add(*pixel, point.norm());
      const double contrast = GradientAt(view.band, *pixel).norm();
      const auto tile =
          static_cast<std::size_t>(static_cast<int>(pixel->y()) / kTile_px * tiles_wide +
                                   static_cast<int>(pixel->x()) / kTile_px);
      tiles[tile].push_back({*pixel, 0.0, std::atan2(in_base.x(), in_base.z()), contrast});
    }
  // What is plain shows noise and the fall of the light alone.
  constexpr double kLeastOfNoise = 6.0;
  const double least = kLeastOfNoise * GradientNoise(view.log_gray, blur_px);
  std::vector<SeenPoint> points;
  const auto more = [](const SeenPoint& a, const SeenPoint& b) { return a.contrast > b.contrast; };
  surfaces.Fit();
  for (std::vector<SeenPoint>& tile : tiles) {
    for (SeenPoint& point : tile) point.range_m = surfaces.RangeAt(point.pixel);
    std::erase_if(tile, [&](const SeenPoint& point) {
      return !(point.contrast > least) || !(point.range_m > 0.0);
    });
    std::stable_sort(tile.begin(), tile.end(), more);
    tile.resize(std::min(tile.size(), kMostOfTile));
    points.insert(points.end(), tile.begin(), tile.end());
  }
  std::stable_sort(points.begin(), points.end(), more);
  points.resize(std::min(points.size(), most));
  return points;
}

/// What a pair of images depends on: the unknowns before the images', and those of both images.
constexpr int kFrom = kFirstImage, kTo = kFrom + 1, kLocals = kTo + 1;
using ByLocals = Eigen::Matrix<double, 3, kLocals>;

/// How points of one image are looked for in another with the present answer.
class ImagePair {
 public:
  ImagePair(const SensorRig& rig, const View& from, const View& to, const Unknowns& x,
            double from_off, double to_off)
      : to_camera_(rig.camera_from_head.rotation().toRotationMatrix() * Turned(x).transpose()),
        from_camera_(to_camera_.transpose()),
        middle_(rig.camera_from_head.Inverse().translation() +
                Eigen::Vector3d(0.0, x[kShiftY], x[kShiftZ])),
        between_rad_(to.plate_rad - from.plate_rad),
        between_bend_(to.bend - from.bend) {
    const double angle = between_rad_ + x[TurnCheck::kScale] * between_rad_ +
                         x[TurnCheck::kBend] * between_bend_ + to_off - from_off;
    back_ = Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitX()).toRotationMatrix();
  }

  /// In the other image's camera.
  Eigen::Vector3d Place(const Eigen::Vector3d& in_from) const {
    return to_camera_ * (back_ * (middle_ + from_camera_ * in_from) - middle_);
  }

  /// Of that place.
  ByLocals Derivatives(const Eigen::Vector3d& in_from) const {
    const Eigen::Vector3d seen = from_camera_ * in_from;
    const Eigen::Vector3d in_other = back_ * (middle_ + seen);
    const Eigen::Vector3d by_angle = -(to_camera_ * Eigen::Vector3d::UnitX().cross(in_other));
    ByLocals by;
    by.col(TurnCheck::kScale) = between_rad_ * by_angle;
    by.col(TurnCheck::kBend) = between_bend_ * by_angle;
    const Eigen::Vector3d axes[] = {Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
    for (int i = 0; i < 2; ++i) {
      by.col(TurnCheck::kCameraY + i) =
          to_camera_ * (back_ * axes[i].cross(seen) - axes[i].cross(in_other - middle_));
      by.col(kShiftY + i) = to_camera_ * (back_ * axes[i] - axes[i]);
    }
    by.col(kFrom) = -by_angle;
    by.col(kTo) = by_angle;
    return by;
  }

 private:
  /// The camera turned on the plate about itself.
  static Eigen::Matrix3d Turned(const Unknowns& x) {
    return RotationExp({0.0, x[TurnCheck::kCameraY], x[TurnCheck::kCameraZ]}).toRotationMatrix();
  }

  Eigen::Matrix3d to_camera_, from_camera_, back_;
  Eigen::Vector3d middle_;  ///< of the camera, in head
  double between_rad_, between_bend_;
};

/// What one patch says at the place where it is looked for.
struct PatchSays {
  bool seen = false;
  double squares = 0.0;   ///< of what is left
  double variance = 0.0;  ///< of what it shows, the sum of squares
  Eigen::Matrix<double, kLocals, kLocals> matrix;
  Eigen::Matrix<double, kLocals, 1> right;
};

class TurnAdjustment {
 public:
  TurnAdjustment(const SensorRig& rig, std::vector<View>& views, std::vector<FollowedPoint> points,
                 bool bend, const TurnCheckOptions& options)
      : rig_(rig),
        views_(views),
        points_(std::move(points)),
        options_(options),
        unknowns_(kFirstImage + static_cast<Eigen::Index>(views.size())),
        answer_(Unknowns::Zero(unknowns_)) {
    priors_ =
        Unknowns::Constant(unknowns_, 1.0 / (options.motor_sigma_rad * options.motor_sigma_rad));
    constexpr double kAnyScale = 0.1, kAny_rad = 0.1, kNone = 1e-9;
    const auto prior = [&](Eigen::Index unknown, double sigma) {
      priors_[unknown] = 1.0 / (sigma * sigma);
    };
    prior(TurnCheck::kScale, kAnyScale);
    prior(TurnCheck::kBend, bend ? kAny_rad : kNone);
    prior(TurnCheck::kCameraY, kAny_rad);
    prior(TurnCheck::kCameraZ, kAny_rad);
    prior(kShiftY, options.shift_prior_m);
    prior(kShiftZ, options.shift_prior_m);
  }

  /// Steps with images of one blur. Fails with kCancelled.
  Status Solve(int steps, const RunContext& context) {
    for (int i = 0; i < steps; ++i) {
      FORESIGHT_CHECK(Ask(context));
      const Unknowns step = matrix_.ldlt().solve(right_);
      answer_ += step;
    }
    return Ask(context);
  }

  /// Patches' scatter, and what leaving out each group of neighbouring points changes.
  Eigen::MatrixXd Covariance() const {
    Eigen::MatrixXd covariance = noise_ * matrix_.inverse();
    const auto groups = static_cast<std::size_t>(options_.groups);
    for (std::size_t group = 0; group < groups; ++group) {
      Eigen::MatrixXd matrix = matrix_;
      Eigen::VectorXd right = right_;
      for (std::size_t i = 0; i < points_.size(); ++i) {
        if (points_[i].group != static_cast<int>(group) || !says_[i].seen) continue;
        Add(i, -weights_[i], matrix, right);
      }
      const Unknowns change = matrix.ldlt().solve(right);
      covariance += (options_.groups - 1.0) / options_.groups * change * change.transpose();
    }
    return covariance;
  }

  const Unknowns& answer() const { return answer_; }
  /// Of what the patches that were followed vary by.
  double Explained() const {
    double left = 0.0, all = 0.0;
    for (std::size_t i = 0; i < says_.size(); ++i) {
      if (weights_[i] <= 0.0) continue;
      left += says_[i].squares;
      all += says_[i].variance;
    }
    return all > 0.0 ? 1.0 - left / all : 0.0;
  }
  int Followed() const {
    return static_cast<int>(std::count_if(weights_.begin(), weights_.end(),
                                          [](double weight) { return weight > 0.0; }));
  }

 private:
  PatchSays Say(const FollowedPoint& point) const {
    PatchSays says;
    const View& from = views_[point.from];
    const View& to = views_[point.to];
    const ImagePair pair(rig_, from, to, answer_, answer_[IndexOf(point.from)],
                         answer_[IndexOf(point.to)]);
    const Eigen::Vector3d& middle = point.in_camera[kPatch / 2];
    CameraModel::ByPoint by_point;
    if (!rig_.camera.Project(pair.Place(middle), &by_point, nullptr)) return says;
    const Eigen::Matrix<double, 2, kLocals> by_pixel = by_point * pair.Derivatives(middle);
    Patch there, here;
    Eigen::Matrix<double, kPatch, kLocals> by;
    for (int i = 0; i < kPatch; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const auto pixel = rig_.camera.Project(pair.Place(point.in_camera[at]));
      if (!pixel) return says;
      there[i] = Interpolated(to.band, *pixel);
      here[i] = Interpolated(from.band, point.pixels[at]);
      by.row(i) = GradientAt(to.band, *pixel).transpose() * by_pixel;
    }
    if (!there.allFinite() || !here.allFinite() || !by.allFinite()) return says;
    // The light falls off to the image's corners.
    const Patch left = (there.array() - there.mean()) - (here.array() - here.mean());
    by.rowwise() -= by.colwise().mean().eval();
    says.seen = true;
    says.squares = left.squaredNorm();
    says.variance = (here.array() - here.mean()).matrix().squaredNorm();
    says.matrix = by.transpose() * by;
    says.right = -by.transpose() * left;
    return says;
  }

  static Eigen::Index IndexOf(std::size_t image) {
    return kFirstImage + static_cast<Eigen::Index>(image);
  }

  /// Adds what a patch says, so many times.
  void Add(std::size_t i, double weight, Eigen::MatrixXd& matrix, Eigen::VectorXd& right) const {
    std::array<Eigen::Index, kLocals> at{};
    std::iota(at.begin(), at.end(), Eigen::Index{0});
    at[kFrom] = IndexOf(points_[i].from);
    at[kTo] = IndexOf(points_[i].to);
    for (int row = 0; row < kLocals; ++row) {
      for (int column = 0; column < kLocals; ++column)
        matrix(at[static_cast<std::size_t>(row)], at[static_cast<std::size_t>(column)]) +=
            weight * says_[i].matrix(row, column);
      right[at[static_cast<std::size_t>(row)]] += weight * says_[i].right[row];
    }
  }

  /// The normal equations at the present answer.
  Status Ask(const RunContext& context) {
    says_.assign(points_.size(), {});
    const bool finished = ParallelFor(static_cast<int>(points_.size()), context, [&](int i) {
      says_[static_cast<std::size_t>(i)] = Say(points_[static_cast<std::size_t>(i)]);
    });
    if (!finished) return Fail(ErrorCode::kCancelled, "the check was cancelled");
    // What is left of a patch is a part of what it shows, so that the strongest do not say it all.
    std::vector<double> offs;
    for (PatchSays& says : says_) {
      if (!says.seen) continue;
      const double scale = 1.0 / (says.variance + kFloor);
      says.squares *= scale;
      says.variance *= scale;
      says.matrix *= scale;
      says.right *= scale;
      offs.push_back(says.squares / kPatch);
    }
    noise_ = offs.empty() ? 1.0 : std::max(1e-6, 2.0 * UpperMedian(offs));
    matrix_ = Eigen::MatrixXd::Zero(unknowns_, unknowns_);
    right_ = Eigen::VectorXd::Zero(unknowns_);
    weights_.assign(points_.size(), 0.0);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!says_[i].seen) continue;
      const double off = std::sqrt(says_[i].squares / kPatch / noise_) / options_.tukey_sigmas;
      if (off >= 1.0) continue;
      weights_[i] = TukeyWeight(off);
      Add(i, weights_[i], matrix_, right_);
    }
    // In units of the patches' noise.
    const Eigen::VectorXd priors = noise_ * priors_;
    matrix_.diagonal() += priors;
    right_ -= priors.cwiseProduct(answer_);
    return {};
  }

  /// Of the logarithm of grey values, summed over a patch: what noise shows.
  static constexpr double kFloor = kPatch * 0.01 * 0.01;

  const SensorRig& rig_;
  std::vector<View>& views_;
  std::vector<FollowedPoint> points_;
  const TurnCheckOptions& options_;
  Eigen::Index unknowns_;
  Unknowns answer_;
  Unknowns priors_;
  std::vector<PatchSays> says_;
  std::vector<double> weights_;
  double noise_ = 1.0;
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd right_;
};

std::vector<View> ViewsOf(const Scan& scan, int most_images) {
  std::vector<View> views;
  for (const CameraFrame& frame : scan.frames)
    if (frame.image.width() == scan.rig.camera.width &&
        frame.image.height() == scan.rig.camera.height && std::isfinite(frame.motor_angle_rad))
      views.push_back(
          {&frame, scan.rig.angle_correction.PlateAngle(frame.motor_angle_rad), 0.0, {}, {}});
  std::stable_sort(views.begin(), views.end(),
                   [](const View& a, const View& b) { return a.plate_rad < b.plate_rad; });
  if (std::ssize(views) > most_images) {
    std::vector<View> some;
    for (int i = 0; i < most_images; ++i)
      some.push_back(views[(views.size() - 1) * static_cast<std::size_t>(i) /
                           static_cast<std::size_t>(most_images - 1)]);
    views = std::move(some);
  }
  for (View& view : views) view.log_gray = LogGray(view.frame->image);
  if (views.empty()) return views;
  const double first = views.front().plate_rad, last = views.back().plate_rad;
  for (View& view : views)
    if (last > first)
      view.bend = 1.0 - std::pow((2.0 * view.plate_rad - first - last) / (last - first), 2);
  return views;
}

/// Without the mean of a square a dozen blurs wide.
void UseBlur(std::vector<View>& views, double blur_px) {
  for (View& view : views) {
    view.band = Blurred(view.log_gray, blur_px);
    const FloatImage wide = BoxMean(view.log_gray, 2 * static_cast<int>(6.0 * blur_px) + 1);
    for (std::size_t at = 0; at < wide.size(); ++at) view.band.values()[at] -= wide.values()[at];
  }
}

std::vector<FollowedPoint> PointsToFollow(const Scan& scan, const RegisteredScan& cloud,
                                          const std::vector<View>& views, double blur_px,
                                          const TurnCheckOptions& options,
                                          const RunContext& context) {
  const std::size_t pairs = views.size() * (views.size() - 1) / 2;
  const std::size_t most = std::min(static_cast<std::size_t>(options.most_points),
                                    static_cast<std::size_t>(options.most_points_in_all) / pairs);
  std::vector<FollowedPoint> followed;
  std::vector<double> azimuths;
  for (std::size_t from = 0; from < views.size(); ++from) {
    const std::vector<SeenPoint> seen = PointsOf(scan, cloud, views[from], blur_px, most);
    if (context.Cancelled()) break;
    for (std::size_t to = from + 1; to < views.size(); ++to) {
      if (views[to].plate_rad - views[from].plate_rad > options.most_apart_rad) continue;
      for (const SeenPoint& point : seen) {
        FollowedPoint follow{from, to, 0, {}, {}};
        bool all = true;
        for (int i = 0; i < kPatch && all; ++i) {
          const Eigen::Vector2d pixel =
              point.pixel + kStep_px * Eigen::Vector2d(i % kSide - 1, i / kSide - 1);
          const auto ray = scan.rig.camera.Unproject(pixel);
          all = ray.has_value();
          if (!all) break;
          follow.pixels[static_cast<std::size_t>(i)] = pixel;
          follow.in_camera[static_cast<std::size_t>(i)] = point.range_m * *ray;
        }
        if (!all) continue;
        followed.push_back(follow);
        azimuths.push_back(point.azimuth_rad);
      }
    }
  }
  const std::vector<int> groups = NeighbourGroups(azimuths, options.groups);
  for (std::size_t i = 0; i < followed.size(); ++i) followed[i].group = groups[i];
  return followed;
}

}  // namespace

Result<TurnCheck> CheckTurns(const Scan& scan, const RegisteredScan& cloud,
                             const TurnCheckOptions& options, const RunContext& context) {
  std::vector<View> views = ViewsOf(scan, options.most_images);
  TurnCheck check;
  check.images = static_cast<int>(views.size());
  if (check.images > 0) check.spread_rad = views.back().plate_rad - views.front().plate_rad;
  if (check.images < 2 || check.spread_rad < options.least_spread_rad)
    return Fail(ErrorCode::kTooFewPoints,
                "the scan has {} images, {:.0f} deg apart: take three, 10 deg and more apart",
                check.images, DegreesFromRadians(check.spread_rad));
  check.bend_seen = check.images >= 3;
  constexpr double kBlurs_px[] = {6.0, 3.0, 1.5};
  UseBlur(views, kBlurs_px[2]);
  TurnAdjustment adjustment(scan.rig, views,
                            PointsToFollow(scan, cloud, views, kBlurs_px[2], options, context),
                            check.bend_seen, options);
  constexpr int kSteps = 3;
  for (const double blur_px : kBlurs_px) {
    UseBlur(views, blur_px);
    FORESIGHT_CHECK(adjustment.Solve(kSteps, context));
  }
  check.points = adjustment.Followed();
  check.explained = adjustment.Explained();
  if (check.points < options.least_points || check.explained < options.least_explained)
    return Fail(ErrorCode::kTooFewPoints,
                "{} points could be followed from image to image, which explain {:.0f} % of what "
                "they show ({} and {:.0f} % are needed): scan where surfaces have a pattern",
                check.points, 100.0 * check.explained, options.least_points,
                100.0 * options.least_explained);
  check.drift = adjustment.answer().head<TurnCheck::kUnknowns>();
  check.covariance =
      adjustment.Covariance().topLeftCorner<TurnCheck::kUnknowns, TurnCheck::kUnknowns>();
  if (!check.bend_seen) {
    check.drift[TurnCheck::kBend] = 0.0;
    check.covariance.row(TurnCheck::kBend).setZero();
    check.covariance.col(TurnCheck::kBend).setZero();
    check.covariance(TurnCheck::kBend, TurnCheck::kBend) = std::numeric_limits<double>::infinity();
  }
  return check;
}

}  // namespace foresight
