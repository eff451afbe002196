#include "ui/viewmodels/robot_fit_model.h"

#include "core/detection/detection_json.h"
#include "core/mission/provenance.h"
#include "core/sensor/rig_id.h"
#include "ui/viewmodels/bytes_text.h"

namespace foresight {

RobotFitModel::RobotFitModel(std::shared_ptr<SensorHead> head, SessionModel* live,
                             const FitViewModel* fit, const DepthViewModel* depth, QObject* parent)
    : QObject(parent),
      head_(std::move(head)),
      link_(head_->Link()),
      session_(live),
      fit_(fit),
      depth_(depth) {
  for (const auto signal : {&SessionModel::scanChanged, &SessionModel::roiChanged})
    connect(session_, signal, this, &RobotFitModel::changed);
  connect(&runner_, &TaskRunner::changed, this, &RobotFitModel::changed);
}

QString RobotFitModel::WhyNot() const {
  if (runner_.Busy()) return tr("The robot is fitting.");
  if (!session_->ShownScan()) return tr("There is no scan yet.");
  if (session_->CurrentScan()) return tr("All of the scan is here. Fit it here (F).");
  if (!session_->Region()) return tr("Draw a region over the object first.");
  if (!link_->MayOperate())
    return tr("This certificate is an observer's: the robot fits for operators.");
  return link_->Health().connected ? QString() : tr("The link is lost. Wait until it is back.");
}

HeadFitOrder RobotFitModel::Order() const {
  const Scan& scan = *session_->ShownScan();
  Provenance provenance;
  provenance.rig_id = RigId(scan.rig);
  provenance.roi = session_->Region();
  provenance.fit = fit_->OptionsFor(fit_->Kind());
  NamedSource source{fit_->From(), {}};
  if (source.source != FitSource::kRaw) {
    provenance.depth = depth_->Options();
    provenance.depth->mask = session_->MaskOptions();
    source.method = provenance.depth->method;
  }
  provenance.source = NameOf(source);
  HeadFitOrder order;
  order.scan_id = scan.uuid;
  order.provenance_json = ProvenanceToJson(provenance);
  // The images that are here may be fewer than the head's.
  order.image = HeadFitOrder::Image::kNearest;
  return order;
}

void RobotFitModel::fit() {
  if (!WhyNot().isEmpty()) return;
  runner_.Run<HeadFit>(
      tr("Fitting on the robot"),
      [head = head_, link = link_, order = Order()](const RunContext& context) {
        return link->Fit(order, context);
      },
      [this, scan = session_->ShownScan()](const Result<HeadFit>& made) { Accept(scan, made); });
}

void RobotFitModel::Accept(const std::shared_ptr<const Scan>& scan, const Result<HeadFit>& made) {
  const QString doing = tr("Fitting on the robot");
  if (!made) return session_->Report(NoticeOf(doing, made.error()));
  const auto detection = DetectionFromJson(made->detection_json);
  if (!detection) return session_->Report(NoticeOf(doing, detection.error()));
  const auto provenance = ProvenanceFromJson(made->provenance_json, "the robot's fit");
  if (!provenance) return session_->Report(NoticeOf(doing, provenance.error()));
  FoundObject object;
  object.detection = *detection;
  object.part = provenance->part;
  object.provenance_json = made->provenance_json;
  object.rig = scan->rig;
  object.scan_uuid = scan->uuid;
  object.scan_time = BeginTimeOf(*scan);
  object.by_robot = true;
  session_->AddObject(object);
  session_->Report({Notice::Level::kInfo, tr("The robot made the fit."),
                    tr("%1 went up the link, %2 came down.")
                        .arg(BytesText(made->up_bytes), BytesText(made->down_bytes))});
}

}  // namespace foresight
