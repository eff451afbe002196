#include "ui/panels/open_missions.h"

#include <QAbstractItemModel>
#include <QFileInfo>
#include <QFontMetrics>
#include <QIcon>
#include <QMenu>
#include <algorithm>
#include <map>

#include "ui/panels/scan_list.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {

/// Two levels: missions, and the scans of each. A row of a scan knows its mission by internalId.
class OpenMissionsItems : public QAbstractItemModel {
 public:
  OpenMissionsItems(const ReviewViewModel* review, const QFont& font, QObject* parent)
      : QAbstractItemModel(parent), review_(review), font_(font) {}

  /// Missions came or went, or one of them has grown.
  void Refresh() {
    std::vector<std::pair<std::string, std::size_t>> now;
    for (const OpenMission& mission : review_->Missions())
      now.emplace_back(mission.file->path().string(), mission.scans.size());
    if (now == shown_) return;
    beginResetModel();
    shown_ = std::move(now);
    thumbnails_.clear();
    endResetModel();
  }
  int Decoded() const { return decoded_; }

  QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override {
    if (!hasIndex(row, column, parent)) return {};
    return createIndex(row, column, parent.isValid() ? quintptr(parent.row() + 1) : quintptr(0));
  }
  QModelIndex parent(const QModelIndex& child) const override {
    return child.internalId() == 0
               ? QModelIndex()
               : createIndex(static_cast<int>(child.internalId()) - 1, 0, quintptr(0));
  }
  int rowCount(const QModelIndex& parent = {}) const override {
    if (!parent.isValid()) return static_cast<int>(shown_.size());
    if (parent.internalId() != 0) return 0;
    return static_cast<int>(shown_[static_cast<std::size_t>(parent.row())].second);
  }
  int columnCount(const QModelIndex& = {}) const override { return 1; }

  QVariant data(const QModelIndex& index, int role) const override {
    if (index.internalId() == 0) return MissionData(index.row(), role);
    const ScanSummary* scan = ScanOf(index);
    if (scan == nullptr) return {};
    if (role == Qt::DisplayRole) return TextFor(*scan);
    if (role == Qt::ToolTipRole) return QString::fromStdString(scan->reason);
    if (role == Qt::DecorationRole) return Thumbnail(*scan);
    // Or the view would ask for every thumbnail to know how high its row is.
    if (role == Qt::SizeHintRole)
      return QSize(kThumbnailSize.width(),
                   std::max(kThumbnailSize.height(), 3 * QFontMetrics(font_).lineSpacing()) + 6);
    return {};
  }

 private:
  QVariant MissionData(int row, int role) const {
    const QString path = QString::fromStdString(shown_[static_cast<std::size_t>(row)].first);
    if (role == Qt::ToolTipRole) return path;
    if (role != Qt::DisplayRole) return {};
    return OpenMissions::tr("%1 (scans: %2)")
        .arg(QFileInfo(path).fileName())
        .arg(static_cast<qulonglong>(shown_[static_cast<std::size_t>(row)].second));
  }
  const ScanSummary* ScanOf(const QModelIndex& index) const {
    const std::size_t mission = index.internalId() - 1;
    if (mission >= review_->Missions().size()) return nullptr;
    const auto& scans = review_->Missions()[mission].scans;
    const auto row = static_cast<std::size_t>(index.row());
    return row < scans.size() ? &scans[row] : nullptr;
  }
  QIcon Thumbnail(const ScanSummary& scan) const {
    const auto known = thumbnails_.find(scan.uuid);
    if (known != thumbnails_.end()) return known->second;
    ++decoded_;
    return thumbnails_[scan.uuid] = IconFor(scan);
  }

  const ReviewViewModel* review_;
  QFont font_;
  std::vector<std::pair<std::string, std::size_t>> shown_;  ///< path and number of scans
  mutable std::map<std::string, QIcon> thumbnails_;         ///< by uuid
  mutable int decoded_ = 0;
};

OpenMissions::OpenMissions(ReviewViewModel* review, QWidget* parent)
    : QTreeView(parent), review_(review), items_(new OpenMissionsItems(review, font(), this)) {
  setModel(items_);
  setHeaderHidden(true);
  setIconSize(kThumbnailSize);
  setIndentation(14);
  setVerticalScrollMode(ScrollPerPixel);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setTextElideMode(Qt::ElideRight);
  setContextMenuPolicy(Qt::CustomContextMenu);
  setAccessibleName(tr("Missions that are open for review"));
  setMinimumHeight(60);
  const auto show = [this](const QModelIndex& index) {
    if (index.internalId() != 0)
      review_->ShowScanOf(static_cast<int>(index.internalId()) - 1, index.row());
  };
  connect(this, &QTreeView::clicked, this, show);
  connect(this, &QTreeView::activated, this, show);
  connect(this, &QTreeView::customContextMenuRequested, this, &OpenMissions::ShowMenu);
  connect(review_, &ReviewViewModel::changed, this, &OpenMissions::ShowMissions);
  connect(items_, &QAbstractItemModel::modelReset, this, &QTreeView::expandAll);
  ShowMissions();
}

void OpenMissions::ShowMissions() {
  items_->Refresh();
  ShowChosen();
}

void OpenMissions::ShowChosen() {
  const QModelIndex mission = items_->index(review_->MissionIndex(), 0);
  const QModelIndex scan =
      mission.isValid() ? items_->index(review_->ScanIndex(), 0, mission) : QModelIndex();
  if (scan == currentIndex()) return;
  setCurrentIndex(scan);
  if (scan.isValid()) scrollTo(scan);
}

void OpenMissions::ShowMenu(const QPoint& point) {
  const QModelIndex index = indexAt(point);
  if (!index.isValid()) return;
  const int mission =
      index.internalId() == 0 ? index.row() : static_cast<int>(index.internalId()) - 1;
  auto* menu = new QMenu(this);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->addAction(tr("Close this mission"), this,
                  [this, mission] { review_->CloseMission(mission); });
  menu->popup(viewport()->mapToGlobal(point));
}

int OpenMissions::MissionCount() const {
  return items_->rowCount();
}

int OpenMissions::ScanCount(int mission) const {
  return items_->rowCount(items_->index(mission, 0));
}

QString OpenMissions::TextOf(int mission, int scan) const {
  const QModelIndex row = items_->index(mission, 0);
  return (scan < 0 ? row : items_->index(scan, 0, row)).data().toString();
}

QRect OpenMissions::RectOf(int mission, int scan) const {
  const QModelIndex row = items_->index(mission, 0);
  return visualRect(scan < 0 ? row : items_->index(scan, 0, row));
}

int OpenMissions::DecodedThumbnails() const {
  return items_->Decoded();
}

}  // namespace foresight
