#include "ui/viewmodels/side_results_model.h"

#include <QFileInfo>
#include <algorithm>

#include "core/mission/side_result.h"
#include "ui/viewmodels/review_scan.h"

namespace foresight {
namespace {

const QString kUndoTopic = QStringLiteral("side results");

QString InOneLine(const std::vector<std::string>& words) {
  QStringList list;
  for (const std::string& word : words) list << QString::fromStdString(word);
  return list.join(QStringLiteral("; "));
}

Result<std::vector<ResultRow>> RowsOf(const MissionFile& mission, const MissionFile* review,
                                      const Scan& scan) {
  FORESIGHT_TRY(const auto scan_id, mission.FindScan(scan.uuid));
  if (!scan_id) return std::vector<ResultRow>();
  FORESIGHT_TRY(const DepthOptions original, OriginalDepthOptions(mission, *scan_id, -1));
  std::vector<ResultRow> rows;
  FORESIGHT_TRY(const std::vector<SideResult> results, SideResultsOf(mission, review, scan.uuid));
  for (const SideResult& result : results)
    rows.push_back({QString::fromStdString(mission.path().string()), scan.uuid, result.uuid,
                    QString::fromStdString(result.name), QString::fromStdString(result.author),
                    QDateTime::fromMSecsSinceEpoch(result.utc_ns / 1'000'000),
                    InOneLine(DifferencesInWords(result, original, scan.rig))});
  return rows;
}

Result<ComparedResult> Make(const ResultRow& row, std::optional<std::int64_t> image,
                            const std::filesystem::path& review_folder, const RunContext& context) {
  const std::filesystem::path path = row.mission.toStdString();
  FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(path));
  FORESIGHT_TRY(const auto review, MissionFile::FindReviewOf(path, review_folder));
  FORESIGHT_TRY(const auto scan_id, mission->FindScan(row.scan));
  if (!scan_id)
    return Fail(ErrorCode::kInvalidInput, "{}: there is no scan {}", path.string(), row.scan);
  return MakeResultAgain(*mission, review.get(), *scan_id, row.result, image, context);
}

}  // namespace

SideResultsModel::SideResultsModel(ReviewViewModel* review, SessionModel* session,
                                   DepthViewModel* depth, FitViewModel* fit,
                                   CompareViewModel* compare, QObject* parent)
    : QObject(parent),
      review_(review),
      session_(session),
      depth_(depth),
      fit_(fit),
      compare_(compare) {
  connect(session_, &SessionModel::scanChanged, this, &SideResultsModel::FollowScan);
  connect(review_, &ReviewViewModel::changed, this, &SideResultsModel::FollowScan);
  connect(session_, &SessionModel::imageChanged, this, [this] {
    if (compared_.comparison) this->compare();  // the parameter has the same name
  });
  connect(&runner_, &TaskRunner::changed, this, &SideResultsModel::changed);
  connect(&comparer_, &TaskRunner::changed, this, &SideResultsModel::changed);
}

int SideResultsModel::IndexOf(const std::optional<ResultRow>& row) const {
  if (!row) return -1;
  const auto at = std::find(rows_.begin(), rows_.end(), *row);
  return at == rows_.end() ? -1 : static_cast<int>(at - rows_.begin());
}

void SideResultsModel::FollowScan() {
  const auto& scan = session_->CurrentScan();
  const std::string uuid = scan && review_->File() ? scan->uuid : std::string();
  if (uuid == scan_) return;
  scan_ = uuid;
  session_->Undo()->Forget(kUndoTopic);
  comparer_.cancel();
  compared_ = {};
  a_.reset();
  b_.reset();
  rows_.clear();
  Q_EMIT changed();
  if (!scan_.empty()) List();
}

void SideResultsModel::List() {
  const auto scan = session_->CurrentScan();
  const auto mission = review_->File();
  if (!scan || !mission) return;
  lister_.Run<std::vector<ResultRow>>(
      tr("Listing the side results"),
      [scan, mission,
       folder = ReviewFolder()](const RunContext&) -> Result<std::vector<ResultRow>> {
        FORESIGHT_TRY(const auto review, MissionFile::FindReviewOf(mission->path(), folder));
        return RowsOf(*mission, review.get(), *scan);
      },
      [this, scan](Result<std::vector<ResultRow>> listed) {
        if (scan->uuid != scan_) return;
        if (!listed) {
          session_->Report(NoticeOf(tr("Listing the side results"), listed.error()));
          return;
        }
        rows_ = {{review_->Path(),
                  scan_,
                  kOriginalResult,
                  tr("Original"),
                  {},
                  {},
                  tr("as the mission keeps it")}};
        rows_.insert(rows_.end(), listed->begin(), listed->end());
        rows_.insert(rows_.end(), others_.begin(), others_.end());
        TakePresentRows();
        Q_EMIT changed();
      });
}

