#include "ui/viewmodels/head_view_model.h"

#include <algorithm>
#include <cmath>

#include "core/depth/depth_method.h"
#include "core/depth/local_plane.h"
#include "core/geometry/angles.h"
#include "core/sensor/rig_id.h"
#include "hardware/head/scan_fanout.h"

namespace foresight {
namespace {

constexpr int kHeadPollInterval_ms = 100;
constexpr int kDetailsPeriod_ms = 1000;
constexpr int kPollsPerLook = 3;  ///< a running scan is looked at about three times a second
/// A head that neither sweeps nor has begun the scan after so many polls has lost it.
constexpr int kPollsUntilLost = 30;
/// For so many polls after its end a scan is looked at for late lines.
constexpr int kPollsForLateLines = 20;

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

/// Whether an operator could tell the two apart.
bool LooksSame(const HeadStatus& a, const HeadStatus& b) {
  const auto same = [](double x_rad, double y_rad, double step_deg) {
    return std::lround(DegreesFromRadians(x_rad) / step_deg) ==
           std::lround(DegreesFromRadians(y_rad) / step_deg);
  };
  return a.state == b.state && same(a.angle_rad, b.angle_rad, 0.01) &&
         same(a.speed_rad_s, b.speed_rad_s, 0.1) &&
         same(a.commanded_speed_rad_s, b.commanded_speed_rad_s, 0.1) && a.lines == b.lines &&
         a.expected_lines == b.expected_lines && a.frames == b.frames &&
         a.lost_lines == b.lost_lines && a.message == b.message;
}

/// Whole seconds, so that the row does not change ten times a second.
QString SecondsText(double seconds) {
  if (!std::isfinite(seconds)) return HeadViewModel::tr("no end in sight");
  return HeadViewModel::tr("%1 s").arg(seconds, 0, 'f', 0);
}

DeviceRow LinkRow(const LinkHealth& link) {
  DeviceRow row;
  row.name = HeadViewModel::tr("Link");
  if (!link.connected) {
    row.lamp = DeviceRow::Lamp::kMissing;
    row.state = HeadViewModel::tr("lost");
    row.detail = HeadViewModel::tr("no word from %1 for %2. %3")
                     .arg(QString::fromStdString(link.address), SecondsText(link.age_s),
                          QString::fromStdString(link.trouble));
    return row;
  }
  row.lamp = link.has_control ? DeviceRow::Lamp::kWell : DeviceRow::Lamp::kDegraded;
  row.state = link.has_control ? HeadViewModel::tr("well") : HeadViewModel::tr("looking on");
  row.detail = HeadViewModel::tr("%1: round trip %2 ms, last word %3 ago, %4 kB/s")
                   .arg(QString::fromStdString(link.address))
                   .arg(1e3 * link.round_trip_s, 0, 'f', 0)
                   .arg(SecondsText(link.age_s))
                   .arg(1e-3 * link.down_bytes_per_s, 0, 'f', 0);
  if (link.left_bytes > 0)
    row.detail += HeadViewModel::tr("; %1 kB of scans to come, %2 to go")
                      .arg(1e-3 * static_cast<double>(link.left_bytes), 0, 'f', 0)
                      .arg(SecondsText(link.left_s));
  if (!link.has_control)
    row.detail +=
        link.holder.empty()
            ? HeadViewModel::tr("; nobody has control")
            : HeadViewModel::tr("; %1 has control").arg(QString::fromStdString(link.holder));
  return row;
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
  plan.image_mode =
      standing_still ? ScanPlan::ImageMode::kStopAndShoot : ScanPlan::ImageMode::kOnTheFly;
  plan.passes = there_and_back ? 2 : 1;
  return plan;
}

HeadViewModel::HeadViewModel(std::shared_ptr<SensorHead> head, QObject* parent)
    : QObject(parent), head_(std::move(head)), status_(head_->Status()) {
  since_start_.start();
  PollHealth();
  PollAnswers();
  ShowDevices();
  connect(&timer_, &QTimer::timeout, this, &HeadViewModel::Poll);
  timer_.start(kHeadPollInterval_ms);
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

/// Numbers that change all the time are shown once a second: each change draws the window.
void HeadViewModel::ShowDevices() {
  const QVector<DeviceRow> now = DescribeDevices();
  const bool only_details = std::equal(now.begin(), now.end(), devices_.begin(), devices_.end(),
                                       [](const DeviceRow& a, const DeviceRow& b) {
                                         return a.name == b.name && a.lamp == b.lamp &&
                                                a.state == b.state &&
                                                a.detail.isEmpty() == b.detail.isEmpty();
                                       });
  if (only_details && details_shown_.elapsed() < kDetailsPeriod_ms) return;
  devices_ = now;
  details_shown_.start();
}

QVector<DeviceRow> HeadViewModel::DescribeDevices() const {
  const QStringList names = {tr("Lidar"), tr("Camera"), tr("Motor")};
  QVector<DeviceRow> rows;
  if (!answers_.Current()) {
    const QString detail = tr("no word of it for %1").arg(answers_.Silence());
    for (const QString& name : names)
      rows << DeviceRow{name, DeviceRow::Lamp::kIdle, tr("not known"), detail};
    rows << LinkRow(*link_health_);
    return rows;
  }
  if (status_.state == HeadState::kDisconnected) {
    for (const QString& name : names)
      rows << DeviceRow{name, DeviceRow::Lamp::kIdle, tr("not connected yet"), {}};
    if (link_health_) rows << LinkRow(*link_health_);
    return rows;
  }
  rows << RowOf(names[0], diagnosis_.lidar, Describe(status_.health.lidar))
       << RowOf(names[1], diagnosis_.camera, Describe(status_.health.camera))
       << RowOf(names[2], diagnosis_.motor, Describe(status_.health.motor));
  if (link_health_) rows << LinkRow(*link_health_);
  return rows;
}

std::function<Status()> HeadViewModel::RigChange(const SensorRig& rig) const {
  return [head = head_, rig]() -> Status {
    FORESIGHT_CHECK(head->SetRig(rig));
    if (const std::string id = RigId(head->Rig()); id != RigId(rig))
      return Fail(
          ErrorCode::kInvalidInput,
          "the head was given the rig {} and says that it has {}; put the rig in force again",
          RigId(rig).substr(0, 8), id.substr(0, 8));
    return {};
  };
}

void HeadViewModel::ShowRig() {
  Q_EMIT statusChanged();
  Q_EMIT planChanged();  // what a plan gives depends on the camera
}

QString HeadViewModel::RigText() const {
  const SensorRig rig = head_->Rig();
  const std::string_view model = rig.camera.Name();
  return tr("Rig %1, %2\nCamera model: %3")
      .arg(QString::fromStdString(rig.name), QString::fromStdString(ShortRigId(rig)),
           QString::fromUtf8(model.data(), static_cast<int>(model.size())));
}

bool HeadViewModel::CanEditPlan() const {
  return (!live_ || Receiving()) && status_.state != HeadState::kHoming &&
         status_.state != HeadState::kSweeping && status_.state != HeadState::kStopping;
}

bool HeadViewModel::CanScan() const {
  return WhyNoScan().isEmpty();
}

QString HeadViewModel::WhyNoScan() const {
  if (const QString why = WhyNoCapture(); !why.isEmpty()) return why;
  const PredictionText prediction = Prediction();
  return prediction.usable ? QString() : prediction.warning;
}

/// Without the seconds: a reason that changes would draw every button that shows it.
QString HeadViewModel::WhyNoWord() const {
  return tr("The link is lost. Wait until the head is heard again.");
}

QString HeadViewModel::WhyNoCapture() const {
  if (StopLatched()) return tr("The head was stopped. Release the stop first.");
  if (!answers_.Current()) return WhyNoWord();
  if (live_ && !Receiving()) return tr("A scan is running.");
  if (status_.state != HeadState::kReady)
    return tr("The head is %1. Press Home and wait until it is ready.")
        .arg(QString::fromUtf8(ToString(status_.state)));
  return {};
}

bool HeadViewModel::Receiving() const {
  if (!live_ || head_->Link() == nullptr || status_.state != HeadState::kReady) return false;
  return early_ != nullptr || live_->Snapshot() != nullptr;
}

bool HeadViewModel::CanAbort() const {
  return status_.state == HeadState::kSweeping;
}

bool HeadViewModel::CanHome() const {
  return WhyNoHome().isEmpty();
}

QString HeadViewModel::WhyNotDuringScan() const {
  return Scanning() ? tr("A scan is running; wait for its end.") : QString();
}

QString HeadViewModel::WhyNoHome() const {
  if (StopLatched()) return tr("The head was stopped. Release the stop first.");
  if (!answers_.Current()) return WhyNoWord();
  switch (status_.state) {
    case HeadState::kDisconnected:
    case HeadState::kReady:
    case HeadState::kFault:
      return {};
    case HeadState::kHoming:
    case HeadState::kSweeping:
    case HeadState::kStopping:
      break;
  }
  return tr("The head is moving.");
}

bool HeadViewModel::Sweeps() const {
  return status_.state == HeadState::kSweeping || status_.state == HeadState::kStopping;
}

bool HeadViewModel::HasControl() const {
  return !link_health_ || link_health_->has_control;
}

bool HeadViewModel::OwnSweep() const {
  return live_ != nullptr && !own_sweep_over_;
}

bool HeadViewModel::MovesForUs() const {
  return OwnSweep() || (CanAbort() && HasControl());
}

void HeadViewModel::Poll() {
  head_->OperatorSeen();  // a window that hangs does not say so, and the head stops its motor
  const HeadStatus before = status_;
  const QVector<DeviceRow> devices_before = devices_;
  const bool scanned = Scanning();
  const QString text_before = answers_.Text();
  status_ = head_->Status();
  PollHealth();
  PollAnswers();
  ShowDevices();
  if (live_) PollScan();
  // What the head sweeps later, while the scan still comes, may be another operator's.
  if (Receiving()) own_sweep_over_ = true;
  if (ended_) PollLateLines();
  // A signal for nothing would draw the window again, ten times a second.
  if (!LooksSame(before, status_) || scanned != Scanning() || devices_before != devices_ ||
      text_before != answers_.Text())
    Q_EMIT statusChanged();
}

void HeadViewModel::PollHealth() {
  const double now_s = 1e-3 * static_cast<double>(since_start_.elapsed());
  diagnosis_ = health_watch_.Update(now_s, status_.health);
}

void HeadViewModel::PollAnswers() {
  const HeadLink* link = head_->Link();
  link_health_ = link == nullptr ? std::nullopt : std::optional(link->Health());
  const double now_s = 1e-3 * static_cast<double>(since_start_.elapsed());
  const HeadAnswers::News news = answers_.Update(now_s, link_health_, status_.state);
  for (const QString& topic : news.over) Q_EMIT settled(topic);
  for (const Notice& notice : news.notices) Q_EMIT noticed(notice);
}

void HeadViewModel::PollScan() {
  // An image is shown as soon as it is there; lines may wait for the next look.
  const bool new_image = status_.frames != frames_shown_;
  // Over a link lines come when they come, also after the sweep.
  HeadLink* link = head_->Link();
  const bool over_link = link != nullptr;
  const bool look =
      new_image || (++polls_ % kPollsPerLook == 0 && (over_link || status_.lines != lines_shown_));
  if (Sweeps() && !look) return;
  const auto early = over_link ? link->Early() : nullptr;
  if (early != nullptr && early != std::exchange(early_, early)) Q_EMIT scanCame(early);
  const auto scan = live_->Snapshot();
  if (!scan) {
    // Accepted, and then neither begun nor refused: the head was lost, or began anew. Over a link
    // that may take a blackout, and the end comes whatever happens.
    polls_without_scan_ = Sweeps() || over_link ? 0 : polls_without_scan_ + 1;
    if (polls_without_scan_ < kPollsUntilLost) return;
    live_.reset();
    Q_EMIT noticed({Notice::Level::kError, tr("The head did not begin the scan."),
                    tr("Check its state, press Home, then scan again."), kScanTopic});
    Q_EMIT scanLost();
    return;
  }
  if (scan->state != ScanState::kRunning) {
    ended_ = std::exchange(live_, nullptr);
    lines_of_ended_ = scan->lines.size();
    polls_since_end_ = 0;
    Q_EMIT scanEnded(scan);
  } else if (look && early == nullptr) {
    lines_shown_ = status_.lines;
    frames_shown_ = status_.frames;
    Q_EMIT scanGrew(scan);
  }
}

void HeadViewModel::PollLateLines() {
  if (++polls_since_end_ > kPollsForLateLines) {
    ended_.reset();
    return;
  }
  const auto scan = ended_->Snapshot();
  if (scan->lines.size() == lines_of_ended_) return;
  lines_of_ended_ = scan->lines.size();
  Q_EMIT scanEnded(scan);
}

void HeadViewModel::scan() {
  if ((live_ && !Receiving()) || StopLatched()) return;
  auto live = std::make_shared<ScanAssembler>();
  std::vector<std::shared_ptr<ScanSink>> sinks = {live};
  if (auto recorder = recorder_source_ ? recorder_source_() : nullptr) sinks.push_back(recorder);
  auto fanout = std::make_shared<ScanFanout>(std::move(sinks));
  if (const auto started = head_->StartScan(plan_.ToPlan(), fanout); !started) {
    Q_EMIT noticed(NoticeOf(tr("Starting the scan"), started.error()));
    return;
  }
  live_ = std::move(live);
  own_sweep_over_ = false;
  early_.reset();
  ended_.reset();
  polls_ = polls_without_scan_ = lines_shown_ = frames_shown_ = 0;
  Q_EMIT scanStarted();
  Poll();
  Q_EMIT statusChanged();
}

Status HeadViewModel::StartStops(const StopPlan& plan, std::shared_ptr<StopSink> sink) {
  if (StopLatched()) return Fail(ErrorCode::kState, "the head was stopped; release the stop first");
  FORESIGHT_CHECK(head_->StartStops(plan, std::move(sink)));
  Poll();
  return {};
}

Status HeadViewModel::StartUnrecordedScan(const ScanPlan& plan, std::shared_ptr<ScanSink> sink) {
  if (StopLatched()) return Fail(ErrorCode::kState, "the head was stopped; release the stop first");
  FORESIGHT_CHECK(head_->StartScan(plan, std::move(sink)));
  Poll();
  return {};
}

Status HeadViewModel::StartLiveView(const LiveViewOptions& options,
                                    std::shared_ptr<LiveViewSink> sink) {
  FORESIGHT_CHECK(head_->StartLiveView(options, std::move(sink)));
  Q_EMIT liveViewTaken();
  return {};
}

void HeadViewModel::StopLiveView() {
  head_->StopLiveView();
}

void HeadViewModel::StopForGood() {
  const bool sweeps = OwnSweep();
  if (sweeps) head_->AbortScan();
  if (sweeps || HasControl()) {
    head_->StopMotor();
    answers_.StopPressed();
  }
  Poll();
  Q_EMIT statusChanged();
}

void HeadViewModel::abort() {
  head_->AbortScan();
  answers_.AbortPressed();
  Poll();
}

void HeadViewModel::home() {
  if (StopLatched()) return;
  if (const auto homing = head_->Home(); !homing)
    Q_EMIT noticed(NoticeOf(tr("Homing the head"), homing.error()));
  Poll();
}

void HeadViewModel::stop() {
  head_->StopMotor();
  answers_.StopPressed();
  Poll();
  Q_EMIT statusChanged();
}

void HeadViewModel::releaseStop() {
  if (!StopLatched()) return;
  answers_.StopReleased();
  Q_EMIT stopReleased();
  Q_EMIT statusChanged();
}

}  // namespace foresight
