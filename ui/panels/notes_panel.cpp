#include "ui/panels/notes_panel.h"

#include <QComboBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "ui/panels/command_button.h"
#include "ui/viewmodels/no_scan_hint.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {
namespace {

constexpr int kUuidRole = Qt::UserRole;

std::string UuidOf(const QListWidgetItem& item) {
  return item.data(kUuidRole).toString().toStdString();
}

QLabel* Words(const char* name) {
  auto* label = new QLabel;
  label->setWordWrap(true);
  label->setObjectName(QString::fromLatin1(name));
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  return label;
}

}  // namespace

NotesPanel::NotesPanel(SessionModel* session, MeasureViewModel* measure, CommandTable* commands,
                       QWidget* parent)
    : QWidget(parent),
      session_(session),
      notes_(session->Notes()),
      measure_(measure),
      kind_(new QComboBox),
      hint_(Words("faint")),
      empty_(Words("faint")),
      list_(new QListWidget),
      details_(Words("")),
      selected_text_(new QLineEdit),
      selected_tags_(new QLineEdit),
      text_(new QLineEdit),
      tags_(new QLineEdit),
      about_(new QComboBox),
      add_(NarrowButton("addNote", tr("Add note"))),
      problem_(Words("faint")) {
  empty_->setAlignment(Qt::AlignCenter);
  list_->setAccessibleName(tr("Measurements and notes"));
  list_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  list_->setToolTip(tr("Click to see where it is; double-click to rename"));
  list_->setWordWrap(true);
  selected_tags_->setAccessibleName(tr("Tags of the selected note"));
  selected_tags_->setPlaceholderText(tr("Tags of the selected one"));
  selected_text_->setAccessibleName(tr("Name or text of the selected note"));
  selected_text_->setPlaceholderText(tr("Name of the selected one"));
  for (QComboBox* box : {kind_, about_}) {  // what is written in it must not widen the dock
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(4);
  }
  auto* inner = new QWidget;
  auto* layout = new QVBoxLayout(inner);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->setSpacing(8);
  layout->addWidget(BuildMeasureRow(commands));
  layout->addWidget(hint_);
  layout->addWidget(empty_, 1);
  layout->addWidget(list_, 1);
  layout->addWidget(details_);
  layout->addWidget(selected_text_);
  layout->addWidget(selected_tags_);
  layout->addWidget(BuildNewNote());
  FillWithScroll(this, inner);
  setMinimumWidth(200);

  connect(notes_, &NotesModel::changed, this, &NotesPanel::ShowList);
  connect(session_, &SessionModel::scanChanged, this, &NotesPanel::ShowList);
  connect(session_, &SessionModel::objectsChanged, this, &NotesPanel::ShowHint);
  connect(measure_, &MeasureViewModel::changed, this, &NotesPanel::ShowHint);
  connect(list_, &QListWidget::itemClicked, this,
          [this](QListWidgetItem* item) { notes_->Select(UuidOf(*item)); });
  connect(list_, &QListWidget::itemDoubleClicked, this, [this] {
    selected_text_->setFocus();
    selected_text_->selectAll();
  });
  for (QLineEdit* field : {selected_text_, selected_tags_})
    connect(field, &QLineEdit::editingFinished, this, &NotesPanel::TakeChange);
  connect(session_, &SessionModel::earlierChanged, this, &NotesPanel::ShowEmpty);
  ShowEmpty();
  ShowList();
  ShowHint();
}

void NotesPanel::ShowEmpty() {
  const QString hint =
      tr("Nothing was measured or written down yet. Press Measure (L) and click points, or write a "
         "note below.");
  const QString earlier = EarlierNotesHint(*session_);
  empty_->setText(earlier.isEmpty() ? hint : hint + QStringLiteral("\n\n") + earlier);
}

QWidget* NotesPanel::BuildMeasureRow(CommandTable* commands) {
  auto* rows = new QWidget;
  auto* layout = new QGridLayout(rows);
  layout->setContentsMargins(0, 0, 0, 0);
  kind_->setAccessibleName(tr("What is measured"));
  for (const MeasureKind kind : kMeasureKinds) kind_->addItem(NameOf(kind), static_cast<int>(kind));
  connect(kind_, QOverload<int>::of(&QComboBox::activated), this,
          [this] { measure_->SetKind(static_cast<MeasureKind>(kind_->currentData().toInt())); });
  auto* tool = NarrowButton("measureButton", tr("Measure"));
  tool->setCheckable(true);
  BindButton(tool, commands, "measure.tool");
  connect(measure_, &MeasureViewModel::changed, tool,
          [tool, this] { tool->setChecked(measure_->On()); });
  auto* remove = NarrowButton("deleteNote", tr("Delete"));
  BindButton(remove, commands, "notes.delete");
  layout->addWidget(kind_, 0, 0, 1, 2);
  layout->addWidget(tool, 1, 0);
  layout->addWidget(remove, 1, 1);
  return rows;
}