void SideResultsModel::TakePresentRows() {
  // A and B have the names that they have now; one that was deleted is chosen no longer.
  for (std::optional<ResultRow>* side : {&a_, &b_}) {
    if (!*side) continue;
    const int index = IndexOf(*side);
    if (index >= 0)
      *side = rows_[static_cast<std::size_t>(index)];
    else
      side->reset();
  }
  if (!a_) a_ = rows_.front();
}

QString SideResultsModel::WhyNoRun() const {
  if (!review_->File()) return tr("Open a mission for review first (Ctrl+O).");
  if (!session_->CurrentScan()) return tr("No scan is shown.");
  return {};
}

QString SideResultsModel::WhyNoComparison() const {
  if (!review_->File()) return tr("Open a mission for review first (Ctrl+O).");
  if (A() < 0 || B() < 0) return tr("Choose one result as A and one as B.");
  return {};
}

QString SideResultsModel::FreeName() const {
  const auto taken = [this](const QString& name) {
    return std::any_of(rows_.begin(), rows_.end(),
                       [&](const ResultRow& row) { return row.name == name; });
  };
  int number = 1;
  while (taken(tr("Run %1").arg(number))) ++number;
  return tr("Run %1").arg(number);
}

void SideResultsModel::RunAgain(const QString& name) {
  Start(name, std::nullopt);
}

void SideResultsModel::RunAgainWithRig(const QString& name, const QString& rig_file) {
  Start(name, rig_file.toStdString());
}

void SideResultsModel::Start(const QString& name, const std::optional<std::string>& rig_file) {
  if (!WhyNoRun().isEmpty()) return;
  const QString doing = tr("Running the scan again");
  const QString called = name.trimmed().isEmpty() ? FreeName() : name.trimmed();
  struct Made {
    RunAgainSettings settings;
    RunAgainAnswer answer;
  };
  RunAgainSettings settings;
  settings.depth = depth_->Options();
  for (const auto& [kind, options] : fit_->Chosen())
    if (!options.empty()) settings.fit[kind] = options;
  const auto scan = session_->CurrentScan();
  const auto work = [scan, settings, rig_file, mission = review_->File(),
                     folder = ReviewFolder()](const RunContext& context) -> Result<Made> {
    Made made{settings, {}};
    if (rig_file) {
      FORESIGHT_TRY(made.settings.rig, LoadSensorRig(*rig_file));
    }
    FORESIGHT_TRY(const auto review, MissionFile::FindReviewOf(mission->path(), folder));
    FORESIGHT_TRY(const std::vector<DetectionRecord> records,
                  DetectionsOfScan(*mission, review.get(), scan->uuid));
    FORESIGHT_TRY(made.answer, foresight::RunAgain(*scan, records, made.settings, context));
    return made;
  };
  // Another mission may be open when the run is done: the result belongs to this one.
  const std::filesystem::path mission = review_->File()->path();
  runner_.Run<Made>(doing, work, [this, doing, called, scan, mission](Result<Made> made) {
    if (!made) {
      session_->Report(NoticeOf(doing, made.error()));
      return;
    }
    const int failures = made->answer.failures;
    review_->KeepIn(
        mission,
        [called, scan, kept = std::move(*made)](MissionFile* review) -> Status {
          FORESIGHT_CHECK(
              KeepSideResult(*review, called.toStdString(), *scan, kept.settings, kept.answer));
          return {};
        },
        [this, doing, called, failures](const Status& kept) {
          if (!kept)
            session_->Report(NoticeOf(doing, kept.error()));
          else if (failures > 0)
            session_->Report({Notice::Level::kWarning, tr("Kept the side result '%1'.").arg(called),
                              tr("%1 of its depth maps or fits could not be made.").arg(failures)});
          else
            session_->Report(
                {Notice::Level::kInfo, tr("Kept the side result '%1'.").arg(called), {}});
          List();
        });
  });
}

bool SideResultsModel::CanChange(int index) const {
  if (index < 0 || index >= static_cast<int>(rows_.size())) return false;
  return rows_[static_cast<std::size_t>(index)].result != kOriginalResult;
}

