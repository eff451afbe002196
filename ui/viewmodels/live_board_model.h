#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <optional>
#include <vector>

#include "core/calibration/calibration_session.h"
#include "ui/viewmodels/head_view_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// What the head's camera sees now, and which of some boards is in it: tells at once whether a
/// board has the number of corners that was typed, and whether the place that it is held at is a
/// good one.
class LiveBoardModel : public QObject {
  Q_OBJECT

 public:
  LiveBoardModel(HeadViewModel* head, TaskQueue* tasks, QObject* parent = nullptr);
  ~LiveBoardModel() override;

  /// One board, for the camera alone.
  void SetBoard(const CalibrationBoard& board);
  /// The boards of a stand, as a stop's image is looked at. `camera` may be known roughly.
  void SetMount(const BoardMount& mount, const CameraModel& camera);

  bool Running() const { return relay_ != nullptr; }
  /// The newest image that was looked at; nullptr before the first.
  const std::shared_ptr<const LiveImage>& Image() const { return image_; }
  /// Corners in pixels of Image(), a list a board that was found.
  const std::vector<std::vector<Eigen::Vector2d>>& Corners() const { return corners_; }
  /// "Found: 8 x 6." or why not, "a board of 7x6 inner corners was found where 8x6 was asked for".
  const QString& Text() const { return text_; }

 public Q_SLOTS:
  void start();
  void stop();

 Q_SIGNALS:
  void changed();

 private:
  class Relay;
  struct Sought {
    BoardMount mount;
    CameraModel camera;  ///< of a mount of two boards only
  };
  struct Found {
    std::vector<std::vector<Eigen::Vector2d>> corners;
    QString text;
  };

  void Take(std::shared_ptr<const LiveImage> image);
  void TakeTrouble(const QString& what);
  void Look();
  static Found LookFor(const Sought& sought, const GrayImage& image);
  static Found LookForMount(const Sought& sought, const GrayImage& image);

  HeadViewModel* head_;
  std::optional<Sought> sought_;
  std::shared_ptr<Relay> relay_;
  std::shared_ptr<const LiveImage> newest_;  ///< came while another one was looked at
  std::shared_ptr<const LiveImage> image_;
  std::vector<std::vector<Eigen::Vector2d>> corners_;
  QString text_;
  TaskRunner looker_;
};

}  // namespace foresight
