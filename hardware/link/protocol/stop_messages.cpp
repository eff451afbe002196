#include "hardware/link/protocol/stop_messages.h"

#include <cmath>

#include "core/io/png.h"
#include "core/mission/line_codec.h"

namespace foresight {
namespace {

Result<link::StopLine> ToMessage(const LidarLine& line) {
  FORESIGHT_TRY(const PackedLine packed, PackLine(line));
  link::StopLine message;
  message.set_seq(line.seq);
  message.set_time_s(line.time_s);
  message.set_beams(packed.beams);
  message.set_has_intensity(packed.has_intensity);
  message.set_packed(packed.bytes);
  return message;
}

Result<LidarLine> LineFromMessage(const link::StopLine& message) {
  if (!std::isfinite(message.time_s()))
    return Fail(ErrorCode::kBadData, "a captured line: its time is {}", message.time_s());
  LidarLine line;
  line.seq = message.seq();
  line.time_s = message.time_s();
  FORESIGHT_CHECK(UnpackLine(
      {LineCodec::kDeltaPlanesZlib, message.beams(), message.has_intensity(), message.packed()},
      line));
  return line;
}

}  // namespace

Result<link::StopEvent> ToMessage(int number, const StopCapture& capture) {
  link::StopEvent event;
  event.set_number(number);
  event.set_target_rad(capture.target_rad);
  event.set_time_s(capture.position.time_s);
  event.set_angle_rad(capture.position.angle_rad);
  if (capture.image) {
    const CameraFrame& frame = *capture.image;
    link::StopImage& image = *event.mutable_image();
    FORESIGHT_TRY(*image.mutable_png(), EncodePng(frame.image, PngContent::kCapture));
    image.set_seq(frame.seq);
    image.set_time_s(frame.time_s);
    image.set_exposure_s(frame.exposure_s);
    image.set_gain_db(frame.gain_db);
    image.set_motor_angle_rad(frame.motor_angle_rad);
    image.set_target_angle_rad(frame.target_angle_rad);
  }
  for (const LidarLine& line : capture.lines) {
    FORESIGHT_TRY(*event.add_lines(), ToMessage(line));
  }
  return event;
}

Result<link::StopEvent> ToMessage(int number, ScanState end, const std::string& reason) {
  link::StopEvent event;
  event.set_number(number);
  event.set_ended(true);
  event.set_state(ToString(end));
  event.set_reason(reason);
  return event;
}

Result<StopCapture> CaptureFromMessage(const link::StopEvent& event) {
  StopCapture capture;
  capture.target_rad = event.target_rad();
  capture.position = {event.time_s(), event.angle_rad()};
  if (!std::isfinite(event.target_rad()) || !std::isfinite(event.time_s()) ||
      !std::isfinite(event.angle_rad()))
    return Fail(ErrorCode::kBadData, "a capture: its angle or time is not finite");
  if (event.has_image()) {
    const link::StopImage& image = event.image();
    CameraFrame frame;
    frame.seq = image.seq();
    frame.time_s = image.time_s();
    frame.exposure_s = image.exposure_s();
    frame.gain_db = image.gain_db();
    frame.motor_angle_rad = image.motor_angle_rad();
    frame.target_angle_rad = image.target_angle_rad();
    for (const double value : {frame.time_s, frame.exposure_s, frame.gain_db, frame.motor_angle_rad,
                               frame.target_angle_rad})
      if (!std::isfinite(value))
        return Fail(ErrorCode::kBadData, "a captured image: a value of it is not finite");
    FORESIGHT_TRY(frame.image, DecodePng(image.png(), "a captured image"));
    capture.image = std::move(frame);
  }
  for (const link::StopLine& line : event.lines()) {
    FORESIGHT_TRY(LidarLine read, LineFromMessage(line));
    capture.lines.push_back(std::move(read));
  }
  return capture;
}

}  // namespace foresight
