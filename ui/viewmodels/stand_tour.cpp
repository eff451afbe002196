#include "ui/viewmodels/stand_tour.h"

#include <algorithm>

namespace foresight {

StandTour::StandTour(CalibrationRecorder* recorder, QObject* parent)
    : QObject(parent), recorder_(recorder) {
  connect(recorder_, &CalibrationRecorder::captureEnded, this, [this](bool complete) {
    if (running_ && !complete) end();
  });
  connect(recorder_, &CalibrationRecorder::writeFailed, this, &StandTour::end);
  connect(recorder_, &CalibrationRecorder::changed, this, &StandTour::Advance);
}

QString StandTour::WhyNot() const {
  if (recorder_->Stand() == nullptr) return tr("The stand is moved by hand.");
  if (running_) return tr("The head is capturing.");
  if (const QString why = recorder_->WhyNotBoardImage(); !why.isEmpty()) return why;
  return recorder_->Plan().StopAngles().empty() ? tr("The plan has no stops.") : QString();
}

void StandTour::start() {
  if (!WhyNot().isEmpty()) return;
  using Task = Step::Task;
  const auto& places = recorder_->Stand()->Places();
  steps_.clear();
  const int from = recorder_->Folder().isEmpty() ? 0 : std::max(0, recorder_->Stand()->At());
  for (int i = from; i < static_cast<int>(places.size()); ++i)
    if (places[static_cast<std::size_t>(i)].mount) {
      steps_.push_back({i, Task::kStops});
      steps_.push_back({i, Task::kSweep});
    } else {
      steps_.push_back({i, Task::kImage});
    }
  running_ = true;
  asked_.reset();
  Advance();
  Q_EMIT changed();
}

void StandTour::end() {
  if (!running_) return;
  running_ = false;
  steps_.clear();
  recorder_->Captures()->end();
  Q_EMIT changed();
}

/// Goes on when the last capture is on the disk and the head stands.
void StandTour::Advance() {
  if (!running_ || taking_ || recorder_->Capturing() || recorder_->Writing()) return;
  if (recorder_->StandMoves()) return;
  if (recorder_->Captures()->HeadMoves()) return;
  taking_ = true;
  bool took = false;
  while (!steps_.empty() && !took) {
    const Step step = steps_.front();
    if (step.place != recorder_->Stand()->At()) {
      if (asked_ == step.place) {
        steps_.clear();  // it did not go, and why was told
        break;
      }
      asked_ = step.place;
      recorder_->MoveStand(step.place);
      if (recorder_->StandMoves()) break;
      if (step.place != recorder_->Stand()->At()) continue;  // it did not go
    }
    asked_.reset();
    steps_.pop_front();
    if (IsDone(step)) continue;
    took = Take(step);
    if (!took) steps_.clear();  // why was told
  }
  taking_ = false;
  if (took || recorder_->StandMoves()) return;
  running_ = false;
  Q_EMIT changed();
}

bool StandTour::IsDone(const Step& step) const {
  switch (step.task) {
    case Step::Task::kImage:
      return recorder_->HasBoardImage();
    case Step::Task::kStops:
      return recorder_->MissingStops().empty();
    case Step::Task::kSweep:
      break;
  }
  return recorder_->HasSweep();
}

bool StandTour::Take(const Step& step) {
  switch (step.task) {
    case Step::Task::kImage:
      recorder_->CaptureBoardImageAt(0.0);
      break;
    case Step::Task::kStops:
      recorder_->captureStops();
      break;
    case Step::Task::kSweep:
      recorder_->captureSweep();
      break;
  }
  return recorder_->Capturing();
}

}  // namespace foresight
