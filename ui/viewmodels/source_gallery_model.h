#pragma once

#include <QObject>
#include <QString>
#include <vector>

#include "core/base/image.h"
#include "ui/viewmodels/fit_view_model.h"

namespace foresight {

/// What came of one source: the lidar's returns or a depth method.
struct SourceAnswer {
  QString source;      ///< "lidar returns", "depth map, Paper (Shim 2016)"
  bool found = false;  ///< else `level` means nothing and `text` says why
  VerdictLevel level = VerdictLevel::kUnsure;
  double probability = 0.0;
  QString text;        ///< the answer in words
  ColorImage picture;  ///< around the region, with the outline
};

/// Fits the current kind of object into the current region once for every source, in the
/// background, each depth map made with its method's defaults.
class SourceGalleryModel : public QObject {
  Q_OBJECT

 public:
  SourceGalleryModel(SessionModel* session, FitViewModel* fit, QObject* parent = nullptr);

  bool CanStart() const;
  TaskRunner* Runner() { return &runner_; }
  /// Of the last run, the lidar's returns first.
  const std::vector<SourceAnswer>& Answers() const { return answers_; }

 public Q_SLOTS:
  void start();

 Q_SIGNALS:
  void finished();

 private:
  SessionModel* session_;
  FitViewModel* fit_;
  TaskRunner runner_{session_->Tasks()};
  std::vector<SourceAnswer> answers_;
};

}  // namespace foresight
