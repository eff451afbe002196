#pragma once

#include <QObject>
#include <map>

#include "core/depth/depth_method.h"
#include "core/options/option.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// The straight line after a scan: points, alignment to the chosen image, depth, mask. It starts
/// by itself when a scan or an image is chosen, and again when the method changes: the old depth
/// stays until the new one is there, or for good when that is cancelled or fails. Moving the
/// threshold only redoes the mask.
class DepthViewModel : public QObject {
  Q_OBJECT

 public:
  explicit DepthViewModel(SessionModel* session, QObject* parent = nullptr);

  const DepthOptions& Options() const { return options_; }
  DepthMethod Method() const { return options_.method; }
  double Threshold() const { return options_.mask.threshold; }
  /// The options that the depth on the screen was made with; those of the mask apart.
  const DepthOptions& ShownOptions() const { return shown_; }
  /// Whether the depth on the screen is about to be replaced.
  bool Recomputing() const { return runner_.Busy() && session_->Depth() != nullptr; }
  TaskRunner* Runner() { return &runner_; }
  /// How often the depth was computed; a mask alone does not count.
  int ComputedCount() const { return computed_; }
  /// An option of DepthOptionTable by its key: computes again, or only the mask where nothing else
  /// depends on it. Fails with kInvalidOptions, and leaves everything as it is.
  Status SetOption(const std::string& key, const OptionValue& value);
  /// Whether depth follows by itself when an image is shown; a replay decides when it does.
  void SetAutomatic(bool automatic) { automatic_ = automatic; }
  /// Shows a map of the current image that was computed before, with the present mask.
  void ShowAgain(std::shared_ptr<const DepthResult> depth);

 public Q_SLOTS:
  /// In [0, 1], of the largest confidence in the image.
  void setThreshold(double threshold);
  /// Computes again with the options last used with the method, its defaults at first.
  void setMethod(foresight::DepthMethod method);
  /// Keeps every pass of the filter from now on: one map each. Computes again when the depth on the
  /// screen has none.
  void setKeepIterations(bool keep);
  /// The method's defaults again.
  void resetOptions();
  /// Computes the depth of the current image again.
  void compute();
  void cancel() { runner_.cancel(); }

 Q_SIGNALS:
  /// A depth map has been made; the session shows it.
  void computed();
  void optionsChanged();
  void thresholdChanged(double threshold);
  void methodChanged();

 private:
  void ComputeOn(const std::shared_ptr<const Scan>& scan,
                 const std::shared_ptr<const RegisteredScan>& cloud, int image);
  void Accept(const DepthOptions& used, Result<DepthResult> depth);
  void ReturnToShown();
  void Use(const DepthOptions& options);
  void UpdateMask();

  SessionModel* session_;
  DepthOptions options_ = DefaultsOf(DepthMethods().front().method);
  DepthOptions shown_ = options_;
  std::map<DepthMethod, DepthOptions> used_;  ///< with the methods that are not chosen now
  TaskRunner runner_{session_->Tasks()};
  int computed_ = 0;
  bool automatic_ = true;
};

}  // namespace foresight
