#include "ui/viewmodels/live_board_model.h"

#include <cmath>
#include <mutex>

#include "core/calibration/board_detector.h"
#include "core/calibration/mount_detector.h"
#include "core/depth/upsample.h"
#include "ui/viewmodels/sentence.h"

namespace foresight {
namespace {

constexpr double kRate_hz = 3.0;

/// The camera as it has smaller images.
CameraModel ScaledTo(int width, CameraModel camera) {
  const double scale = static_cast<double>(width) / camera.width;
  camera.fx *= scale;
  camera.fy *= scale;
  camera.cx = scale * (camera.cx + 0.5) - 0.5;
  camera.cy = scale * (camera.cy + 0.5) - 0.5;
  camera.width = width;
  camera.height = static_cast<int>(std::lround(scale * camera.height));
  return camera;
}

/// Why a board of a mount was not taken.
QString WhyNotTaken(const CalibrationBoard& board, const GrayImage& image,
                    const std::vector<CornerGrid>& grids) {
  const BoardDetection alone = DetectBoard(image, grids, board, SearchEffort::kQuick);
  if (!alone.rejection.empty()) return Sentence(alone.rejection);
  return LiveBoardModel::tr(
             "%1 x %2: this may be a part of the other board. Show both boards, or all of this "
             "one with its white margin.")
      .arg(board.columns)
      .arg(board.rows);
}

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

void LiveBoardModel::SetBoard(const CalibrationBoard& board) {
  BoardMount alone;
  alone.a = board;
  sought_ = {alone, {}};
}

void LiveBoardModel::SetMount(const BoardMount& mount, const CameraModel& camera) {
  sought_ = {mount, camera};
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
      [image, sought = sought_](const RunContext&) -> Result<Found> {
        if (!sought) return Found();
        FORESIGHT_CHECK(sought->mount.Check());
        const GrayImage gray = ToGray(image->image);
        return sought->mount.b ? LookForMount(*sought, gray) : LookFor(*sought, gray);
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

LiveBoardModel::Found LiveBoardModel::LookFor(const Sought& sought, const GrayImage& image) {
  const CalibrationBoard& board = sought.mount.a;
  BoardDetection detection = DetectBoard(image, board, SearchEffort::kQuick);
  if (!detection.rejection.empty()) return {{}, Sentence(detection.rejection)};
  return {{std::move(detection.view.pixels)},
          tr("Found: %1 x %2.").arg(board.columns).arg(board.rows)};
}

LiveBoardModel::Found LiveBoardModel::LookForMount(const Sought& sought, const GrayImage& image) {
  if (const Status told = CheckInImages(sought.mount); !told)
    return {{}, Sentence(told.error().message)};
  const MountView view = DetectMount(image, sought.mount, ScaledTo(image.width(), sought.camera));
  std::vector<CornerGrid> grids;
  if (!view.a || !view.b) grids = FindGrids(image);
  Found found;
  QStringList texts;
  const auto take = [&](const CalibrationBoard& board, const std::optional<BoardView>& taken) {
    if (taken) found.corners.push_back(taken->pixels);
    texts << (taken ? tr("Found: %1 x %2.").arg(board.columns).arg(board.rows)
                    : WhyNotTaken(board, image, grids));
  };
  take(sought.mount.a, view.a);
  take(*sought.mount.b, view.b);
  if (view.empty() && !view.fault.empty()) texts << Sentence(view.fault);
  found.text = texts.join(QLatin1Char('\n'));
  return found;
}

}  // namespace foresight