void SideResultsModel::Rename(int index, const QString& name) {
  const std::string wanted = name.trimmed().toStdString();
  if (!CanChange(index) || wanted.empty()) return;
  const ResultRow& row = rows_[static_cast<std::size_t>(index)];
  const std::string before = row.name.toStdString();
  if (wanted == before) return;
  const auto to = [uuid = row.result](const std::string& called) {
    return [uuid, called](MissionFile& review) { return RenameSideResult(review, uuid, called); };
  };
  ChangeWithUndo(tr("Rename %1").arg(row.name), to(wanted), to(before));
}

void SideResultsModel::Delete(int index) {
  if (!CanChange(index)) return;
  const ResultRow& row = rows_[static_cast<std::size_t>(index)];
  ChangeWithUndo(
      tr("Delete %1").arg(row.name),
      [uuid = row.result](MissionFile& review) { return DeleteSideResult(review, uuid); },
      [uuid = row.result](MissionFile& review) { return RestoreSideResult(review, uuid); });
}

void SideResultsModel::ChangeWithUndo(const QString& text, const Change& change,
                                      const Change& back) {
  session_->Undo()->Push(
      text, kUndoTopic, [this, text, back] { KeepChange(text, back); },
      [this, text, change] { KeepChange(text, change); });
  KeepChange(text, change);
}

void SideResultsModel::KeepChange(const QString& text, const Change& change) {
  review_->Keep([change](MissionFile* review) { return change(*review); },
                [this, text](const Status& kept) {
                  if (!kept) session_->Report(NoticeOf(text, kept.error()));
                  List();
                });
}

void SideResultsModel::AddMission(const QString& file) {
  const QString doing = tr("Listing the scans of another mission");
  lister_.Run<std::vector<ScanSummary>>(
      doing,
      [path = file.toStdString()](const RunContext&) -> Result<std::vector<ScanSummary>> {
        FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(path));
        return mission->ListScans();
      },
      [this, doing, file](const Result<std::vector<ScanSummary>>& scans) {
        if (!scans) {
          session_->Report(NoticeOf(doing, scans.error()));
          return;
        }
        for (const ScanSummary& scan : *scans) {
          const ResultRow row{file,
                              scan.uuid,
                              kOriginalResult,
                              tr("%1, scan %2").arg(QFileInfo(file).fileName()).arg(scan.id),
                              {},
                              QDateTime::fromMSecsSinceEpoch(scan.begin_utc_ns / 1'000'000),
                              tr("another scan: clouds and objects are compared")};
          if (std::find(others_.begin(), others_.end(), row) == others_.end() && scan.uuid != scan_)
            others_.push_back(row);
        }
        List();
      });
}

void SideResultsModel::Choose(int index, std::optional<ResultRow>* side) {
  if (index < 0 || index >= static_cast<int>(rows_.size())) return;
  *side = rows_[static_cast<std::size_t>(index)];
  Q_EMIT changed();
  if (WhyNoComparison().isEmpty()) compare();
}

void SideResultsModel::compare() {
  if (!WhyNoComparison().isEmpty()) return;
  const QString doing = tr("Comparing A and B");
  const std::optional<std::int64_t> image =
      session_->ImageIndex() >= 0 ? std::optional<std::int64_t>(session_->ImageIndex())
                                  : std::nullopt;
  const auto work = [a = *a_, b = *b_, image, shown = scan_,
                     folder = ReviewFolder()](const RunContext& context) -> Result<Compared> {
    // The image that is shown is one of the scan that is shown.
    const auto image_of = [&](const ResultRow& row) {
      return row.scan == shown ? image : std::nullopt;
    };
    FORESIGHT_TRY(ComparedResult first, Make(a, image_of(a), folder, context.Part(0.0, 0.35)));
    FORESIGHT_TRY(ComparedResult second, Make(b, image_of(b), folder, context.Part(0.35, 0.7)));
    FORESIGHT_TRY(ResultComparison comparison,
                  CompareResults(first, second, context.Part(0.7, 1.0)));
    return Compared{std::make_shared<const ComparedResult>(std::move(first)),
                    std::make_shared<const ComparedResult>(std::move(second)),
                    std::make_shared<const ResultComparison>(std::move(comparison))};
  };
  comparer_.Run<Compared>(doing, work, [this, doing, shown = scan_](Result<Compared> done) {
    if (shown != scan_) return;
    if (!done) {
      session_->Report(NoticeOf(doing, done.error()));
      return;
    }
    compared_ = std::move(*done);
    if (compared_.comparison->depth)
      compare_->CompareResults(
          {compared_.a->depth, tr("A: %1").arg(QString::fromStdString(compared_.a->name))},
          {compared_.b->depth, tr("B: %1").arg(QString::fromStdString(compared_.b->name))});
    Q_EMIT compared();
    Q_EMIT changed();
  });
}

}  // namespace foresight
