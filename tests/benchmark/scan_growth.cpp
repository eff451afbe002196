// What the workstation's own thread does while a scan of 10,000 lines grows: CPU time from one look
// at the scan to the next, with all that its view-models do about it. Writes scan-growth.csv and
// scan-growth.svg.
//   scan_growth FOLDER [LINES]
// Every look brings 12 lines, as 0.3 s of a sweep do. The curve should be flat.
#include <ctime>

#include <QCoreApplication>
#include <QTemporaryDir>

#include "app/workstation/workbench.h"
#include "core/base/atomic_file.h"
#include "core/geometry/angles.h"
#include "core/pictures/line_chart.h"
#include "core/simulation/world.h"
#include "tests/ui/fake_head.h"
#include "tests/ui/wait_for.h"

namespace foresight {
namespace {

constexpr int kLinesPerLook = 12;
constexpr int kPollsPerLook = 3;
constexpr int kLooksPerPoint = 25;
constexpr int kDifferentLines = 200;
constexpr int kSamplesPerLine = 6;
constexpr int kWaitingLines = 3;

double ThreadCpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// The default head with a small camera: the live depth of a large image is another thread's.
SensorRig SmallCameraRig() {
  SensorRig rig = DefaultSensorRig();
  for (int* size : {&rig.camera.width, &rig.camera.height}) *size /= 8;
  for (double* length_px : {&rig.camera.fx, &rig.camera.fy, &rig.camera.cx, &rig.camera.cy})
    *length_px /= 8.0;
  return rig;
}

/// A slow sweep from -60 to 60 deg, line by line.
class SlowSweep {
 public:
  explicit SlowSweep(int lines)
      : rig_(SmallCameraRig()),
        world_(std::make_shared<const Scene>(
                   LoadScene(FORESIGHT_SOURCE_DIR "/resources/scenes/valve.yaml").value()),
               rig_, {}) {
    const double duration_s = lines * rig_.lidar.period_s;
    header_.uuid = NewUuid();
    header_.rig = rig_;
    header_.simulated = true;
    header_.plan.from_rad = RadiansFromDegrees(-60.0);
    header_.plan.to_rad = RadiansFromDegrees(60.0);
    header_.plan.speed_rad_s = RadiansFromDegrees(120.0) / duration_s;
    header_.plan.image_angles_rad = {RadiansFromDegrees(-55.0)};
    const double line_step_rad = RadiansFromDegrees(120.0) / kDifferentLines;
    for (int i = 0; i < kDifferentLines; ++i)
      lines_.push_back(world_.MeasureLine(
          0, 0.0, [&](double) { return header_.plan.from_rad + i * line_step_rad; }));
  }
  const Scan& Header() const { return header_; }
  LidarLine Line(int seq, int lines) const {
    LidarLine line = lines_[static_cast<std::size_t>(std::int64_t{seq} * kDifferentLines / lines)];
    line.seq = seq;
    line.time_s = seq * rig_.lidar.period_s;
    return line;
  }
  double AngleAt(double time_s) const {
    return header_.plan.from_rad + header_.plan.speed_rad_s * time_s;
  }
  CameraFrame Image() const {
    return world_.CaptureImage(0, 0.1, 0.004, 0.0,
                               [this](double) { return header_.plan.image_angles_rad[0]; }, {});
  }
  double period_s() const { return rig_.lidar.period_s; }

 private:
  SensorRig rig_;
  World world_;
  Scan header_;
  std::vector<LidarLine> lines_;
};

Status Run(const std::filesystem::path& folder, int lines) {
  const SlowSweep sweep(lines);
  const auto head = std::make_shared<FakeHead>(sweep.Header().rig);
  Workbench bench(head, SessionMode::kSimulation);
  const QTemporaryDir missions;
  if (!bench.recording.BeginInFolder(missions.path()))
    return Fail(ErrorCode::kIo, "no mission file in the temporary folder");
  PlanFields plan;
  plan.from_deg = -60.0;
  plan.to_deg = 60.0;
  plan.speed_deg_s = DegreesFromRadians(sweep.Header().plan.speed_rad_s);
  plan.image_angles_deg = {-55.0};
  bench.head.SetPlan(plan);
  bench.head.scan();
  head->Begin(sweep.Header());

  int cloud_lines = 0;
  QObject::connect(&bench.live.session, &SessionModel::cloudChanged, [&] {
    if (const auto& cloud = bench.live.session.Cloud()) cloud_lines = cloud->lines;
  });

  ChartSeries mean{"mean of 25 looks", {}}, worst{"worst of 25", {}};
  std::string csv = "lines,mean_ms,worst_ms\n";
  double sum_ms = 0.0, worst_ms = 0.0;
  int looks = 0;
  for (int seq = 0; seq < lines;) {
    for (int i = 0; i < kLinesPerLook && seq < lines; ++i, ++seq) {
      for (int s = 0; s < kSamplesPerLine; ++s) {
        const double time_s = sweep.period_s() * (seq + static_cast<double>(s) / kSamplesPerLine);
        head->DeliverMotor({time_s, sweep.AngleAt(time_s)});
      }
      head->DeliverLine(sweep.Line(seq, lines));
    }
    if (seq == kLinesPerLook) head->DeliverFrame(sweep.Image());
    const double before_ms = ThreadCpu_ms();
    for (int poll = 0; poll < kPollsPerLook; ++poll) bench.head.Poll();
    // The preview of the depth takes as long as it takes, as in the program. The newest lines wait
    // for the motor's track.
    WaitFor([&] { return cloud_lines >= seq - kWaitingLines; }, 2000);
    const double took_ms = ThreadCpu_ms() - before_ms;
    sum_ms += took_ms;
    worst_ms = std::max(worst_ms, took_ms);
    if (++looks % kLooksPerPoint != 0) continue;
    mean.points.emplace_back(seq, sum_ms / kLooksPerPoint);
    worst.points.emplace_back(seq, worst_ms);
    csv += fmt::format("{},{:.3f},{:.3f}\n", seq, sum_ms / kLooksPerPoint, worst_ms);
    sum_ms = worst_ms = 0.0;
  }
  head->EndScan("all lines have come");
  bench.head.Poll();
  WaitFor([&] { return bench.recording.Waiting() == 0 && !bench.recording.Busy(); });
  fmt::print("{}", csv);
  FORESIGHT_CHECK(WriteFileAtomically(folder / "scan-growth.csv", csv));
  return WriteFileAtomically(folder / "scan-growth.svg",
                             SvgOf({"Work of the window's thread for each look at a growing scan",
                                    {"lines in the scan", "", false, true},
                                    {"CPU time", "ms", false, true},
                                    {mean, worst}}));
}

}  // namespace
}  // namespace foresight

int main(int argc, char** argv) {
  const QCoreApplication application(argc, argv);
  if (argc < 2) {
    fmt::print(stderr, "usage: scan_growth FOLDER [LINES]\n");
    return 2;
  }
  const auto status = foresight::Run(argv[1], argc > 2 ? std::atoi(argv[2]) : 10'000);
  if (!status) fmt::print(stderr, "{}\n", status.error().message);
  return status ? 0 : 3;
}
