#include "ui/viewmodels/source_gallery_model.h"

#include "core/depth/depth_method.h"
#include "core/detection/candidates.h"
#include "core/detection/facts.h"
#include "core/pictures/detection_picture.h"

namespace foresight {
namespace {

/// All that a run needs; it owns it, for it works in another thread.
struct Subject {
  std::shared_ptr<const Scan> scan;
  std::shared_ptr<const RegisteredScan> cloud;
  int picture = 0;
  Roi roi;
  FitOptions options;

  const CameraFrame& Frame() const { return scan->frames[static_cast<std::size_t>(picture)]; }
};

/// nullptr = the lidar's returns.
Result<Detection> FitTo(const DepthMethodInfo* method, const Subject& subject,
                        const RunContext& context) {
  const SensorRig& rig = subject.scan->rig;
  if (method == nullptr)
    return FitInScan({rig, *subject.cloud, subject.scan->frames}, FitSource::kRaw, subject.roi,
                     subject.options, context);
  FORESIGHT_TRY(const DepthResult depth,
                ComputeDepthInFrame(*subject.cloud, rig, subject.Frame(),
                                    DefaultsOf(method->method), context.Part(0.0, 0.7)));
  return FitInScan({rig, *subject.cloud, subject.scan->frames, &depth}, FitSource::kDepthAlone,
                   subject.roi, subject.options, context.Part(0.7, 1.0));
}

SourceAnswer AnswerOf(const std::string& source, const Result<Detection>& found,
                      const Subject& subject) {
  SourceAnswer answer;
  answer.source = QString::fromStdString(SourceTitle(source));
  answer.found = found.has_value();
  ColorImage picture = subject.Frame().image;
  if (found) {
    answer.level = VerdictOf(*found).level;
    answer.probability = VerdictOf(*found).probability;
    answer.text = QString::fromStdString(CandidateText(*found, 0));
    DrawDetection(picture, *found, 0, subject.scan->rig, subject.Frame().motor_angle_rad);
  } else {
    answer.text = QString::fromStdString(found.error().message);
    DrawRegion(picture, subject.roi, subject.scan->rig, subject.Frame().motor_angle_rad);
  }
  answer.picture = AroundRegion(picture, subject.roi);
  return answer;
}

Result<std::vector<SourceAnswer>> FitToAll(const Subject& subject, const RunContext& context) {
  std::vector<const DepthMethodInfo*> methods = {nullptr};
  for (const DepthMethodInfo& method : DepthMethods()) methods.push_back(&method);
  std::vector<SourceAnswer> answers;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const auto fraction = [&](std::size_t done) {
      return static_cast<double>(done) / static_cast<double>(methods.size());
    };
    const auto found = FitTo(methods[i], subject, context.Part(fraction(i), fraction(i + 1)));
    if (!found && found.error().code == ErrorCode::kCancelled) return tl::unexpected(found.error());
    answers.push_back(AnswerOf(
        NameOf(methods[i] == nullptr ? NamedSource()
                                     : NamedSource{FitSource::kDepthAlone, methods[i]->method}),
        found, subject));
  }
  return answers;
}

}  // namespace

SourceGalleryModel::SourceGalleryModel(SessionModel* session, FitViewModel* fit, QObject* parent)
    : QObject(parent), session_(session), fit_(fit) {
  connect(session_, &SessionModel::scanChanged, &runner_, &TaskRunner::cancel);
}

bool SourceGalleryModel::CanStart() const {
  return session_->CurrentScan() && session_->Cloud() && session_->CurrentImage() != nullptr &&
         session_->Region() && !runner_.Busy();
}

void SourceGalleryModel::start() {
  if (!CanStart()) return;
  const FitOptions options = fit_->OptionsFor(fit_->Kind());
  const Subject subject{session_->CurrentScan(), session_->Cloud(), session_->ImageIndex(),
                        *session_->Region(), options};
  using Answers = std::vector<SourceAnswer>;
  runner_.Run<Answers>(
      tr("Comparing sources"),
      [subject](const RunContext& context) { return FitToAll(subject, context); },
      [this](Result<Answers> answers) {
        if (!answers) {
          session_->Report(NoticeOf(tr("Comparing sources"), answers.error()));
          return;
        }
        answers_ = std::move(*answers);
        Q_EMIT finished();
      });
}

}  // namespace foresight
