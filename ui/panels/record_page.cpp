#include "ui/panels/record_page.h"

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/geometry/angles.h"
#include "ui/panels/live_board_view.h"
#include "ui/panels/stand_lamps.h"
#include "ui/panels/theme.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {
namespace {

using Kind = SessionCapture::Kind;

QString TextOf(const BoardImageRow& row) {
  using State = BoardImageRow::State;
  switch (row.state) {
    case State::kLooking:
      return RecordPage::tr("%1: looking for the board").arg(row.file);
    case State::kNoBoard:
      return row.fault.isEmpty() ? RecordPage::tr("%1: no board found").arg(row.file)
                                 : RecordPage::tr("%1: %2").arg(row.file, row.fault);
    case State::kLeftOut:
      return RecordPage::tr("%1: contradicts the others, not used").arg(row.file);
    case State::kExcluded:
      return RecordPage::tr("%1: left out by you").arg(row.file);
    case State::kUsed:
      break;
  }
  return std::isfinite(row.rms_px)
             ? RecordPage::tr("%1: rms %2 px").arg(row.file).arg(row.rms_px, 0, 'f', 2)
             : RecordPage::tr("%1: board found").arg(row.file);
}

}  // namespace

RecordPage::RecordPage(ChainCalibrationModel* model, QWidget* parent)
    : QWidget(parent),
      model_(model),
      next_(WordsLabel("nextPlace")),
      lamps_(new StandLamps),
      selected_(WordsLabel("selectedStop")),
      leave_out_(NarrowButton("leaveStopOut", tr("Leave stop out"))),
      leave_place_out_(NarrowButton("leavePlaceOut", tr("Leave place out"))),
      again_(NarrowButton("captureAgain", tr("Capture again"))),
      images_title_(SectionTitle({})),
      images_(new QListWidget) {
  images_->setAccessibleName(tr("Images for the camera alone"));
  images_->setToolTip(tr("Clear the mark of an image to leave it out; Ctrl+Z takes that back"));
  images_->setFixedHeight(120);
  lamps_->setObjectName(QStringLiteral("recordLamps"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->setSpacing(6);
  layout->addWidget(next_);
  if (model_->Recorder()->Stand() != nullptr) layout->addWidget(BuildStand());
  layout->addWidget(BuildCaptures());
  layout->addWidget(SectionTitle(tr("Places of the stand")));
  layout->addWidget(lamps_);
  layout->addWidget(selected_);
  auto* row = new QGridLayout;
  row->setSpacing(6);
  row->addWidget(leave_out_, 0, 0);
  row->addWidget(leave_place_out_, 0, 1);
  row->addWidget(again_, 1, 0, 1, 2);
  layout->addLayout(row);
  layout->addWidget(images_title_);
  layout->addWidget(images_);
  layout->addWidget(SectionTitle(tr("Camera now")));
  layout->addWidget(new LiveBoardView(model_->Live()));
  layout->addStretch(1);
  connect(lamps_, &StandLamps::selected, model_, &ChainCalibrationModel::Select);
  connect(leave_out_, &QPushButton::clicked, this, &RecordPage::ToggleSelected);
  connect(leave_place_out_, &QPushButton::clicked, this, &RecordPage::TogglePlace);
  connect(again_, &QPushButton::clicked, this, &RecordPage::CaptureAgain);
  connect(images_, &QListWidget::itemChanged, this, [this](const QListWidgetItem* item) {
    model_->SetExcluded({Kind::kIntrinsicImage, -1, images_->row(item)},
                        item->checkState() != Qt::Checked);
  });
  Refresh();
}

QWidget* RecordPage::BuildStand() {
  auto* box = new QWidget;
  auto* grid = new QGridLayout(box);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(6);
  stand_at_ = new QComboBox;
  stand_at_->setObjectName(QStringLiteral("standAt"));
  stand_at_->setAccessibleName(tr("Where the simulated stand is"));
  stand_at_->addItem(tr("away"));
  for (const MovingStand::Place& place : model_->Recorder()->Stand()->Places())
    stand_at_->addItem(QString::fromStdString(place.name));
  all_ = NarrowButton("captureAll", tr("Capture all places"));
  grid->addWidget(new QLabel(tr("Simulated stand")), 0, 0);
  grid->addWidget(stand_at_, 0, 1);
  grid->addWidget(all_, 1, 0, 1, 2);
  connect(stand_at_, QOverload<int>::of(&QComboBox::activated), this,
          [this](int at) { model_->Recorder()->MoveStand(at - 1); });
  connect(all_, &QPushButton::clicked, model_->Tour(), &StandTour::start);
  return box;
}

QWidget* RecordPage::BuildCaptures() {
  auto* box = new QWidget;
  auto* grid = new QGridLayout(box);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(6);
  stops_ = NarrowButton("captureStops", tr("Capture stops"));
  sweep_ = NarrowButton("captureSweep", tr("Sweep"));
  place_ = NarrowButton("newPlace", tr("New place"));
  image_ = NarrowButton("captureBoardImage", tr("Image for camera"));
  same_place_ = NarrowButton("samePlace", tr("Same place"),
                             tr("The stand is still where the session's last stops were captured"));
  end_ = NarrowButton("endCapture", tr("End"), tr("End the captures; those that came are kept"));
  grid->addWidget(stops_, 0, 0);
  grid->addWidget(sweep_, 0, 1);
  grid->addWidget(place_, 0, 2);
  grid->addWidget(image_, 1, 0, 1, 2);
  grid->addWidget(end_, 1, 2);
  grid->addWidget(same_place_, 2, 0, 1, 3);
  CalibrationRecorder* recorder = model_->Recorder();
  connect(stops_, &QPushButton::clicked, recorder, &CalibrationRecorder::captureStops);
  connect(sweep_, &QPushButton::clicked, recorder, &CalibrationRecorder::captureSweep);
  connect(place_, &QPushButton::clicked, recorder, &CalibrationRecorder::newPlace);
  connect(same_place_, &QPushButton::clicked, recorder, &CalibrationRecorder::samePlace);
  connect(image_, &QPushButton::clicked, recorder, &CalibrationRecorder::captureBoardImage);
  connect(end_, &QPushButton::clicked, model_->Tour(), &StandTour::end);
  connect(end_, &QPushButton::clicked, recorder->Captures(), &HeadCaptures::end);
  return box;
}

const StopLamp* RecordPage::Selected() const {
  const auto& places = model_->Places();
  const int place = model_->SelectedPlace(), stop = model_->SelectedStop();
  if (place < 0 || place >= static_cast<int>(places.size())) return nullptr;
  const auto& stops = places[static_cast<std::size_t>(place)].stops;
  return stop >= 0 && stop < static_cast<int>(stops.size()) ? &stops[static_cast<std::size_t>(stop)]
                                                            : nullptr;
}

void RecordPage::ToggleSelected() {
  const StopLamp* lamp = Selected();
  if (lamp == nullptr || lamp->number < 0) return;
  model_->SetExcluded({Kind::kStop, model_->SelectedPlace(), lamp->number},
                      lamp->state != StopLamp::State::kExcluded);
}

void RecordPage::TogglePlace() {
  const int place = model_->SelectedPlace();
  if (Selected() == nullptr) return;
  model_->SetExcluded({Kind::kPose, place, -1},
                      !model_->Places()[static_cast<std::size_t>(place)].excluded);
}

void RecordPage::CaptureAgain() {
  model_->CaptureStopAgain(model_->SelectedPlace(), model_->SelectedStop());
}

void RecordPage::ShowStand() {
  if (stand_at_ == nullptr) return;
  stand_at_->setCurrentIndex(model_->Recorder()->Stand()->At() + 1);
  stand_at_->setEnabled(model_->Recorder()->WhyNotMoveStand().isEmpty() &&
                        !model_->Tour()->Running());
  ShowPossible(all_,
               tr("From where the stand is on: an image for the camera alone, or stops and a "
                  "sweep, at each of its places"),
               model_->Tour()->WhyNot());
}

void RecordPage::Refresh() {
  ShowStand();
  next_->setText(model_->Next());
  const QString why = model_->Recorder()->WhyNotCapture();
  ShowPossible(stops_,
               tr("Go to each stop that is not captured here yet: an image and lidar lines"), why);
  ShowPossible(sweep_, tr("Sweep up and down, for the lidar's time stamps"),
               model_->Recorder()->WhyNotSweep());
  ShowPossible(place_, tr("The stand was put to another place"),
               model_->Recorder()->WhyNotNewPlace());
  ShowPossible(image_, tr("One image of the board for the camera alone, where the head stands"),
               model_->Recorder()->WhyNotBoardImage());
  same_place_->setVisible(model_->Recorder()->PlaceInQuestion() >= 0);
  end_->setEnabled(model_->Recorder()->Capturing() || model_->Tour()->Running());
  lamps_->Show(model_->Places(), model_->SelectedPlace(), model_->SelectedStop());
  ShowSelected();
  ShowBoardImages();
}

void RecordPage::ShowSelected() {
  const StopLamp* lamp = Selected();
  const bool there = lamp != nullptr && lamp->number >= 0;
  leave_out_->setEnabled(there);
  leave_place_out_->setEnabled(lamp != nullptr);
  again_->setEnabled(there && model_->Recorder()->WhyNotCapture().isEmpty());
  selected_->setVisible(!model_->Places().empty());
  if (lamp == nullptr) {
    selected_->setText(tr("Click a lamp to look at a stop."));
    return;
  }
  const StandPlaceRow& row = model_->Places()[static_cast<std::size_t>(model_->SelectedPlace())];
  QString text = tr("%1, %2°: %3")
                     .arg(row.name)
                     .arg(DegreesFromRadians(lamp->motor_rad), 0, 'g', 4)
                     .arg(StandLamps::InWords(lamp->state));
  if (std::isfinite(lamp->rms_px)) text += tr(", rms %1 px").arg(lamp->rms_px, 0, 'f', 2);
  if (!lamp->fault.isEmpty()) text += tr(" (%1)").arg(lamp->fault);
  if (lamp->stands_out) text += tr("; it fits much worse than the others");
  selected_->setText(text + QLatin1Char('.'));
  leave_out_->setText(lamp->state == StopLamp::State::kExcluded ? tr("Take stop in")
                                                                : tr("Leave stop out"));
  leave_place_out_->setText(row.excluded ? tr("Take place in") : tr("Leave place out"));
}

void RecordPage::ShowBoardImages() {
  const auto& rows = model_->BoardImages();
  const auto used = std::count_if(rows.begin(), rows.end(), [](const BoardImageRow& row) {
    return row.state == BoardImageRow::State::kUsed;
  });
  images_title_->setText(
      tr("Images for the camera alone: %1 of %2 used").arg(used).arg(rows.size()));
  const QSignalBlocker quiet(images_);
  while (images_->count() > static_cast<int>(rows.size()))
    delete images_->takeItem(images_->count() - 1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (static_cast<int>(i) >= images_->count()) images_->addItem(new QListWidgetItem);
    QListWidgetItem* item = images_->item(static_cast<int>(i));
    item->setText(TextOf(rows[i]));
    item->setToolTip(rows[i].origin);
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    const bool excluded = rows[i].state == BoardImageRow::State::kExcluded;
    item->setCheckState(excluded ? Qt::Unchecked : Qt::Checked);
    const bool bad = rows[i].state == BoardImageRow::State::kNoBoard ||
                     rows[i].state == BoardImageRow::State::kLeftOut;
    item->setForeground(bad ? QBrush(state_color::kCaution) : palette().brush(QPalette::Text));
  }
  images_->setVisible(!rows.empty());
}

}  // namespace foresight
