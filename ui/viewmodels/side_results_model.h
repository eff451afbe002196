#pragma once

#include <QDateTime>
#include <QObject>
#include <QString>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/mission/compare_results.h"
#include "ui/viewmodels/compare_view_model.h"
#include "ui/viewmodels/fit_view_model.h"
#include "ui/viewmodels/review_view_model.h"

namespace foresight {

/// One result that can be compared: of the scan under review, or another scan.
struct ResultRow {
  QString mission;     ///< the file that holds the scan
  std::string scan;    ///< its uuid
  std::string result;  ///< kOriginalResult, or a side result's uuid
  QString name;
  QString author;
  QDateTime time;  ///< invalid: of an original, whose parts have times of their own
  QString differences;

  bool operator==(const ResultRow& other) const {
    return mission == other.mission && scan == other.scan && result == other.result;
  }
};

/// The side results of the scan under review: makes new ones with the options that are set, lists
/// them, and compares one of them, A, with another, B. Originals are never written to.
class SideResultsModel : public QObject {
  Q_OBJECT

 public:
  /// A and B, and how they differ.
  struct Compared {
    std::shared_ptr<const ComparedResult> a;
    std::shared_ptr<const ComparedResult> b;
    std::shared_ptr<const ResultComparison> comparison;
  };

  SideResultsModel(ReviewViewModel* review, SessionModel* session, DepthViewModel* depth,
                   FitViewModel* fit, CompareViewModel* compare, QObject* parent = nullptr);

  /// The original first, then side results, the oldest first, then scans of other missions.
  const std::vector<ResultRow>& Rows() const { return rows_; }
  /// Index of A or B in Rows(); -1 = none is chosen.
  int A() const { return IndexOf(a_); }
  int B() const { return IndexOf(b_); }
  void ChooseA(int index) { Choose(index, &a_); }
  void ChooseB(int index) { Choose(index, &b_); }
  /// Of the present A and B; nullptr members while there is none.
  const Compared& Last() const { return compared_; }

  /// Empty = it can be run; else why not, for the operator.
  QString WhyNoRun() const;
  QString WhyNoComparison() const;
  /// All depth maps and fits of the scan again, with the options of the depth and of the fit that
  /// are set now, in the background; the answer is kept in the review. An empty name becomes
  /// "Run 1".
  void RunAgain(const QString& name);
  /// The same with the rig of a file in place of the scan's own.
  void RunAgainWithRig(const QString& name, const QString& rig_file);
  /// Whether a row of Rows() is a side result: originals are neither renamed nor deleted.
  bool CanChange(int index) const;
  /// Another name for a side result, or none of it in the list; both can be undone. What was kept
  /// of it stays in the review.
  void Rename(int index, const QString& name);
  void Delete(int index);
  /// Lists the scans of another mission too.
  void AddMission(const QString& file);
  TaskRunner* Runner() { return &runner_; }
  TaskRunner* Comparer() { return &comparer_; }

 public Q_SLOTS:
  /// Compares A with B: their depth maps also stand left and right of the line in the depth pane.
  void compare();

 Q_SIGNALS:
  void changed();
  void compared();

 private:
  void FollowScan();
  void List();
  void TakePresentRows();
  void Start(const QString& name, const std::optional<std::string>& rig_file);
  using Change = std::function<Status(MissionFile&)>;
  void ChangeWithUndo(const QString& text, const Change& change, const Change& back);
  void KeepChange(const QString& text, const Change& change);
  void Choose(int index, std::optional<ResultRow>* side);
  int IndexOf(const std::optional<ResultRow>& row) const;
  QString FreeName() const;

  ReviewViewModel* review_;
  SessionModel* session_;
  DepthViewModel* depth_;
  FitViewModel* fit_;
  CompareViewModel* compare_;
  TaskRunner runner_{session_->Tasks(), TaskPolicy::kQueue};
  TaskRunner lister_{session_->Tasks()};
  TaskRunner comparer_{session_->Tasks()};
  std::string scan_;  ///< uuid of the scan whose results are listed
  std::vector<ResultRow> rows_;
  std::vector<ResultRow> others_;  ///< scans of other missions
  std::optional<ResultRow> a_;
  std::optional<ResultRow> b_;
  Compared compared_;
};

}  // namespace foresight
