#include "app/workstation/connect_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/panels/theme.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {
namespace {

QString TextOf(const AnnouncedHead& head) {
  const QString text =
      QStringLiteral("%1    %2")
          .arg(QString::fromStdString(head.name), QString::fromStdString(head.address));
  return head.simulated ? ConnectDialog::tr("%1    simulated").arg(text) : text;
}

}  // namespace

ConnectDialog::ConnectDialog(ConnectModel* model, const QStringList& recent,
                             const std::string& keys, QWidget* parent)
    : QDialog(parent), model_(model), keys_(keys) {
  setObjectName(QStringLiteral("connect_dialog"));
  setWindowTitle(tr("Connect to a head"));
  setMinimumWidth(460);
  search_ = WordsLabel("searchText");
  list_ = new QListWidget;
  list_->setObjectName(QStringLiteral("announcedHeads"));
  list_->setAccessibleName(tr("Heads on the local network"));
  address_ = new QComboBox;
  address_->setObjectName(QStringLiteral("headAddress"));
  address_->setEditable(true);
  address_->addItems(recent);
  address_->setCurrentText(recent.isEmpty() ? QString() : recent.first());
  address_->lineEdit()->setPlaceholderText(tr("HOST or HOST:PORT"));
  thin_ = new QCheckBox(tr("Thin link: some kilobits a second"));
  thin_->setObjectName(QStringLiteral("thinLink"));
  state_ = WordsLabel("connectState");
  connect_ = new QPushButton(tr("Connect"));
  connect_->setObjectName(QStringLiteral("connectToHead"));
  connect_->setDefault(true);
  close_ = new QPushButton(tr("Close"));
  close_->setObjectName(QStringLiteral("closeConnect"));
  close_->setAutoDefault(false);
  auto* form = new QFormLayout;
  form->addRow(tr("Address"), address_);
  form->addRow(QString(), thin_);
  auto* buttons = new QHBoxLayout;
  buttons->addStretch(1);
  buttons->addWidget(connect_);
  buttons->addWidget(close_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(20, 16, 20, 16);
  layout->setSpacing(10);
  layout->addWidget(search_);
  layout->addWidget(list_, 1);
  layout->addLayout(form);
  layout->addWidget(state_);
  layout->addLayout(buttons);
  connect(list_, &QListWidget::currentRowChanged, this, &ConnectDialog::TakeRow);
  connect(list_, &QListWidget::itemActivated, this, &ConnectDialog::Connect);
  connect(connect_, &QPushButton::clicked, this, &ConnectDialog::Connect);
  connect(close_, &QPushButton::clicked, this,
          [this] { model_->Connecting() ? model_->cancel() : reject(); });
  connect(model_, &ConnectModel::changed, this, &ConnectDialog::Show);
  connect(this, &QDialog::finished, model_, [this] {
    if (model_->Connecting()) model_->cancel();
  });
  Show();
  address_->setFocus();
}

void ConnectDialog::Show() {
  search_->setText(model_->SearchText());
  ShowHeads();
  state_->setText(model_->StateText());
  QPalette colors = palette();
  if (model_->Failed()) colors.setColor(QPalette::WindowText, state_color::kBad);
  state_->setPalette(colors);
  connect_->setEnabled(!model_->Connecting());
  close_->setText(model_->Connecting() ? tr("Cancel") : tr("Close"));
}

/// The chosen head stays chosen while others come and go.
void ConnectDialog::ShowHeads() {
  if (shown_ == model_->Heads()) return;
  const int row = list_->currentRow();
  const auto chosen = row < 0 ? AnnouncedHead() : shown_[static_cast<std::size_t>(row)];
  shown_ = model_->Heads();
  const QSignalBlocker quiet(list_);
  list_->clear();
  for (const AnnouncedHead& head : shown_) list_->addItem(TextOf(head));
  const auto found = std::find(shown_.begin(), shown_.end(), chosen);
  list_->setCurrentRow(found == shown_.end() ? -1 : static_cast<int>(found - shown_.begin()));
  // The only head there is, most likely: one press of Enter.
  if (shown_.size() == 1 && address_->currentText().isEmpty()) {
    list_->setCurrentRow(0);
    TakeRow(0);
  }
}

void ConnectDialog::TakeRow(int row) {
  if (row >= 0)
    address_->setCurrentText(QString::fromStdString(shown_[static_cast<std::size_t>(row)].address));
}

/// A head of the list proves its name, one that was typed its address.
LinkArguments ConnectDialog::Chosen() const {
  LinkArguments link;
  link.head = address_->currentText().trimmed().toStdString();
  link.keys = keys_;
  link.thin = thin_->isChecked();
  const int row = list_->currentRow();
  if (row >= 0 && shown_[static_cast<std::size_t>(row)].address == link.head)
    link.name = shown_[static_cast<std::size_t>(row)].name;
  return link;
}

void ConnectDialog::Connect() {
  model_->Connect(Chosen());
}

}  // namespace foresight
