#include "ui/panels/log_panel.h"

#include <QHeaderView>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "ui/panels/theme.h"

namespace foresight {

LogPanel::LogPanel(LogModel* log, QWidget* parent)
    : QWidget(parent), log_(log), list_(new QTreeWidget) {
  list_->setHeaderLabels({tr("Time"), tr("What happened"), tr("What to do"), tr("State")});
  list_->setRootIsDecorated(false);
  list_->setUniformRowHeights(true);
  list_->setAccessibleName(tr("Messages"));
  list_->header()->setStretchLastSection(false);
  list_->header()->setSectionResizeMode(1, QHeaderView::Stretch);
  list_->header()->setSectionResizeMode(2, QHeaderView::Stretch);
  connect(list_, &QTreeWidget::itemDoubleClicked, this, [this](const QTreeWidgetItem* item) {
    log_->acknowledge(item->data(0, Qt::UserRole).toULongLong());
  });
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 4, 4, 4);
  layout->addWidget(list_);
  setMinimumHeight(60);
  connect(log_, &LogModel::changed, this, [this] {
    if (isVisible()) ShowEntries();
  });
}

void LogPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  ShowEntries();
}

void LogPanel::ShowEntries() {
  list_->clear();
  const auto& entries = log_->Entries();
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
    const char* icon = entry->notice.level == Notice::Level::kError     ? "error"
                       : entry->notice.level == Notice::Level::kWarning ? "warning"
                                                                        : "info";
    QString what = entry->notice.what;
    if (entry->count > 1) what += tr(" (%1 times)").arg(entry->count);
    auto* item =
        new QTreeWidgetItem({entry->time.toString(QStringLiteral("HH:mm:ss")), what,
                             entry->notice.next, entry->acknowledged ? tr("closed") : tr("open")});
    item->setIcon(0, Icon(icon));
    item->setData(0, Qt::UserRole, entry->id);
    item->setToolTip(1, entry->notice.what);
    item->setToolTip(2, entry->notice.next);
    list_->addTopLevelItem(item);
  }
}

}  // namespace foresight
