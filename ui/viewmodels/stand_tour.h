#pragma once

#include <QObject>
#include <deque>
#include <optional>

#include "ui/viewmodels/calibration_recorder.h"

namespace foresight {

/// Records a whole session where the stand moves by itself: at each of its places, from where it is
/// on, an image for the camera alone, or stops and a sweep, as far as the session does not have
/// them. A capture that fails, or that cannot be kept, ends it.
class StandTour : public QObject {
  Q_OBJECT

 public:
  explicit StandTour(CalibrationRecorder* recorder, QObject* parent = nullptr);

  bool Running() const { return running_; }
  /// Why it cannot start, as a sentence; empty when it can.
  QString WhyNot() const;

 public Q_SLOTS:
  void start();
  /// Ends it; what was captured is kept.
  void end();

 Q_SIGNALS:
  void changed();

 private:
  struct Step {
    enum class Task { kImage, kStops, kSweep };
    int place = 0;
    Task task = Task::kImage;
  };

  void Advance();
  /// Whether the session has it already.
  bool IsDone(const Step& step) const;
  /// Whether a capture began.
  bool Take(const Step& step);

  CalibrationRecorder* recorder_;
  bool running_ = false;
  std::optional<int> asked_;  ///< place that the stand was told to go to for the next step
  bool taking_ = false;       ///< what it does announces changes, which it hears itself
  std::deque<Step> steps_;
};

}  // namespace foresight
