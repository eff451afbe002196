#include "ui/viewmodels/head_view_model.h"

#include <algorithm>
#include <cmath>

#include "core/depth/depth_method.h"
#include "core/depth/local_plane.h"
#include "core/geometry/angles.h"
#include "hardware/head/scan_fanout.h"

namespace foresight {
namespace {

constexpr int kPollInterval_ms = 100;
constexpr int kPollsPerLook = 3;  ///< a running scan is looked at about four times a second

/// The reach of the filter that a new scan is computed with, and the method's name.
void DescribeFilter(double density, PredictionText* text) {
  const DepthMethodInfo& method = DepthMethods().front();
  const double sigma_px = method.method == DepthMethod::kForesight
                              ? LocalPlaneSigmaForDensity(density)
                              : SpatialSigmaForDensity(density);
  text->sigma = HeadViewModel::tr("%1 px").arg(sigma_px, 0, 'f', 1);
  text->method = QString::fromUtf8(method.title);
}

QString DescribeExposure(double wanted_ms, const ScanPrediction& prediction) {
  const double used_ms = 1e3 * prediction.exposure_s;
  const QString text = HeadViewModel::tr("%1 ms").arg(used_ms, 0, 'f', 1);
  return used_ms < wanted_ms - 0.05 ? HeadViewModel::tr("%1, shortened").arg(text) : text;
}

double FastestSpeed(const ScanPrediction& prediction) {
  return std::floor(10.0 * DegreesFromRadians(prediction.fastest_speed_rad_s) + 1e-6) / 10.0;
}

DeviceRow RowOf(const QString& name, const DeviceDiagnosis& diagnosis, const std::string& numbers) {
  using Lamp = DeviceRow::Lamp;
  const auto problem = QString::fromStdString(diagnosis.problem);
  const auto values = QString::fromStdString(numbers);
  switch (diagnosis.condition) {
    case DeviceCondition::kWell:
      return {name, Lamp::kWell, HeadViewModel::tr("well"), values};
    case DeviceCondition::kDegraded:
      return {name, Lamp::kDegraded, HeadViewModel::tr("degraded"),
              values + QLatin1Char('\n') + problem};
    case DeviceCondition::kMissing:
      break;
  }
  return {name, Lamp::kMissing, HeadViewModel::tr("missing"), problem};
}

}  // namespace

ScanPlan PlanFields::ToPlan() const {
  ScanPlan plan;
  plan.from_rad = RadiansFromDegrees(from_deg);
  plan.to_rad = RadiansFromDegrees(to_deg);
  plan.speed_rad_s = RadiansFromDegrees(speed_deg_s);
  plan.exposure_s = exposure_ms * 1e-3;
  plan.image_angles_rad.clear();
  for (const double angle : image_angles_deg)
    plan.image_angles_rad.push_back(RadiansFromDegrees(angle));
  plan.picture_mode =
      standing_still ? ScanPlan::PictureMode::kStopAndShoot : ScanPlan::PictureMode::kOnTheFly;
  plan.passes = there_and_back ? 2 : 1;
  return plan;
}

HeadViewModel::HeadViewModel(std::shared_ptr<SensorHead> head, QObject* parent)
    : QObject(parent), head_(std::move(head)), status_(head_->Status()) {
  since_start_.start();
  PollHealth();
  connect(&timer_, &QTimer::timeout, this, &HeadViewModel::Poll);
  timer_.start(kPollInterval_ms);
}

HeadViewModel::~HeadViewModel() {
  if (live_) head_->AbortScan();
}

void HeadViewModel::SetPlan(const PlanFields& plan) {
  plan_ = plan;
  Q_EMIT planChanged();
}

PredictionText HeadViewModel::Prediction() const {
  const auto prediction = PredictScan(plan_.ToPlan(), head_->Rig(), head_->Motion());
  PredictionText text;
  if (!prediction) {
    text.time = text.lines = text.coverage = text.sigma = text.exposure = QStringLiteral("–");
    text.warning = QString::fromStdString(prediction.error().message);
    text.usable = false;
    return text;
  }
  text.time = tr("%1 s").arg(prediction->duration_s, 0, 'f', 1);
  text.lines = QString::number(prediction->lines);
  text.coverage = tr("%1 %").arg(100.0 * prediction->density, 0, 'f', 1);
  DescribeFilter(prediction->density, &text);
  text.exposure = DescribeExposure(plan_.exposure_ms, *prediction);
  text.fastest_deg_s = FastestSpeed(*prediction);
  if (prediction->density < ScanPrediction::kMinDensity) {
    text.warning = tr("Coverage is under the floor of 2\u00a0%: the depth will be coarse. "
                      "Scan at %1\u00a0°/s or slower.")
                       .arg(text.fastest_deg_s, 0, 'f', 1);
  }
  return text;
}

void HeadViewModel::useFastestSpeed() {
  const double fastest_deg_s = Prediction().fastest_deg_s;
  if (!CanEditPlan() || !(fastest_deg_s > 0.0)) return;
  PlanFields plan = plan_;
  plan.speed_deg_s = fastest_deg_s;
  SetPlan(plan);
}

double HeadViewModel::ScanProgress() const {
  if (status_.expected_lines <= 0) return 0.0;
  return std::clamp(static_cast<double>(status_.lines) / status_.expected_lines, 0.0, 1.0);
}

QVector<DeviceRow> HeadViewModel::Devices() const {
  const QStringList names = {tr("Lidar"), tr("Camera"), tr("Motor")};
  QVector<DeviceRow> rows;
  if (status_.state == HeadState::kDisconnected) {
    for (const QString& name : names)
      rows << DeviceRow{name, DeviceRow::Lamp::kIdle, tr("not connected yet"), {}};
    return rows;
  }
  rows << RowOf(names[0], diagnosis_.lidar, Describe(status_.health.lidar))
       << RowOf(names[1], diagnosis_.camera, Describe(status_.health.camera))
       << RowOf(names[2], diagnosis_.motor, Describe(status_.health.motor));
  return rows;
}

bool HeadViewModel::CanEditPlan() const {
  return !live_ && status_.state != HeadState::kHoming && status_.state != HeadState::kSweeping &&
         status_.state != HeadState::kStopping;
}

bool HeadViewModel::CanScan() const {
  return status_.state == HeadState::kReady && !live_ && Prediction().usable;
}

bool HeadViewModel::CanAbort() const {
  return status_.state == HeadState::kSweeping;
}

bool HeadViewModel::CanHome() const {
  return status_.state == HeadState::kDisconnected || status_.state == HeadState::kReady ||
         status_.state == HeadState::kFault;
}

void HeadViewModel::Poll() {
  head_->OperatorSeen();  // a window that hangs does not say so, and the head stops its motor
  status_ = head_->Status();
  PollHealth();
  if (live_) PollScan();
  Q_EMIT statusChanged();
}

void HeadViewModel::PollHealth() {
  const double now_s = 1e-3 * static_cast<double>(since_start_.elapsed());
  diagnosis_ = health_watch_.Update(now_s, status_.health);
}

void HeadViewModel::PollScan() {
  const bool under_way =
      status_.state == HeadState::kSweeping || status_.state == HeadState::kStopping;
  const bool look = ++polls_ % kPollsPerLook == 0 && status_.lines != lines_shown_;
  if (under_way && !look) return;  // a snapshot is a copy of the scan
  const auto scan = live_->Snapshot();
  if (!scan) return;
  if (scan->state != ScanState::kRunning) {
    live_.reset();
    Q_EMIT scanEnded(scan);
  } else if (look) {
    lines_shown_ = status_.lines;
    Q_EMIT scanGrew(scan);
  }
}

void HeadViewModel::scan() {
  if (live_) return;
  auto live = std::make_shared<ScanAssembler>();
  std::vector<std::shared_ptr<ScanSink>> sinks = {live};
  if (auto recorder = recorder_source_ ? recorder_source_() : nullptr) sinks.push_back(recorder);
  auto fanout = std::make_shared<ScanFanout>(std::move(sinks));
  if (const auto started = head_->StartScan(plan_.ToPlan(), fanout); !started) {
    Q_EMIT noticed(NoticeOf(tr("Starting the scan"), started.error()));
    return;
  }
  live_ = std::move(live);
  polls_ = lines_shown_ = 0;
  Q_EMIT scanStarted();
  Poll();
}

void HeadViewModel::StopForGood() {
  if (live_) head_->AbortScan();
  head_->StopMotor();
  Poll();
}

void HeadViewModel::abort() {
  head_->AbortScan();
}

void HeadViewModel::home() {
  if (const auto homing = head_->Home(); !homing)
    Q_EMIT noticed(NoticeOf(tr("Homing the head"), homing.error()));
  Poll();
}

void HeadViewModel::stop() {
  head_->StopMotor();
  Q_EMIT noticed({Notice::Level::kWarning, tr("The head's motor was told to stop."),
                  tr("This stops the scanner only, not the robot. Press Home to go on.")});
  Poll();
}

}  // namespace foresight
