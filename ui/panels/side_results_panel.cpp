#include "ui/panels/side_results_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QMenu>
#include <QPointer>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>

#include "ui/panels/command_button.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {
namespace {

QToolButton* SideButton(const QString& text, bool on, const QString& name) {
  auto* button = new QToolButton;
  button->setText(text);
  button->setCheckable(true);
  button->setChecked(on);
  button->setAccessibleName(SideResultsPanel::tr("Choose %1 as %2").arg(name, text));
  button->setToolTip(SideResultsPanel::tr("Compare this one as %1").arg(text));
  return button;
}

}  // namespace

SideResultsPanel::SideResultsPanel(SideResultsModel* model, CommandTable* commands, QWidget* parent)
    : QWidget(parent),
      model_(model),
      name_(new QLineEdit),
      state_(WordsLabel("faint")),
      cards_(new QVBoxLayout),
      numbers_(WordsLabel("resultNumbers")) {
  name_->setObjectName(QStringLiteral("resultName"));
  name_->setPlaceholderText(tr("Name of the next result"));
  name_->setAccessibleName(tr("Name of the next result"));
  auto* run = NarrowButton("runAgain", tr("Run again"));
  auto* with_rig = NarrowButton("runWithRig", tr("With another rig"));
  auto* add = NarrowButton("addMission", tr("Other mission"));
  BindButton(run, commands, "results.run");
  BindButton(with_rig, commands, "results.run_with_rig");
  BindButton(add, commands, "results.add_mission");
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(6);
  for (QPushButton* button : {with_rig, add}) buttons->addWidget(button);
  auto* words = WordsLabel("faint");
  words->setText(
      tr("A run makes all depth maps and fits of this scan again, with the options that are set "
         "now. It is kept beside the mission, which is not touched."));
  auto* compare = new QPushButton(tr("Compare A and B"));
  compare->setObjectName(QStringLiteral("compareResults"));
  BindButton(compare, commands, "results.compare");

  auto* content = new QWidget;
  auto* layout = new QVBoxLayout(content);
  layout->setContentsMargins(12, 8, 12, 8);
  layout->setSpacing(6);
  layout->addWidget(words);
  layout->addWidget(name_);
  layout->addWidget(run);
  layout->addLayout(buttons);
  layout->addWidget(state_);
  cards_->setSpacing(6);
  layout->addLayout(cards_);
  layout->addWidget(compare);
  layout->addWidget(numbers_);
  layout->addStretch(1);
  FillWithScroll(this, content);
  connect(model_, &SideResultsModel::changed, this, &SideResultsPanel::ShowRows);
  ShowRows();
}

QString SideResultsPanel::Name() const {
  return name_->text();
}

QWidget* SideResultsPanel::Card(int index) {
  const ResultRow& row = model_->Rows()[static_cast<std::size_t>(index)];
  auto* card = new QWidget;
  card->setObjectName(QStringLiteral("resultCard"));
  auto* layout = new QVBoxLayout(card);
  layout->setContentsMargins(0, 2, 0, 2);
  layout->setSpacing(2);
  auto* top = new QHBoxLayout;
  auto* name = SectionTitle(row.name);
  auto* a = SideButton(QStringLiteral("A"), model_->A() == index, row.name);
  auto* b = SideButton(QStringLiteral("B"), model_->B() == index, row.name);
  connect(a, &QToolButton::clicked, model_, [this, index] { model_->ChooseA(index); });
  connect(b, &QToolButton::clicked, model_, [this, index] { model_->ChooseB(index); });
  a_ << a;
  b_ << b;
  top->addWidget(name, 1);
  top->addWidget(a);
  top->addWidget(b);
  more_ << (model_->CanChange(index) ? BuildMore(index, name, layout) : nullptr);
  if (more_.back() != nullptr) top->addWidget(more_.back());
  layout->addLayout(top);
  QStringList who;
  if (!row.author.isEmpty()) who << row.author;
  if (row.time.isValid()) who << QLocale().toString(row.time.toLocalTime(), QLocale::ShortFormat);
  if (!who.isEmpty()) {
    auto* label = WordsLabel("faint");
    label->setText(who.join(QStringLiteral(", ")));
    layout->addWidget(label);
  }
  auto* differences = WordsLabel("");
  differences->setText(row.differences.isEmpty() ? tr("the original's settings") : row.differences);
  layout->addWidget(differences);
  return card;
}

QToolButton* SideResultsPanel::BuildMore(int index, QLabel* title, QVBoxLayout* card) {
  const QString name = model_->Rows()[static_cast<std::size_t>(index)].name;
  auto* more = new QToolButton;
  more->setText(tr("More"));
  more->setAccessibleName(tr("Rename or delete %1").arg(name));
  more->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(more);
  menu->addAction(tr("Rename"), this, [this, index, name, title, card] {
    auto* field = new QLineEdit(name);
    field->setObjectName(QStringLiteral("renameResult"));
    field->setAccessibleName(tr("New name of %1").arg(name));
    title->hide();
    card->insertWidget(1, field);
    field->selectAll();
    field->setFocus();
    // After this signal: the cards are made anew then.
    connect(
        field, &QLineEdit::editingFinished, this,
        [this, index, field = QPointer<QLineEdit>(field), title = QPointer<QLabel>(title)] {
          if (!field) return;  // Return and the loss of focus are both told
          const QString wanted = field->text();
          field->deleteLater();
          if (title) title->show();
          model_->Rename(index, wanted);
        },
        Qt::QueuedConnection);
  });
  menu->addAction(tr("Delete"), this, [this, index] { model_->Delete(index); });
  more->setMenu(menu);
  return more;
}

void SideResultsPanel::ShowRows() {
  if (list_ != nullptr) {
    list_->hide();
    list_->deleteLater();  // a button of it may be what was clicked
  }
  a_.clear();
  b_.clear();
  more_.clear();
  list_ = new QWidget;
  auto* layout = new QVBoxLayout(list_);
  layout->setContentsMargins(0, 0, 0, 0);
  for (int i = 0; i < static_cast<int>(model_->Rows().size()); ++i) layout->addWidget(Card(i));
  cards_->addWidget(list_);
  QString state;
  if (model_->Runner()->Busy())
    state = tr("Running the scan again …");
  else if (model_->Comparer()->Busy())
    state = tr("Comparing A and B …");
  else
    state = model_->WhyNoRun();
  state_->setText(state);
  state_->setVisible(!state.isEmpty());
  QStringList lines;
  if (const auto& comparison = model_->Last().comparison)
    for (const std::string& line : ComparisonInWords(*comparison))
      lines << QString::fromStdString(line);
  numbers_->setText(lines.join(QLatin1Char('\n')));
}

}  // namespace foresight
