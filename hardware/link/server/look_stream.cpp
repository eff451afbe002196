#include "hardware/link/server/look_stream.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>

#include "core/io/jpeg.h"
#include "hardware/link/protocol/messages.h"

namespace foresight {
namespace {

constexpr int kUsualQuality = 75;
constexpr std::chrono::milliseconds kLookTick{100};

/// The newest image, until it is taken. Gone when another station looks: the head forgets its sink.
class NewestImage final : public LiveViewSink {
 public:
  void OnLiveImage(const LiveImage& image) override {
    const std::lock_guard lock(mutex_);
    image_ = image;
    trouble_.clear();
    wake_.notify_all();
  }
  void OnLiveViewTrouble(const std::string& what) override {
    const std::lock_guard lock(mutex_);
    trouble_ = what;
    wake_.notify_all();
  }
  struct News {
    std::optional<LiveImage> image;
    std::string trouble;
  };
  News Take() {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, kLookTick, [this] { return image_ || !trouble_.empty(); });
    return {std::exchange(image_, std::nullopt), std::exchange(trouble_, "")};
  }

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<LiveImage> image_;
  std::string trouble_;
};

}  // namespace

grpc::Status LookStream::Run(const link::LiveViewRequest& request,
                             const std::atomic<bool>& closing) {
  const auto options = FromMessage(request);
  if (!options) return {grpc::StatusCode::INVALID_ARGUMENT, options.error().message};
  const int quality = request.jpeg_quality() == 0 ? kUsualQuality : request.jpeg_quality();
  if (quality < 1 || quality > 100)
    return {grpc::StatusCode::INVALID_ARGUMENT,
            fmt::format("jpeg_quality {} is not within 1 to 100", quality)};
  const auto newest = std::make_shared<NewestImage>();
  if (const Status started = desk_.StartLiveView(*options, newest); !started)
    return {grpc::StatusCode::FAILED_PRECONDITION, started.error().message};
  grpc::Status ended;
  while (!closing && !context_.IsCancelled()) {
    if (!desk_.ShowsTo(newest.get())) {
      ended = {grpc::StatusCode::ABORTED, "another station looks through the camera now"};
      break;
    }
    const NewestImage::News news = newest->Take();
    link::LiveViewImage message;
    message.set_trouble(news.trouble);
    if (news.image) {
      const auto jpeg = EncodeJpeg(news.image->image, quality);
      if (!jpeg) continue;
      message.set_jpeg(*jpeg);
      message.set_time_s(news.image->time_s);
      message.set_motor_angle_rad(news.image->motor_angle_rad);
      message.set_full_width(news.image->full_width);
      message.set_full_height(news.image->full_height);
    }
    if ((news.image || !news.trouble.empty()) && !stream_.Write(message)) break;
  }
  desk_.StopLiveView(newest.get());
  return ended;
}

}  // namespace foresight
