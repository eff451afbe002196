#include <memory>

#include "app/ctl/command.h"
#include "app/ctl/fit_at_head.h"
#include "app/ctl/fit_gallery.h"
#include "app/ctl/fit_output.h"
#include "app/ctl/fit_subject.h"
#include "core/detection/detection_json.h"
#include "core/io/png.h"
#include "core/mission/mission_file.h"
#include "core/mission/new_records.h"

namespace foresight {
namespace {

Status Save(const FitArguments& arguments, const FitSubject& subject, const FitAnswer& answer) {
  FORESIGHT_TRY(const FitOptions options, FitOptionsFrom(arguments, subject.rig.robot_from_base));
  FORESIGHT_TRY(const NamedSource source, FitSourceFromName(OriginOf(*answer.detection).source));
  const DepthResult* depth = answer.depth ? &*answer.depth : nullptr;
  FORESIGHT_TRY(const Provenance provenance,
                ProvenanceOfFit(subject.scan->scan, source.source, depth,
                                depth != nullptr ? depth->options.mask : ConfidenceMaskOptions(),
                                options, subject.roi));
  DetectionRecord record = NewDetectionRecord(subject.scan->scan, *answer.detection, provenance);
  record.scan_id = subject.scan->id;
  FORESIGHT_TRY(const std::unique_ptr<MissionFile> mission,
                MissionFile::Open(arguments.scan.mission));
  FORESIGHT_CHECK(mission->AddDetection(record));
  return mission->Close();
}

/// A fit in a scan tells how that scan ended.
std::string WithScanState(const std::string& detection, const FitSubject& subject) {
  if (!subject.scan) return detection;
  auto json = nlohmann::ordered_json::parse(detection);
  json["scan_state"] = ToString(subject.scan->scan.state);
  json["scan_reason"] = subject.scan->scan.reason;
  return json.dump(2);
}

Result<ExitCode> Fit(const FitArguments& arguments, const RunContext& context) {
  FORESIGHT_CHECK(CheckFitArguments(arguments));
  if (!arguments.link.head.empty()) return FitAtHead(arguments, context);
  FORESIGHT_TRY(const FitSubject subject, OpenFitSubject(arguments, context.Part(0.0, 0.1)));
  const double all = arguments.gallery.empty() ? 1.0 : 0.3;
  const FitAnswer answer = FitIn(subject, arguments, arguments.source, context.Part(0.1, all));
  if (!arguments.gallery.empty())
    FORESIGHT_CHECK(
        WriteFitGallery(subject, arguments, answer, arguments.gallery, context.Part(all, 1.0)));
  if (!answer.detection && arguments.json && IsNegative(answer.detection.error()))
    return PrintNothingFound(arguments.kind, answer.detection.error());
  FORESIGHT_TRY(const Detection detection, answer.detection);
  if (arguments.save) FORESIGHT_CHECK(Save(arguments, subject, answer));
  if (!arguments.picture.empty())
    FORESIGHT_CHECK(WritePng(arguments.picture, PictureOf(subject, detection)));
  if (arguments.json)
    PrintLine(WithScanState(DetectionToJson(detection, subject.rig.robot_from_base), subject));
  else
    PrintSummary(detection, subject.rig, UpOfCloud(arguments));
  return VerdictOf(detection).level == VerdictLevel::kUnsure ? ExitCode::kNegative
                                                             : ExitCode::kDone;
}

}  // namespace

void AddFitCommand(CLI::App& app, Invocation& invocation) {
  CLI::App* fit = app.add_subcommand(
      "fit", "Fit a known object in a region of a scan, a depth map or a point cloud");
  fit->require_subcommand(1);
  constexpr const char* kHelp[] = {"Fit a valve: a wheel or a lever", "Fit a standing drill",
                                   "Fit blocks that can be stood on",
                                   "Fit a door handle: a lever on its plate",
                                   "Fit a pole, a pipe or anything else that is round"};
  for (const ObjectKind kind : kObjectKinds) {
    const auto arguments = std::make_shared<FitArguments>();
    arguments->kind = kind;
    CLI::App* command = fit->add_subcommand(ToString(kind), kHelp[static_cast<std::size_t>(kind)]);
    AddFitArguments(*command, *arguments);
    command->callback([&invocation, arguments] {
      invocation = [arguments](const RunContext& context) { return Fit(*arguments, context); };
    });
  }
}

}  // namespace foresight
