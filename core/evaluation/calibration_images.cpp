#include "core/evaluation/calibration_images.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "core/base/contract.h"
#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/calibration/session_file.h"
#include "core/io/png.h"

namespace foresight {
namespace {

constexpr double kPaper_m = 0.010;  ///< white around the squares
constexpr float kWhite = 215.0f, kBlack = 35.0f, kWall = 120.0f;

/// Grey of a board at a ray from the camera, and how far; nullopt where the ray misses it.
struct Hit {
  double distance = std::numeric_limits<double>::infinity();
  float grey = kWall;
};

class Target {
 public:
  explicit Target(const BoardPainter::PlacedBoard& placed)
      : board_(placed.board),
        board_from_camera_(placed.camera_from_board.Inverse()),
        rotation_(board_from_camera_.RotationMatrix()) {}

  void Meet(const Eigen::Vector3d& ray, Hit* hit) const {
    const Eigen::Vector3d direction = rotation_ * ray;
    const Eigen::Vector3d& from = board_from_camera_.translation();
    const double distance = -from.z() / direction.z();
    if (!(distance > 0.0) || distance >= hit->distance) return;
    const double x = from.x() + distance * direction.x() + board_.square_m;
    const double y = from.y() + distance * direction.y() + board_.square_m;
    if (x < -kPaper_m || y < -kPaper_m || x > board_.Width() + kPaper_m ||
        y > board_.Height() + kPaper_m)
      return;
    hit->distance = distance;
    const bool on_squares = x >= 0.0 && y >= 0.0 && x < board_.Width() && y < board_.Height();
    const bool black =
        on_squares && CalibrationBoard::IsBlack(static_cast<int>(x / board_.square_m),
                                                static_cast<int>(y / board_.square_m));
    hit->grey = black ? kBlack : kWhite;
  }

 private:
  CalibrationBoard board_;
  Rigid<frame::Pattern, frame::Camera> board_from_camera_;
  Eigen::Matrix3d rotation_;
};

}  // namespace

BoardPainter::BoardPainter(const CameraModel& camera)
    : width_(camera.width), height_(camera.height) {
  rays_.reserve(static_cast<std::size_t>(width_ + 1) * static_cast<std::size_t>(height_ + 1));
  for (int y = 0; y <= height_; ++y)
    for (int x = 0; x <= width_; ++x) {
      const auto ray = camera.Unproject({x - 0.5, y - 0.5});
      rays_.push_back(ray ? Eigen::Vector3f(ray->cast<float>())
                          : Eigen::Vector3f::Constant(std::nanf("")));
    }
}

GrayImage BoardPainter::Paint(const std::vector<PlacedBoard>& boards, double noise_levels,
                              std::uint64_t seed) const {
  constexpr int kSide = 4;  // samples a side of a pixel
  std::vector<Target> targets;
  for (const PlacedBoard& placed : boards) {
    FORESIGHT_EXPECTS(placed.board.kind == CalibrationBoard::Kind::kCheckerboard,
                      "markers are not painted");
    targets.emplace_back(placed);
  }
  Random random(seed);
  GrayImage image(width_, height_);
  const auto look = [&targets](const Eigen::Vector3d& ray) {
    Hit hit;
    for (const Target& target : targets) target.Meet(ray, &hit);
    return hit.grey;
  };
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_ + 1) +
                      static_cast<std::size_t>(x);
      const auto below = at + static_cast<std::size_t>(width_ + 1);
      const Eigen::Vector3d a = rays_[at].cast<double>(), b = rays_[at + 1].cast<double>(),
                            c = rays_[below].cast<double>(), d = rays_[below + 1].cast<double>();
      float grey = look(a);
      // Where all corners of a pixel see the same nothing is inside it but what is as small.
      if (grey != look(b) || grey != look(c) || grey != look(d)) {
        float sum = 0.0f;
        for (int i = 0; i < kSide * kSide; ++i) {
          const double u = (i % kSide + 0.5) / kSide, v = (i / kSide + 0.5) / kSide;
          sum += look((1.0 - v) * ((1.0 - u) * a + u * b) + v * ((1.0 - u) * c + u * d));
        }
        grey = sum / static_cast<float>(kSide * kSide);
      }
      const double noisy = grey + noise_levels * random.Normal();
      image(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(noisy), 0L, 255L));
    }
  return image;
}

Status WriteSimulatedImages(const SimulatedCalibration& made, std::uint64_t seed,
                            const std::filesystem::path& folder, const RunContext& context) {
  constexpr double kNoise = 2.0;
  const BoardPainter painter(made.truth.camera);
  struct Job {
    std::string file;
    std::vector<BoardPainter::PlacedBoard> boards;
    Status status;
  };
  std::vector<Job> jobs;
  const CalibrationSession& session = made.session;
  for (std::size_t i = 0; i < made.camera_from_view.size(); ++i)
    jobs.push_back({ImageNameOfView(i), {{session.intrinsic_board, made.camera_from_view[i]}}, {}});
  FORESIGHT_CHECK(WriteCalibrationSession(session, folder, SessionViews::kImages));
  std::atomic<int> done = 0;
  const int count = static_cast<int>(jobs.size());
  const bool finished = ParallelFor(count, context, [&](int i) {
    Job& job = jobs[static_cast<std::size_t>(i)];
    const auto stream = 1000 * seed + static_cast<std::uint64_t>(i);
    job.status = WritePng(folder / job.file, painter.Paint(job.boards, kNoise, stream));
    context.Report(static_cast<double>(++done) / count, "painting images");
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "simulated session: cancelled");
  for (const Job& job : jobs) FORESIGHT_CHECK(job.status);
  return {};
}

}  // namespace foresight
