#include "ui/panels/head_panel.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QFrame>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "ui/panels/command_button.h"
#include "ui/panels/head_device_rows.h"
#include "ui/panels/theme.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {
namespace {

QString AnglesAsText(const QVector<double>& angles_deg) {
  QStringList parts;
  for (const double angle : angles_deg) parts << QString::number(angle);
  return parts.join(QStringLiteral(", "));
}

}  // namespace

HeadPanel::HeadPanel(HeadViewModel* head, CommandTable* commands, QWidget* parent)
    : QWidget(parent), head_(head) {
  auto* content = new QWidget;
  auto* layout = new QVBoxLayout(content);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->setSpacing(8);
  layout->addWidget(SectionTitle(tr("Plan")));
  plan_ = BuildPlan();
  layout->addWidget(plan_);
  layout->addWidget(SectionTitle(tr("Prediction")));
  layout->addWidget(BuildPrediction());
  layout->addWidget(SectionTitle(tr("Devices")));
  layout->addWidget(new HeadDeviceRows(head_));
  layout->addStretch(1);
  // On a low window the plan scrolls; the buttons stay where they are.
  QScrollArea* scroll = VerticalScroll(content);
  auto* whole = new QVBoxLayout(this);
  whole->setContentsMargins(0, 0, 0, 0);
  whole->setSpacing(0);
  whole->addWidget(scroll, 1);
  QWidget* buttons = BuildButtons(commands);
  buttons->setContentsMargins(8, 6, 8, 6);
  whole->addWidget(buttons);
  const int bar = scroll->verticalScrollBar()->sizeHint().width();
  setMinimumWidth(
      std::max(content->minimumSizeHint().width() + bar, buttons->minimumSizeHint().width()));
  connect(head_, &HeadViewModel::planChanged, this, &HeadPanel::ShowPlan);
  connect(head_, &HeadViewModel::statusChanged, this, &HeadPanel::ShowStatus);
  ShowPlan();
}

QSize HeadPanel::minimumSizeHint() const {
  return QWidget::minimumSizeHint().expandedTo({minimumWidth(), 0});
}

QWidget* HeadPanel::BuildPlan() {
  auto* plan = new QWidget;
  auto* form = new QFormLayout(plan);
  form->setContentsMargins(0, 0, 0, 0);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  // Wider than what a head can do: a number that is typed stays as it was typed, and the prediction
  // says what is wrong with it.
  AddField(form, tr("From"), -9999, 9999, 5, tr("°"), &PlanFields::from_deg);
  AddField(form, tr("To"), -9999, 9999, 5, tr("°"), &PlanFields::to_deg);
  AddField(form, tr("Speed"), 0, 9999, 1, tr(" °/s"), &PlanFields::speed_deg_s)
      ->setObjectName(QStringLiteral("speed"));
  fastest_button_ = new QPushButton;
  fastest_button_->setObjectName(QStringLiteral("fastestButton"));
  fastest_button_->setToolTip(
      tr("The fastest speed at which 2 % of the image's pixels get a "
         "lidar point"));
  connect(fastest_button_, &QPushButton::clicked, head_, &HeadViewModel::useFastestSpeed);
  form->addRow(QString(), fastest_button_);
  AddChoice(form, tr("Sweep"), {tr("One way"), tr("There and back")}, &PlanFields::there_and_back);
  angles_ = new QLineEdit(AnglesAsText(head_->Plan().image_angles_deg));
  angles_->setToolTip(tr("Motor angles in degrees, separated by commas, within the scope"));
  form->addRow(tr("Images, °"), angles_);
  connect(angles_, &QLineEdit::editingFinished, this, &HeadPanel::TakeAngles);
  show_fields_.push_back([this](const PlanFields& fields) {
    if (!angles_->hasFocus()) angles_->setText(AnglesAsText(fields.image_angles_deg));
  });
  AddChoice(form, tr("Taken"), {tr("In passing"), tr("Standing still")},
            &PlanFields::standing_still);
  AddField(form, tr("Exposure"), 0, 9999, 1, tr(" ms"), &PlanFields::exposure_ms);
  return plan;
}

QDoubleSpinBox* HeadPanel::AddField(QFormLayout* form, const QString& label, double low,
                                    double high, double step, const QString& unit,
                                    double PlanFields::*field) {
  auto* box = new QDoubleSpinBox;
  box->setRange(low, high);
  box->setSingleStep(step);
  box->setDecimals(1);
  box->setMinimumWidth(64);
  box->setSuffix(unit);
  box->setValue(head_->Plan().*field);
  box->setAccessibleName(label);
  form->addRow(label, box);
  connect(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
          [this, field](double value) {
            PlanFields plan = head_->Plan();
            plan.*field = value;
            head_->SetPlan(plan);
          });
  show_fields_.push_back([box, field](const PlanFields& fields) {
    if (box->value() == fields.*field) return;  // a number that is being typed stays as it is
    const QSignalBlocker quiet(box);
    box->setValue(fields.*field);
  });
  return box;
}

