#include "hardware/link/chunks/frame_items.h"

#include <algorithm>
#include <cmath>

#include "core/base/shrink_image.h"
#include "core/io/image_limits.h"
#include "core/io/jpeg.h"
#include "hardware/link/chunks/item_bytes.h"
#include "hardware/link/chunks/lossless_image.h"

namespace foresight {
namespace {

constexpr std::uint8_t kFrameForm = 1;

void AppendFrame(ItemWriter& writer, const CameraFrame& frame) {
  writer.U8(kFrameForm)
      .Signed(frame.seq)
      .Double(frame.time_s)
      .Double(frame.exposure_s)
      .Double(frame.gain_db)
      .Double(frame.motor_angle_rad)
      .Double(frame.target_angle_rad);
}

Result<CameraFrame> ReadFrame(ItemReader& reader) {
  if (reader.U8() != kFrameForm) return Fail(ErrorCode::kBadData, "frame: form is not known");
  CameraFrame frame;
  frame.seq = reader.Signed();
  for (double* value : {&frame.time_s, &frame.exposure_s, &frame.gain_db, &frame.motor_angle_rad,
                        &frame.target_angle_rad}) {
    *value = reader.Double();
    if (!std::isfinite(*value))
      return Fail(ErrorCode::kBadData, "frame {}: a value is {}", frame.seq, *value);
  }
  return frame;
}

}  // namespace

Result<std::string> EncodeFrameJpeg(const CameraFrame& frame, int largest_side_px, int quality) {
  FORESIGHT_TRY(const std::string jpeg,
                largest_side_px > 0 ? EncodeJpeg(ShrinkImage(frame.image, largest_side_px), quality)
                                    : EncodeJpeg(frame.image, quality));
  ItemWriter writer;
  AppendFrame(writer, frame);
  return writer.Varint(static_cast<std::uint64_t>(frame.image.width()))
      .Varint(static_cast<std::uint64_t>(frame.image.height()))
      .Raw(jpeg)
      .Take();
}

Result<FrameItem> DecodeFrameJpeg(std::string_view bytes) {
  ItemReader reader(bytes);
  FrameItem item;
  FORESIGHT_TRY(CameraFrame frame, ReadFrame(reader));
  item.full_width = static_cast<int>(reader.Count(kMaxImageSide));
  item.full_height = static_cast<int>(reader.Count(kMaxImageSide));
  const std::string_view jpeg = reader.Raw(reader.left());
  FORESIGHT_CHECK(reader.Finish("frame"));
  const std::int64_t pixels = std::int64_t{item.full_width} * item.full_height;
  FORESIGHT_TRY(frame.image, DecodeJpeg(jpeg, "frame", std::min(pixels, kMostImagePixels)));
  item.frame = std::make_shared<const CameraFrame>(std::move(frame));
  return item;
}

Result<std::string> EncodeFrameImage(const CameraFrame& frame) {
  ItemWriter writer;
  AppendFrame(writer, frame);
  FORESIGHT_TRY(const std::string image, EncodeLosslessImage(frame.image));
  return writer.Raw(image).Take();
}

Result<CameraFrame> DecodeFrameImage(std::string_view bytes) {
  ItemReader reader(bytes);
  FORESIGHT_TRY(CameraFrame frame, ReadFrame(reader));
  FORESIGHT_TRY(frame.image, DecodeLosslessImage(reader.Raw(reader.left())));
  return frame;
}

}  // namespace foresight
