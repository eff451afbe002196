#pragma once

#include <QObject>
#include <QString>
#include <memory>

#include "ui/viewmodels/head_view_model.h"

namespace foresight {

/// What a calibration asks of the head: images and lines while it stands, and sweeps. None of it is
/// a scan of the mission. Answers come in this object's thread.
class HeadCaptures : public QObject {
  Q_OBJECT

 public:
  explicit HeadCaptures(HeadViewModel* head, QObject* parent = nullptr);
  ~HeadCaptures() override;  ///< ends what runs

  /// Of what was started here.
  bool Running() const { return relay_ != nullptr; }
  /// Why nothing can start now, as a sentence; empty when it can.
  QString WhyNot() const;
  /// Of what was started here or elsewhere; the head tells a moment after the last capture.
  bool HeadMoves() const;

  Status StartStops(const StopPlan& plan);
  /// One image where the head stands now.
  Status StartImage();
  Status StartSweep(const ScanPlan& plan);
  /// Ends what runs; what still comes of it is for nobody.
  void Drop();

 public Q_SLOTS:
  /// Ends what runs; what was captured is kept.
  void end();

 Q_SIGNALS:
  void captured(const std::shared_ptr<const foresight::StopCapture>& capture);
  /// `reason` is empty where everything came.
  void stopsEnded(bool complete, const QString& reason);
  void sweepEnded(const std::shared_ptr<const foresight::Scan>& scan);
  void changed();

 private:
  class Relay;

  HeadViewModel* head_;
  std::shared_ptr<Relay> relay_;  ///< of what runs
};

}  // namespace foresight