void HeadPanel::AddChoice(QFormLayout* form, const QString& label, const QStringList& choices,
                          bool PlanFields::*field) {
  auto* box = new QComboBox;
  box->addItems(choices);
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(6);
  box->setCurrentIndex(head_->Plan().*field ? 1 : 0);
  box->setAccessibleName(label);
  form->addRow(label, box);
  connect(box, QOverload<int>::of(&QComboBox::currentIndexChanged), this, [this, field](int index) {
    PlanFields plan = head_->Plan();
    plan.*field = index == 1;
    head_->SetPlan(plan);
  });
  show_fields_.push_back([box, field](const PlanFields& fields) {
    const QSignalBlocker quiet(box);
    box->setCurrentIndex(fields.*field ? 1 : 0);
  });
}

void HeadPanel::TakeAngles() {
  PlanFields plan = head_->Plan();
  QVector<double> angles;
  bool readable = true;
  for (const QString& part : angles_->text().split(QLatin1Char(','), Qt::SkipEmptyParts)) {
    bool is_number = false;
    angles << part.trimmed().toDouble(&is_number);
    readable = readable && is_number;
  }
  if (readable && !angles.isEmpty()) plan.image_angles_deg = angles;
  angles_->setText(AnglesAsText(plan.image_angles_deg));
  head_->SetPlan(plan);
}

QWidget* HeadPanel::BuildPrediction() {
  auto* card = new QFrame;
  card->setObjectName(QStringLiteral("card"));
  auto* layout = new QVBoxLayout(card);
  auto* form = new QFormLayout;
  form->setLabelAlignment(Qt::AlignLeft);
  const auto add = [form](const QString& label, const QString& tip) {
    auto* value = new QLabel;
    value->setAlignment(Qt::AlignRight);
    value->setToolTip(tip);
    form->addRow(label, value);
    return value;
  };
  time_ = add(tr("Sweep time"), tr("Without the way to the start"));
  lines_ = add(tr("Lidar lines"), {});
  coverage_ = add(tr("Coverage"), tr("Lidar points per image pixel; at least 2 % is wanted"));
  sigma_ = add(tr("Filter reach"), tr("How far the depth filter must reach for points"));
  exposure_ = add(tr("Exposure"), tr("In passing the head shortens it, so that the turn blurs the "
                                     "image by half a pixel at most"));
  sigma_title_ = qobject_cast<QLabel*>(form->labelForField(sigma_));
  layout->addLayout(form);

  warning_row_ = new QWidget;
  auto* row = new QHBoxLayout(warning_row_);
  row->setContentsMargins(0, 0, 0, 0);
  auto* icon = new QLabel;
  icon->setPixmap(Icon("warning").pixmap(20, 20));
  warning_ = new QLabel;
  warning_->setWordWrap(true);
  // Its place is kept, so that Scan and Abort do not move while a plan is typed.
  warning_->setMinimumHeight(3 * warning_->fontMetrics().lineSpacing() + 6);
  warning_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  QSizePolicy kept = warning_row_->sizePolicy();
  kept.setRetainSizeWhenHidden(true);
  warning_row_->setSizePolicy(kept);
  row->addWidget(icon, 0, Qt::AlignTop);
  row->addWidget(warning_, 1);
  layout->addWidget(warning_row_);
  return card;
}

QWidget* HeadPanel::BuildButtons(CommandTable* commands) {
  auto* buttons = new QWidget;
  auto* layout = new QVBoxLayout(buttons);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  auto* scan = new QPushButton(tr("Scan  (Space)"));
  scan->setObjectName(QStringLiteral("scanButton"));
  auto* abort = new QPushButton(Icon("abort"), tr("Abort"));
  auto* home = new QPushButton(Icon("home"), tr("Home"));
  BindButton(scan, commands, "head.scan");
  BindButton(abort, commands, "head.abort");
  BindButton(home, commands, "head.home");
  layout->addWidget(scan);
  auto* row = new QHBoxLayout;
  row->addWidget(abort);
  row->addWidget(home);
  layout->addLayout(row);
  return buttons;
}

void HeadPanel::ShowPlan() {
  const PredictionText prediction = head_->Prediction();
  time_->setText(prediction.time);
  lines_->setText(prediction.lines);
  coverage_->setText(prediction.coverage);
  sigma_->setText(prediction.sigma);
  exposure_->setText(prediction.exposure);
  const double fastest = prediction.fastest_deg_s;
  fastest_button_->setText(fastest > 0.0 ? tr("Fastest: %1 °/s").arg(fastest, 0, 'f', 1)
                                         : tr("Fastest: not known"));
  fastest_button_->setEnabled(fastest > 0.0 &&
                              std::abs(fastest - head_->Plan().speed_deg_s) > 0.05);
  for (const auto& show : show_fields_) show(head_->Plan());
  if (!prediction.method.isEmpty()) sigma_title_->setText(tr("Reach of %1").arg(prediction.method));
  warning_->setText(prediction.warning);
  warning_row_->setVisible(!prediction.warning.isEmpty());
  ShowStatus();
}

void HeadPanel::ShowStatus() {
  if (plan_->isEnabled() != head_->CanEditPlan()) plan_->setEnabled(head_->CanEditPlan());
}

}  // namespace foresight
