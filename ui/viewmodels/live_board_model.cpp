#include "ui/viewmodels/live_board_model.h"

#include <mutex>

#include "core/calibration/board_detector.h"
#include "core/depth/upsample.h"

namespace foresight {
namespace {

constexpr double kRate_hz = 3.0;

}  // namespace

class LiveBoardModel::Relay : public LiveViewSink {
 public:
  explicit Relay(LiveBoardModel* target) : target_(target) {}

  void Disconnect() {
    const std::lock_guard lock(mutex_);
    target_ = nullptr;
  }
  void OnLiveImage(const LiveImage& image) override {
    Post([copy = std::make_shared<const LiveImage>(image)](LiveBoardModel* target) {
      target->Take(copy);
    });
  }
  void OnLiveViewTrouble(const std::string& what) override {
    Post([text = QString::fromStdString(what)](LiveBoardModel* target) {
      target->TakeTrouble(text);
    });
  }

 private:
  template <class Delivery>
  void Post(Delivery delivery) {
    const std::lock_guard lock(mutex_);
    if (target_ == nullptr) return;
    LiveBoardModel* target = target_;
    QMetaObject::invokeMethod(
        target, [target, delivery = std::move(delivery)] { delivery(target); },
        Qt::QueuedConnection);
  }

  std::mutex mutex_;
  LiveBoardModel* target_;
};

LiveBoardModel::LiveBoardModel(HeadViewModel* head, TaskQueue* tasks, QObject* parent)
    : QObject(parent), head_(head), looker_(tasks, TaskPolicy::kReplace) {
  connect(head_, &HeadViewModel::liveViewTaken, this, [this] {
    if (!relay_) return;
    relay_->Disconnect();
    relay_.reset();
    Q_EMIT changed();
  });
}

LiveBoardModel::~LiveBoardModel() {
  stop();
}

void LiveBoardModel::SetBoards(const std::vector<CalibrationBoard>& boards) {
  boards_ = boards;
}

void LiveBoardModel::start() {
  if (Running()) return;
  auto relay = std::make_shared<Relay>(this);
  LiveViewOptions options;
  options.rate_hz = kRate_hz;
  if (const Status started = head_->StartLiveView(options, relay); !started) {
    text_ = QString::fromStdString(started.error().message);
  } else {
    relay_ = std::move(relay);
    text_ = tr("Waiting for the first image.");
  }
  Q_EMIT changed();
}

void LiveBoardModel::stop() {
  if (!Running()) return;
  relay_->Disconnect();
  relay_.reset();
  head_->StopLiveView();
  newest_.reset();
  image_.reset();
  corners_.clear();
  text_.clear();
  Q_EMIT changed();
}

void LiveBoardModel::Take(std::shared_ptr<const LiveImage> image) {
  newest_ = std::move(image);
  Look();
}

void LiveBoardModel::TakeTrouble(const QString& what) {
  text_ = what;
  Q_EMIT changed();
}

/// One image at a time, always the newest: the search takes longer than the camera.
void LiveBoardModel::Look() {
  if (!newest_ || looker_.Busy()) return;
  const auto image = std::exchange(newest_, nullptr);
  looker_.Run<Found>(
      tr("Looking for the board"),
      [image, boards = boards_](const RunContext&) -> Result<Found> {
        return LookFor(boards, *image);
      },
      [this, image](Result<Found> found) {
        if (!Running()) return;
        image_ = image;
        corners_.clear();
        if (found) {
          corners_ = std::move(found->corners);
          text_ = found->text;
        } else {
          text_ = QString::fromStdString(found.error().message);
        }
        Q_EMIT changed();
        Look();
      });
}

LiveBoardModel::Found LiveBoardModel::LookFor(const std::vector<CalibrationBoard>& boards,
                                              const LiveImage& image) {
  const GrayImage gray = ToGray(image.image);
  Found found;
  QStringList texts;
  for (const CalibrationBoard& board : boards) {
    if (!board.Check()) continue;
    BoardDetection detection = DetectBoard(gray, board, SearchEffort::kQuick);
    if (detection.rejection.empty()) {
      texts << tr("Found: %1 x %2.").arg(board.columns).arg(board.rows);
      found.corners.push_back(std::move(detection.view.pixels));
    } else {
      QString text = QString::fromStdString(detection.rejection);
      text[0] = text[0].toUpper();
      texts << text + QLatin1Char('.');
    }
  }
  found.text = texts.join(QLatin1Char('\n'));
  return found;
}

}  // namespace foresight