QWidget* NotesPanel::BuildNewNote() {
  auto* box = new QWidget;
  auto* layout = new QVBoxLayout(box);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  text_->setAccessibleName(tr("Text of a new note"));
  text_->setPlaceholderText(tr("New note"));
  tags_->setAccessibleName(tr("Tags of a new note"));
  tags_->setPlaceholderText(tr("Tags, with spaces between"));
  about_->setAccessibleName(tr("What the new note is about"));
  about_->addItem(tr("This scan"), static_cast<int>(Subject::kScan));
  about_->addItem(tr("Selected object"), static_cast<int>(Subject::kObject));
  about_->addItem(tr("Mission"), static_cast<int>(Subject::kMission));
  auto* row = new QHBoxLayout;
  row->addWidget(about_, 1);
  row->addWidget(add_, 1);
  layout->addWidget(text_);
  layout->addWidget(tags_);
  layout->addLayout(row);
  layout->addWidget(problem_);
  problem_->hide();
  for (QLineEdit* field : {text_, tags_}) {
    connect(field, &QLineEdit::returnPressed, this, &NotesPanel::TakeNote);
    connect(field, &QLineEdit::textChanged, this, &NotesPanel::ShowHint);
  }
  connect(about_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &NotesPanel::ShowHint);
  connect(add_, &QPushButton::clicked, this, &NotesPanel::TakeNote);
  return box;
}

QString NotesPanel::WhyNoNote() const {
  const auto about = static_cast<Subject>(about_->currentData().toInt());
  if (about == Subject::kScan && !session_->ShownScan()) return tr("There is no scan.");
  if (about == Subject::kObject && session_->Selected() == nullptr)
    return tr("No object is selected.");
  if (text_->text().trimmed().isEmpty() && tags_->text().trimmed().isEmpty())
    return tr("Write something first.");
  return {};
}

void NotesPanel::TakeNote() {
  if (!WhyNoNote().isEmpty()) return;
  const auto about = static_cast<Subject>(about_->currentData().toInt());
  NoteRecord note;
  note.kind = kNoteKind;
  note.text = text_->text().trimmed().toStdString();
  note.tags = tags_->text().toStdString();
  if (about == Subject::kScan) note.scan_uuid = session_->ShownScan()->uuid;
  if (about == Subject::kObject) {
    note.scan_uuid = session_->Selected()->scan_uuid;
    note.object_uuid = session_->Selected()->uuid;
  }
  const Status added = notes_->Add(std::move(note));
  problem_->setVisible(!added);
  if (!added) {
    problem_->setText(QString::fromStdString(added.error().message));
    return;
  }
  text_->clear();
  tags_->clear();
}

void NotesPanel::TakeChange() {
  const ShownNote* note = notes_->Selected();
  if (note == nullptr) return;
  const Status changed =
      notes_->Change(note->record.uuid, selected_text_->text().trimmed().toStdString(),
                     selected_tags_->text().toStdString());
  problem_->setVisible(!changed);
  if (!changed) problem_->setText(QString::fromStdString(changed.error().message));
}

void NotesPanel::ShowList() {
  const QSignalBlocker blocker(list_);
  list_->clear();
  const std::string scan = session_->ShownScan() ? session_->ShownScan()->uuid : std::string();
  for (const ShownNote& note : notes_->All()) {
    QString text = TextOf(note);
    const std::string& of_scan = note.record.scan_uuid;
    if (of_scan.empty())
      text += tr("  (mission)");
    else if (of_scan != scan)
      text += tr("  (another scan)");
    auto* item = new QListWidgetItem(text, list_);
    item->setData(kUuidRole, QString::fromStdString(note.record.uuid));
    item->setToolTip(DetailsOf(note));
    if (&note == notes_->Selected()) list_->setCurrentItem(item);
  }
  list_->setVisible(list_->count() > 0);
  empty_->setVisible(list_->count() == 0);
  ShowSelected();
  ShowHint();
}

void NotesPanel::ShowSelected() {
  const ShownNote* note = notes_->Selected();
  details_->setVisible(note != nullptr);
  selected_text_->setVisible(note != nullptr);
  selected_tags_->setVisible(note != nullptr);
  if (note == nullptr) return;
  details_->setText(DetailsOf(*note));
  selected_text_->setText(QString::fromStdString(note->record.text));
  selected_tags_->setText(QString::fromStdString(note->record.tags));
}

void NotesPanel::ShowHint() {
  hint_->setText(measure_->Hint());
  hint_->setVisible(measure_->On());
  kind_->setCurrentIndex(kind_->findData(static_cast<int>(measure_->Kind())));
  const QString why_not = WhyNoNote();
  add_->setEnabled(why_not.isEmpty());
  add_->setToolTip(why_not.isEmpty() ? tr("Keep the note in the mission, or in its review")
                                     : why_not);
}

}  // namespace foresight
