#include "hardware/link/client/image_client.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kImageTimeout{30'000};

}  // namespace

Result<HeadImage> FetchHeadImage(LinkSession& session, const HeadImageOrder& order) {
  link::ImageRequest request;
  request.set_scan_id(order.scan_id);
  request.set_position(order.position);
  request.set_jpeg_quality(order.jpeg_quality);
  request.set_largest_side_px(order.largest_side_px);
  if (order.part) {
    request.set_left(order.part->left);
    request.set_top(order.part->top);
    request.set_width(order.part->width);
    request.set_height(order.part->height);
  }
  link::ImageReply reply;
  const auto context = LinkSession::Context(kImageTimeout);
  const grpc::Status called = session.stub(*context)->FetchImage(context.get(), request, &reply);
  if (!called.ok()) return tl::unexpected(session.ToError(called, "an image"));
  return HeadImage{std::move(*reply.mutable_image()), reply.motor_angle_rad(), reply.full_width(),
                   reply.full_height(), reply.images()};
}

}  // namespace foresight
