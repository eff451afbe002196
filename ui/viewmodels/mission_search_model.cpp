#include "ui/viewmodels/mission_search_model.h"

namespace foresight {
namespace {

constexpr int kPauseInTyping_ms = 150;

/// A review lies beside its mission, and has no scans of its own.
QString MissionOf(const std::filesystem::path& path) {
  constexpr std::string_view kReview = ".review.foresight";
  std::string name = path.string();
  if (name.size() > kReview.size() && name.ends_with(kReview))
    name = name.substr(0, name.size() - kReview.size()) + ".foresight";
  return QString::fromStdString(name);
}

}  // namespace

MissionSearchModel::MissionSearchModel(ReviewViewModel* review, TaskQueue* tasks, QString folder,
                                       QObject* parent)
    : QObject(parent), review_(review), runner_(tasks), folder_(std::move(folder)) {
  wait_.setSingleShot(true);
  connect(&wait_, &QTimer::timeout, this, &MissionSearchModel::search);
}

void MissionSearchModel::SetFolder(const QString& folder) {
  if (folder == folder_) return;
  folder_ = folder;
  Q_EMIT folderChanged();
  search();
}

void MissionSearchModel::SetText(const QString& text) {
  if (text == text_) return;
  text_ = text;
  wait_.start(kPauseInTyping_ms);
}

void MissionSearchModel::SetWhat(What what) {
  what_ = what;
  search();
}

MissionQuery MissionSearchModel::Query() const {
  MissionQuery query;
  for (const QString& word : text_.simplified().split(QLatin1Char(' '), Qt::SkipEmptyParts))
    query.words.push_back(word.toStdString());
  query.at_most = kAtMost;
  switch (what_) {
    case What::kEverything:
      break;
    case What::kScans:
      query.what = "scan";
      break;
    case What::kObjects:
      query.what = "object";
      break;
    case What::kAccepted:
      query.decision = "accepted";
      break;
    case What::kRejected:
      query.decision = "rejected";
      break;
    case What::kLog:
      query.what = "log";
      break;
  }
  return query;
}

void MissionSearchModel::search() {
  wait_.stop();
  runner_.Run<MissionHits>(
      tr("Searching the missions"),
      [folder = folder_.toStdString(), query = Query()](const RunContext& context) {
        return SearchMissions(folder, query, IndexCacheFolder(), context);
      },
      [this](Result<MissionHits> found) {
        if (!found && found.error().code == ErrorCode::kCancelled) return;
        searched_ = true;
        problem_ = found ? QString() : QString::fromStdString(found.error().message);
        found_ = found ? std::move(*found) : MissionHits();
        Q_EMIT changed();
      });
  Q_EMIT changed();
}

QString MissionSearchModel::Summary() const {
  if (!problem_.isEmpty()) return problem_;
  if (!searched_) return Busy() ? tr("Searching …") : QString();
  const auto count = static_cast<qulonglong>(found_.hits.size());
  QString text =
      count == kAtMost ? tr("The newest %1 in %2 missions") : tr("%1 found in %2 missions");
  text = text.arg(count).arg(found_.missions);
  if (!found_.unreadable.empty())
    text += tr("; %1 could not be read").arg(static_cast<qulonglong>(found_.unreadable.size()));
  return text;
}

void MissionSearchModel::Open(int hit) {
  if (hit < 0 || hit >= static_cast<int>(found_.hits.size())) return;
  const MissionHit& found = found_.hits[static_cast<std::size_t>(hit)];
  review_->Open(MissionOf(found.mission), found.scan_uuid);
}

}  // namespace foresight
