#include "ui/panels/mission_search_panel.h"

#include <QComboBox>
#include <QDateTime>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/panels/theme.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {
namespace {

const char* IconOf(const MissionHit& hit) {
  if (hit.what == "scan") return "timeline_scans";
  return hit.what == "object" ? "timeline_found" : "timeline_alarm";
}

QString TextOf(const MissionHit& hit) {
  return MissionSearchPanel::tr("%1\n%2, %3")
      .arg(QString::fromStdString(hit.text),
           QDateTime::fromMSecsSinceEpoch(hit.utc_ns / 1'000'000)
               .toString(QStringLiteral("yyyy-MM-dd HH:mm:ss")),
           QString::fromStdString(hit.mission.filename().string()));
}

}  // namespace

MissionSearchPanel::MissionSearchPanel(MissionSearchModel* model, QWidget* parent)
    : QWidget(parent),
      model_(model),
      words_(new QLineEdit),
      what_(new QComboBox),
      folder_(new QLabel),
      summary_(WordsLabel("faint")),
      found_(new QListWidget) {
  words_->setPlaceholderText(tr("Words: valve, interrupted, a name …"));
  words_->setAccessibleName(tr("Words to search for"));
  words_->setClearButtonEnabled(true);
  what_->setAccessibleName(tr("Where to search"));
  using What = MissionSearchModel::What;
  const auto add = [this](const QString& text, What what) {
    what_->addItem(text, static_cast<int>(what));
  };
  add(tr("Everything"), What::kEverything);
  add(tr("Scans"), What::kScans);
  add(tr("Objects"), What::kObjects);
  add(tr("Accepted objects"), What::kAccepted);
  add(tr("Rejected objects"), What::kRejected);
  add(tr("Messages"), What::kLog);
  folder_->setObjectName(QStringLiteral("faint"));
  folder_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  auto* choose = NarrowButton("searchFolder", tr("Folder"), tr("Search another folder"));
  choose->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  found_->setAccessibleName(tr("What was found"));
  found_->setUniformItemSizes(true);
  found_->setWordWrap(false);
  found_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  found_->setMinimumHeight(60);

  auto* folder_row = new QHBoxLayout;
  folder_row->addWidget(folder_, 1);
  folder_row->addWidget(choose);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(12, 8, 12, 8);
  layout->setSpacing(6);
  layout->addWidget(words_);
  layout->addWidget(what_);
  layout->addLayout(folder_row);
  layout->addWidget(summary_);
  layout->addWidget(found_, 1);

  connect(words_, &QLineEdit::textChanged, model_, &MissionSearchModel::SetText);
  connect(words_, &QLineEdit::returnPressed, model_, &MissionSearchModel::search);
  connect(what_, QOverload<int>::of(&QComboBox::activated), this, [this] {
    model_->SetWhat(static_cast<MissionSearchModel::What>(what_->currentData().toInt()));
  });
  connect(choose, &QPushButton::clicked, this, &MissionSearchPanel::folderWanted);
  const auto open = [this](const QListWidgetItem* item) { model_->Open(found_->row(item)); };
  connect(found_, &QListWidget::itemClicked, this, open);
  connect(found_, &QListWidget::itemActivated, this, open);
  connect(model_, &MissionSearchModel::changed, this, &MissionSearchPanel::ShowFound);
  connect(model_, &MissionSearchModel::folderChanged, this, &MissionSearchPanel::ShowFolder);
  ShowFolder();
}

void MissionSearchPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (stale_) model_->search();
  stale_ = false;
}

void MissionSearchPanel::ShowFolder() {
  folder_->setText(tr("In %1").arg(QFileInfo(model_->Folder()).fileName()));
  folder_->setToolTip(model_->Folder());
}

void MissionSearchPanel::ShowFound() {
  summary_->setText(model_->Summary());
  QStringList unreadable;
  for (const std::string& line : model_->Unreadable()) unreadable << QString::fromStdString(line);
  summary_->setToolTip(unreadable.join(QLatin1Char('\n')));
  if (model_->Busy()) return;  // what was found before stays until there is more to show
  found_->clear();
  for (const MissionHit& hit : model_->Hits()) {
    auto* item = new QListWidgetItem(Icon(IconOf(hit)), TextOf(hit), found_);
    item->setToolTip(QString::fromStdString(hit.mission.string()));
  }
}

QString MissionSearchPanel::SummaryText() const {
  return summary_->text();
}

}  // namespace foresight
