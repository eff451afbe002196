#include "ui/views/cloud_pane.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLocale>
#include <QSignalBlocker>
#include <QToolButton>

#include "ui/views/color_bar.h"
#include "ui/views/templates_in_picture.h"

namespace foresight {
namespace {

constexpr int kDepthStride_px = 2;

}  // namespace

CloudPane::CloudPane(SessionModel* session, QWidget* parent)
    : Pane(new CloudCanvas, tr("No scan yet: press Scan (Space)"), parent),
      session_(session),
      canvas_(static_cast<CloudCanvas*>(Pane::Canvas())),
      source_(new QComboBox),
      color_(new QComboBox) {
  BuildControls();
  connect(session_, &SessionModel::scanChanged, this, [this] {
    SetHint(session_->ExpectsScan()   ? tr("Scanning …")
            : session_->CurrentScan() ? tr("Preparing the cloud …")
                                      : tr("No scan yet: press Scan (Space)"));
  });
  connect(session_, &SessionModel::cloudChanged, this, &CloudPane::Prepare);
  for (auto signal : {&SessionModel::depthChanged, &SessionModel::maskChanged})
    connect(session_, signal, this, [this] {
      if (!ShowsLidar()) Prepare();
    });
  connect(session_, &SessionModel::valvesChanged, this,
          [this] { canvas_->SetTemplates(TemplatesInRobot(*session_)); });
  connect(session_, &SessionModel::scanChanged, this,
          [this] { canvas_->SetTemplates(TemplatesInRobot(*session_)); });
}

void CloudPane::BuildControls() {
  source_->setAccessibleName(tr("Points of"));
  source_->addItem(tr("Lidar points"), static_cast<int>(Source::kLidar));
  source_->addItem(tr("Depth map"), static_cast<int>(Source::kDepth));
  color_->setAccessibleName(tr("Coloured by"));
  FillColors();
  auto* reset = new QToolButton;
  reset->setText(tr("Reset view"));
  reset->setToolTip(tr("Look ahead of the robot again (Home)"));
  Controls()->addWidget(source_);
  Controls()->addWidget(color_);
  Controls()->addWidget(reset);
  connect(source_, QOverload<int>::of(&QComboBox::activated), this, [this] {
    FillColors();
    Prepare();
  });
  connect(color_, QOverload<int>::of(&QComboBox::activated), this, &CloudPane::Prepare);
  connect(reset, &QToolButton::clicked, canvas_, &CloudCanvas::ResetView);
}

void CloudPane::FillColors() {
  const QSignalBlocker blocker(color_);
  color_->clear();
  if (!ShowsLidar()) color_->addItem(tr("Picture"), static_cast<int>(PointColor::kPicture));
  color_->addItem(tr("Height"), static_cast<int>(PointColor::kHeight));
  color_->addItem(tr("Range"), static_cast<int>(PointColor::kRange));
  if (ShowsLidar()) color_->addItem(tr("Intensity"), static_cast<int>(PointColor::kIntensity));
}

PointColor CloudPane::Color() const {
  return static_cast<PointColor>(color_->currentData().toInt());
}

bool CloudPane::ShowsLidar() const {
  return source_->currentData().toInt() == static_cast<int>(Source::kLidar);
}

bool CloudPane::HasData() const {
  if (ShowsLidar()) return session_->Cloud() != nullptr;
  return session_->Depth() && session_->Picture() != nullptr;
}

void CloudPane::Prepare() {
  if (!HasData()) {
    ShowCanvas(false);
    SetCaption({});
    point_count_ = 0;
    return;
  }
  if (runner_.Busy()) {
    // Not replaced at once: while a scan runs newer data come faster than a slow machine prepares.
    outdated_ = true;
    return;
  }
  const auto work = [lidar = ShowsLidar(), cloud = session_->Cloud(), rig = session_->Rig(),
                     scan = session_->CurrentScan(), picture = session_->PictureIndex(),
                     depth = session_->Depth(), mask = session_->Mask(),
                     color = Color()](const RunContext&) -> Result<PointSet> {
    if (lidar) return PointsOf(*cloud, rig, color);
    return PointsOf(depth->dense.depth_m, mask.get(),
                    scan->frames[static_cast<std::size_t>(picture)], scan->rig, color,
                    kDepthStride_px);
  };
  runner_.Run<PointSet>(tr("Preparing the cloud"), work, [this](const Result<PointSet>& set) {
    if (set && HasData()) Show(*set);
    if (std::exchange(outdated_, false)) Prepare();
  });
}

void CloudPane::Show(const PointSet& set) {
  QString title;
  ColorMap map = ColorMap::kTurbo;
  switch (Color()) {
    case PointColor::kHeight:
      title = tr("height, m");
      break;
    case PointColor::kRange:
      title = tr("range, m");
      break;
    case PointColor::kIntensity:
      title = tr("intensity");
      map = ColorMap::kGray;
      break;
    case PointColor::kPicture:
      break;
  }
  ShowCanvas(true);
  const ValueRange range = RobustRange(set.values);
  canvas_->SetPoints(set, map, range);
  Colors()->Set(map, range, title);
  Colors()->setVisible(!set.values.empty());
  point_count_ = set.points.size();
  SetCaption(
      tr("%1 points, robot frame").arg(QLocale().toString(static_cast<qulonglong>(point_count_))));
}

}  // namespace foresight
