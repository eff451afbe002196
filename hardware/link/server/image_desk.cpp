#include "hardware/link/server/image_desk.h"

#include <algorithm>

#include "core/base/shrink_image.h"
#include "core/io/jpeg.h"
#include "core/io/png.h"

namespace foresight {
namespace {

Result<ColorImage> PartOf(const ColorImage& image, const link::ImageRequest& request) {
  if (request.width() == 0 && request.height() == 0) return image;
  const auto within = [](std::int64_t from, std::int64_t size, int of) {
    return from >= 0 && size >= 1 && from + size <= of;
  };
  if (!within(request.left(), request.width(), image.width()) ||
      !within(request.top(), request.height(), image.height()))
    return Fail(ErrorCode::kInvalidInput,
                "part {},{} of {} x {} is not within the image of {} x {} pixels", request.left(),
                request.top(), request.width(), request.height(), image.width(), image.height());
  ColorImage part(request.width(), request.height());
  for (int y = 0; y < part.height(); ++y)
    for (int x = 0; x < part.width(); ++x)
      part(x, y) = image(request.left() + x, request.top() + y);
  return part;
}

}  // namespace

Result<link::ImageReply> MakeImage(ScanShelf& shelf, const link::ImageRequest& request) {
  FORESIGHT_TRY(const auto scan, shelf.Snapshot(request.scan_id()));
  const auto images = static_cast<int>(scan->frames.size());
  if (request.position() < 0 || request.position() >= images)
    return Fail(ErrorCode::kInvalidInput, "scan {} has {} images, and none {} (they count from 0)",
                request.scan_id(), images, request.position());
  if (request.largest_side_px() < 0)
    return Fail(ErrorCode::kInvalidOptions, "a largest side of {} px: must be 1 or more",
                request.largest_side_px());
  const CameraFrame& frame = scan->frames[static_cast<std::size_t>(request.position())];
  FORESIGHT_TRY(ColorImage image, PartOf(frame.image, request));
  if (request.largest_side_px() > 0) image = ShrinkImage(image, request.largest_side_px());
  link::ImageReply reply;
  FORESIGHT_TRY(*reply.mutable_image(), request.jpeg_quality() == 0
                                            ? EncodePng(image, PngContent::kCapture)
                                            : EncodeJpeg(image, request.jpeg_quality()));
  reply.set_motor_angle_rad(frame.motor_angle_rad);
  reply.set_full_width(frame.image.width());
  reply.set_full_height(frame.image.height());
  reply.set_images(images);
  return reply;
}

}  // namespace foresight
