#include "ui/viewmodels/fit_view_model.h"

#include <algorithm>
#include <cmath>

#include "core/detection/fit_option_table.h"
#include "core/mission/provenance.h"

namespace foresight {
namespace {

constexpr double kSameImage_rad = 1e-3;

bool Overlap(const PixelBox& a, const PixelBox& b) {
  const Eigen::Array2d shared = a.high.cwiseMin(b.high) - a.low.cwiseMax(b.low);
  const auto area = [](const Eigen::Array2d& sides) { return sides.max(0.0).prod(); };
  return area(shared) > 0.5 * std::min(area(a.high - a.low), area(b.high - b.low));
}

/// Whether the operator has probably drawn round the same object again.
bool MeanTheSame(const Roi& a, const Roi& b) {
  if (const auto* drawn = std::get_if<ImageRoi>(&a)) {
    const auto* again = std::get_if<ImageRoi>(&b);
    return again != nullptr && std::abs(drawn->motor_rad - again->motor_rad) < kSameImage_rad &&
           Overlap(drawn->Bounds(), again->Bounds());
  }
  const auto& box = std::get<BoxRoi>(a);
  const auto* again = std::get_if<BoxRoi>(&b);
  return again != nullptr && (box.Contains(again->base_from_box.translation()) ||
                              again->Contains(box.base_from_box.translation()));
}

}  // namespace

Result<ImageRoi> RegionThrough(RegionShape shape, double motor_rad,
                               const std::vector<Eigen::Vector2d>& points) {
  ImageRoi roi{motor_rad, points};
  if (shape != RegionShape::kPolygon && points.size() == 2)
    roi = shape == RegionShape::kRectangle
              ? ImageRoi::Rectangle(motor_rad, points[0], points[1])
              : ImageRoi::AroundTwoClicks(motor_rad, points[0], points[1]);
  FORESIGHT_CHECK(roi.Check());
  return roi;
}

FitViewModel::FitViewModel(SessionModel* session, QObject* parent)
    : QObject(parent), session_(session) {
  for (auto signal :
       {&SessionModel::cloudChanged, &SessionModel::depthChanged, &SessionModel::roiChanged,
        &SessionModel::scanChanged, &SessionModel::depthComingChanged})
    connect(session_, signal, this, &FitViewModel::changed);
  // Queued: the mask follows its map.
  for (auto signal : {&SessionModel::depthChanged, &SessionModel::depthComingChanged})
    connect(session_, signal, this, &FitViewModel::FitIfReady, Qt::QueuedConnection);
  connect(session_, &SessionModel::scanChanged, this, &FitViewModel::LeaveScan);
  connect(&runner_, &TaskRunner::changed, this, &FitViewModel::changed);
}

std::optional<ObjectKind> FitViewModel::Tool() const {
  return object_tool_ ? std::optional(kind_) : std::nullopt;
}

void FitViewModel::SetShape(RegionShape shape) {
  shape_ = shape;
  Q_EMIT changed();
}

FitSource FitViewModel::From() const {
  return source_.value_or(
      UsualSourceFor(kind_, session_->Depth() != nullptr || session_->DepthComing()));
}

void FitViewModel::SetSource(FitSource source) {
  source_ = source;
  Q_EMIT changed();
}

void FitViewModel::SetTool(ObjectKind kind, bool on) {
  object_tool_ = on;
  if (on) {
    kind_ = kind;
    region_tool_ = false;
  }
  Q_EMIT changed();
}

void FitViewModel::setRegionTool(bool on) {
  region_tool_ = on;
  if (on) object_tool_ = false;
  Q_EMIT changed();
}

void FitViewModel::leaveTools() {
  object_tool_ = region_tool_ = false;
  Q_EMIT changed();
}

bool FitViewModel::CanFit() const {
  const bool has_points =
      From() == FitSource::kRaw ? session_->Cloud() != nullptr : session_->Depth() != nullptr;
  return session_->ScanToFit() && session_->Region() && has_points && !runner_.Busy();
}

void FitViewModel::DrawRegion(const std::vector<Eigen::Vector2d>& points) {
  const CameraFrame* capture = session_->CurrentImage();
  if (capture == nullptr) return;
  const auto roi = RegionThrough(shape_, capture->motor_angle_rad, points);
  if (!roi) return;
  session_->SetRoi(*roi);
  if (object_tool_) fit();
}

void FitViewModel::DrawBox(const CloudRectangle& rectangle, bool cut) {
  if (!session_->Cloud()) return;
  const BoxRoi* within =
      cut && session_->Region() ? std::get_if<BoxRoi>(&*session_->Region()) : nullptr;
  const auto box = BoxUnder(rectangle, session_->Cloud()->points.span(),
                            session_->Rig().robot_from_base, within);
  if (!box || !box->Check()) {
    session_->Report({Notice::Level::kInfo, tr("There are hardly any points in the rectangle."),
                      tr("Draw it over the object in the cloud.")});
    return;
  }
  session_->SetRoi(*box);
  if (object_tool_) fit();
}

QString FitViewModel::Doing(ObjectKind kind) {
  switch (kind) {
    case ObjectKind::kValve:
      return tr("Fitting the valve");
    case ObjectKind::kDrill:
      return tr("Fitting the drill");
    case ObjectKind::kHandle:
      return tr("Fitting the door handle");
    case ObjectKind::kCylinder:
      return tr("Fitting the cylinder");
    case ObjectKind::kTerrain:
      break;
  }
  return tr("Fitting the terrain");
}

FitOptions FitViewModel::OptionsFor(ObjectKind kind) const {
  FitOptions options = UsualOptionsFor(kind);
  const auto chosen = chosen_.find(kind);
  if (chosen == chosen_.end()) return options;
  for (const Option<FitOptions>& option : FitOptionTable(kind))
    if (const auto value = chosen->second.find(option.info.key); value != chosen->second.end()) {
      const Status set = foresight::SetOption(option, options, value->second);
      FORESIGHT_EXPECTS(set.has_value(), "an option was tried when it was chosen");
    }
  return options;
}

Status FitViewModel::SetOption(const std::string& key, const OptionValue& value) {
  const Option<FitOptions>* option = FindOption(FitOptionTable(kind_), key);
  FORESIGHT_EXPECTS(option != nullptr, "the table of options has the key");
  FitOptions wanted = OptionsFor(kind_);
  FORESIGHT_CHECK(foresight::SetOption(*option, wanted, value));
  FORESIGHT_CHECK(std::visit([](const auto& held) { return held.Check(); }, wanted));
  if (option->get(UsualOptionsFor(kind_)) == value)
    chosen_[kind_].erase(key);
  else
    chosen_[kind_][key] = value;
  Q_EMIT changed();
  return {};
}

void FitViewModel::resetOptions() {
  chosen_.erase(kind_);
  Q_EMIT changed();
}

FitOptions FitViewModel::UsualOptionsFor(ObjectKind kind) const {
  const auto& scan = session_->ShownScan();
  const SensorRig& rig = scan ? scan->rig : session_->Rig();
  FitOptions options = FitOptionsFor(kind, rig.robot_from_base);
  auto* terrain = std::get_if<FitTerrainOptions>(&options);
  if (terrain == nullptr) return options;
  for (const FoundObject& object : session_->Objects()) {
    const auto* found = std::get_if<TerrainDetection>(&object.detection);
    if (found == nullptr || session_->IsCurrent(object)) continue;
    if (object.decision != Decision::kAccepted) continue;
    terrain->last = std::make_shared<const TerrainDetection>(*found);
  }
  return options;
}

void FitViewModel::fit() {
  StopWaiting();
  if (!session_->ShownScan() || !session_->Region()) return;
  if (!CanFit() && !runner_.Busy()) {
    if (session_->DepthComing()) {
      waiting_ = true;
      fitting_in_ = session_->ShownScan()->uuid;
      session_->Report({Notice::Level::kInfo, tr("%1 waits for the depth map.").arg(Doing(kind_)),
                        tr("It begins by itself; or choose lidar points and press Fit.")});
      Q_EMIT changed();
      return;
    }
    session_->Report({Notice::Level::kWarning, tr("There are no points to fit to yet."),
                      tr("Wait until the depth is computed, then press Fit.")});
    return;
  }
  const FitOptions options = OptionsFor(kind_);
  const std::shared_ptr<const Scan> scan = session_->ScanToFit();
  fitting_in_ = scan->uuid;
  std::optional<ScanPart> part;
  if (!session_->CurrentScan()) part = PartOf(*scan, session_->Part().of_lines);
  DropFitsOfTheSame(*session_->Region());
  const auto pending = std::make_shared<Pending>(fitting_in_, kind_, *session_->Region());
  const auto work = [scan, part, cloud = session_->Cloud(), depth = session_->Depth(),
                     mask = session_->Mask(), roi = pending->roi, stop = pending->stop,
                     mask_options = session_->MaskOptions(), source = From(),
                     options](RunContext context) mutable -> Result<Found> {
    const std::stop_callback cancelled(context.stop, [&stop] { stop.request_stop(); });
    context.stop = stop.get_token();
    const ProcessedScan processed{scan->rig, *cloud, scan->frames, depth.get(), mask.get()};
    FORESIGHT_TRY(Detection detection, FitInScan(processed, source, roi, options, context));
    FORESIGHT_TRY(Provenance provenance,
                  ProvenanceOfFit(*scan, source, depth.get(), mask_options, options, roi));
    provenance.part = part;
    return Found{std::move(detection), ProvenanceToJson(provenance)};
  };
  pending_.push_back(pending);
  runner_.Run<Found>(Doing(kind_), work, [this, scan, part, pending](const Result<Found>& found) {
    std::erase(pending_, pending);
    if (!pending->replaced) Accept(pending->kind, scan, part, found);
  });
}

void FitViewModel::DropFitsOfTheSame(const Roi& roi) {
  for (const auto& pending : pending_) {
    if (pending->scan_uuid != fitting_in_ || pending->kind != kind_ ||
        !MeanTheSame(pending->roi, roi))
      continue;
    pending->replaced = true;
    pending->stop.request_stop();
  }
}

void FitViewModel::FitIfReady() {
  // Where the map failed the usual source is another one now.
  if (waiting_ && (CanFit() || !session_->DepthComing())) fit();
}

void FitViewModel::LeaveScan() {
  // An image that came, or the rest of the lines, does not make the answer worthless.
  if (session_->ShownScan() && session_->ShownScan()->uuid == fitting_in_) return;
  if (waiting_)
    session_->Report(
        {Notice::Level::kWarning,
         tr("%1 did not begin: another scan came before the depth map.").arg(Doing(kind_)),
         tr("Draw the region again in the scan that is shown.")});
  StopWaiting();
  // A live scan is not shown again: its answers are kept with it.
  if (session_->Mode() == SessionMode::kReplay) runner_.cancel();
}

void FitViewModel::StopWaiting() {
  if (!waiting_) return;
  waiting_ = false;
  Q_EMIT changed();
}

void FitViewModel::Accept(ObjectKind kind, const std::shared_ptr<const Scan>& scan,
                          const std::optional<ScanPart>& part, const Result<Found>& found) {
  if (!found) {
    session_->Report(NoticeOf(Doing(kind), found.error()));
    return;
  }
  FoundObject object;
  object.part = part;
  object.detection = found->detection;
  object.provenance_json = found->provenance_json;
  object.rig = scan->rig;
  object.scan_uuid = scan->uuid;
  object.scan_time = BeginTimeOf(*scan);
  if (session_->Mode() == SessionMode::kReplay && !session_->IsCurrent(object)) return;
  session_->AddObject(object);
}

}  // namespace foresight
