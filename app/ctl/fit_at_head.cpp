#include "app/ctl/fit_at_head.h"

#include <nlohmann/json.hpp>

#include "app/common/connect_head.h"
#include "app/common/output.h"
#include "app/ctl/fit_output.h"
#include "app/ctl/fit_subject.h"
#include "app/ctl/head_scan.h"
#include "core/detection/detection_json.h"
#include "core/geometry/angles.h"
#include "core/mission/provenance.h"
#include "core/sensor/rig_id.h"
#include "hardware/link/client/remote_head.h"

namespace foresight {
namespace {

Result<HeadFitOrder> OrderFrom(const FitArguments& arguments, const SensorRig& rig) {
  const bool middle = arguments.scan.image_deg > 90.0;
  Provenance provenance;
  provenance.rig_id = RigId(rig);
  const double motor_rad = middle ? 0.0 : RadiansFromDegrees(arguments.scan.image_deg);
  FORESIGHT_TRY(provenance.roi, RegionFrom(arguments.region, motor_rad, rig.robot_from_base));
  FORESIGHT_TRY(provenance.fit, FitOptionsFrom(arguments, rig.robot_from_base));
  provenance.source = arguments.source;
  if (arguments.source != "raw") {
    FORESIGHT_TRY(provenance.depth, DepthOptionsFor(arguments, arguments.source));
    provenance.source = NameOf({FitSourceOf(arguments.source), provenance.depth->method});
  }
  HeadFitOrder order;
  order.provenance_json = ProvenanceToJson(provenance);
  order.image = middle ? HeadFitOrder::Image::kMiddle : HeadFitOrder::Image::kNearest;
  return order;
}

/// As a fit in a scan here prints it, with what crossed the link.
std::string WithScanAndLink(const HeadFit& fit) {
  auto json = nlohmann::ordered_json::parse(fit.detection_json);
  json["scan_state"] = fit.scan_state;
  json["scan_reason"] = fit.scan_reason;
  json["link_bytes"] = {{"up", fit.up_bytes}, {"down", fit.down_bytes}};
  return json.dump(2);
}

}  // namespace

Result<ExitCode> FitAtHead(const FitArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const auto head, LookAtHead(arguments.link));
  const SensorRig rig = head->Rig();
  FORESIGHT_TRY(HeadFitOrder order, OrderFrom(arguments, rig));
  FORESIGHT_TRY(order.scan_id, ChooseScanOfHead(*head, arguments.link.head, arguments.head_scan));
  const auto fit = head->Fit(order, context);
  if (!fit && arguments.json && IsNegative(fit.error()))
    return PrintNothingFound(arguments.kind, fit.error());
  if (!fit) return tl::unexpected(fit.error());
  FORESIGHT_TRY(const Detection detection, DetectionFromJson(fit->detection_json));
  FORESIGHT_TRY(const Provenance made,
                ProvenanceFromJson(fit->provenance_json, "the head's answer"));
  PrintNote("made on the robot; over the link: {} bytes up, {} bytes down", fit->up_bytes,
            fit->down_bytes);
  if (made.part)
    PrintNote("the scan still grew: made of {} of {} lines", made.part->lines, made.part->of_lines);
  if (arguments.json)
    PrintLine(WithScanAndLink(*fit));
  else
    PrintSummary(detection, rig);
  return VerdictOf(detection).level == VerdictLevel::kUnsure ? ExitCode::kNegative
                                                             : ExitCode::kDone;
}

}  // namespace foresight
