#include "ui/panels/valve_card.h"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>
#include <cmath>

#include "core/geometry/angles.h"
#include "ui/panels/theme.h"
#include "ui/viewmodels/age_text.h"

namespace foresight {
namespace {

struct Look {
  const char* icon;
  QColor color;
};

Look LookOf(VerdictLevel level) {
  switch (level) {
    case VerdictLevel::kConfirmed:
      return {"confirmed", state_color::kGood};
    case VerdictLevel::kLikely:
      return {"likely", state_color::kCaution};
    case VerdictLevel::kUnsure:
      break;
  }
  return {"unsure", state_color::kBad};
}

}  // namespace

ValveCard::ValveCard(QWidget* parent) : QFrame(parent) {
  setObjectName(QStringLiteral("card"));
  badge_ = new QFrame;
  badge_icon_ = new QLabel;
  badge_text_ = new QLabel;
  auto* badge_row = new QHBoxLayout(badge_);
  badge_row->setContentsMargins(8, 4, 12, 4);
  badge_row->addWidget(badge_icon_);
  badge_row->addWidget(badge_text_);
  stale_ = new QLabel(tr("From an earlier scan: not drawn"));
  stale_->setWordWrap(true);
  reason_ = new QLabel;
  reason_->setWordWrap(true);

  auto* form = new QFormLayout;
  form->setVerticalSpacing(6);
  form->setHorizontalSpacing(12);
  const auto add = [form](const QString& label, const QString& tip) {
    auto* name = new QLabel(label);
    name->setObjectName(QStringLiteral("faint"));
    auto* value = new QLabel;
    value->setWordWrap(true);
    value->setToolTip(tip);
    value->setTextInteractionFlags(Qt::TextSelectableByMouse);
    form->addRow(name, value);
    return value;
  };
  center_ = add(tr("Centre"), tr("x forward, y left, z up, in the robot's frame"));
  axis_ = add(tr("Axis"), tr("Direction of the axis towards the viewer, robot frame"));
  diameter_ = add(tr("Diameter"), tr("Of the rim, measured to the middle of its tube"));
  spokes_ = add(tr("Spokes"), {});
  support_ = add(tr("Support"), tr("How the measurements support the template"));
  source_ = add(tr("Scan"), tr("The scan it was found in"));
  age_ = add(tr("Found"), {});

  auto* layout = new QVBoxLayout(this);
  layout->setSpacing(10);
  layout->addWidget(badge_, 0, Qt::AlignLeft);
  layout->addWidget(stale_);
  layout->addWidget(reason_);
  layout->addLayout(form);
}

void ValveCard::Show(const FoundValve& valve, bool is_current) {
  const ValveDetection& found = valve.detection;
  const Look look = LookOf(found.verdict.level);
  badge_->setStyleSheet(QStringLiteral("QFrame { background: %1; border-radius: 4px; } "
                                       "QLabel { color: #16181c; font-weight: bold; }")
                            .arg(look.color.name()));
  badge_icon_->setPixmap(Icon(look.icon).pixmap(20, 20));
  badge_text_->setText(tr("%1, %2 %")
                           .arg(QString::fromUtf8(ToString(found.verdict.level)))
                           .arg(100.0 * found.verdict.probability, 0, 'f', 0));
  stale_->setVisible(!is_current);
  reason_->setText(QString::fromStdString(found.verdict.reason));

  const auto robot_from_object = valve.rig.robot_from_base * found.best.base_from_object;
  const Eigen::Vector3d center_mm = 1000.0 * robot_from_object.translation();
  const Eigen::Vector3d axis = robot_from_object.Rotate(Eigen::Vector3d::UnitZ());
  center_->setText(tr("x %1, y %2, z %3 mm\n(σ %4 mm)")
                       .arg(center_mm.x(), 0, 'f', 0)
                       .arg(center_mm.y(), 0, 'f', 0)
                       .arg(center_mm.z(), 0, 'f', 0)
                       .arg(1000.0 * found.sigma_position_m.norm(), 0, 'f', 1));
  axis_->setText(tr("%1, %2, %3 (σ %4°)")
                     .arg(axis.x(), 0, 'f', 3)
                     .arg(axis.y(), 0, 'f', 3)
                     .arg(axis.z(), 0, 'f', 3)
                     .arg(DegreesFromRadians(found.sigma_axis_rad), 0, 'f', 1));
  diameter_->setText(tr("%1 mm").arg(2000.0 * found.best.model.rim_radius_m, 0, 'f', 0));
  const int spokes = found.best.model.spokes;
  spokes_->setText(spokes == 0 ? tr("none (disc)")
                   : found.phase_observable
                       ? tr("%1 (angle σ %2°)")
                             .arg(spokes)
                             .arg(DegreesFromRadians(found.sigma_phase_rad), 0, 'f', 1)
                       : tr("%1, angle not observable").arg(spokes));
  support_->setText(tr("%1 of %2 rays hit\n%3 % agree, RMS %4 mm")
                        .arg(found.evidence.hits)
                        .arg(found.evidence.rays)
                        .arg(100.0 * found.evidence.inlier_share, 0, 'f', 0)
                        .arg(1000.0 * found.evidence.rms_m, 0, 'f', 1));
  source_->setText(tr("%1\n%2").arg(valve.scan_time.toString(QStringLiteral("yyyy-MM-dd HH:mm:ss")),
                                    QString::fromStdString(valve.scan_uuid).left(8)));
  ShowAge(valve);
}

void ValveCard::ShowAge(const FoundValve& valve) {
  const auto age = std::chrono::steady_clock::now() - valve.found;
  age_->setText(tr("%1 ago").arg(AgeText(std::chrono::duration_cast<std::chrono::seconds>(age))));
}

}  // namespace foresight
