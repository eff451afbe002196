#include "ui/views/layers_menu.h"

#include <QActionGroup>
#include <QPixmap>

#include "core/pictures/sample_picture.h"
#include "ui/render/paint_mark.h"
#include "ui/views/sample_legend.h"

namespace foresight {
namespace {

QPixmap MarkPixmap(RejectReason kind) {
  QPixmap pixmap(16, 16);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  PaintMark(&painter, kind, ColorOf(kind), QPointF(8.0, 8.0));
  return pixmap;
}

}  // namespace

LayersMenu::LayersMenu(LayersViewModel* layers, QWidget* parent) : QMenu(parent), layers_(layers) {
  AddMaps();
  AddSamples();
  AddColors();
  connect(layers_, &LayersViewModel::changed, this, &LayersMenu::Refresh);
  Refresh();
}

void LayersMenu::AddMaps() {
  auto* maps = new QActionGroup(this);
  depth_ = maps->addAction(tr("Depth"));
  confidence_ = maps->addAction(tr("Confidence"));
  addActions({depth_, confidence_});
  connect(depth_, &QAction::triggered, this, [this] { layers_->SetLayer(DepthLayer::kDepth); });
  connect(confidence_, &QAction::triggered, this,
          [this] { layers_->SetLayer(DepthLayer::kConfidence); });
  addSeparator();
  mask_ = addAction(tr("Mask below the threshold"));
  connect(mask_, &QAction::triggered, layers_, &LayersViewModel::setMaskShown);
  iterations_ = addAction(tr("Passes of the filter"));
  iterations_->setToolTip(tr("Step through D0, D1, ... Computes once more to keep them."));
  connect(iterations_, &QAction::triggered, layers_, &LayersViewModel::openIterations);
  for (QAction* action : {depth_, confidence_, mask_, iterations_}) action->setCheckable(true);
}

void LayersMenu::AddSamples() {
  addSection(tr("Lidar samples"));
  for (const RejectReason kind : kSampleKinds) {
    QAction* action =
        addAction(MarkPixmap(kind), kind == RejectReason::kKept
                                        ? NameOf(kind)
                                        : tr("Rejected: %1").arg(NameOf(kind).toLower()));
    action->setCheckable(true);
    connect(action, &QAction::triggered, this,
            [this, kind](bool shown) { layers_->ShowSamples(kind, shown); });
    samples_ << action;
  }
}

void LayersMenu::AddColors() {
  addSection(tr("Colours of depth"));
  auto* group = new QActionGroup(this);
  for (const ColorMapInfo& info : DepthColorMaps()) {
    QAction* action = group->addAction(QString::fromUtf8(info.title));
    action->setCheckable(true);
    addAction(action);
    connect(action, &QAction::triggered, this,
            [this, map = info.map] { layers_->SetDepthColors(map); });
    colors_ << action;
  }
}

void LayersMenu::Refresh() {
  depth_->setChecked(layers_->Layer() == DepthLayer::kDepth);
  confidence_->setChecked(layers_->Layer() == DepthLayer::kConfidence);
  mask_->setChecked(layers_->MaskShown());
  iterations_->setChecked(layers_->IterationsOpen());
  for (int i = 0; i < samples_.size(); ++i)
    samples_[i]->setChecked(layers_->Samples().Shows(kSampleKinds[static_cast<std::size_t>(i)]));
  for (int i = 0; i < colors_.size(); ++i)
    colors_[i]->setChecked(layers_->DepthColors() ==
                           DepthColorMaps()[static_cast<std::size_t>(i)].map);
}

}  // namespace foresight
