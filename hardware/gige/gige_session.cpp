#include "hardware/gige/gige_session.h"

#include <atomic>
#include <limits>
#include <mutex>

#include "hardware/gige/aravis_handle.h"
#include "hardware/gige/pixel_formats.h"
#include "hardware/net/udp_socket.h"

namespace foresight {
namespace {

// Registers that GigE Vision gives to every device.
constexpr guint64 kTimestampControl = 0x0944;
constexpr guint32 kLatch = 2;
constexpr guint64 kTimestampHigh = 0x0948;
constexpr guint64 kTimestampLow = 0x094C;
constexpr guint64 kControlPrivilege = 0x0A00;

}  // namespace

struct GigeSession::Impl {
  Impl(const GigeCameraOptions& opened_with, std::function<void()> wake_up)
      : options(opened_with), wake(std::move(wake_up)) {}
  ~Impl();

  Status Open();
  Status OpenDevice();
  Status ConfigureForTriggers();
  Status ReadLimits();
  Status StartStream();

  /// Turns what Aravis reported into a Status, and remembers a silence.
  Status Judge(const ArvFailure& failure, const char* what) {
    if (!failure) return {};
    if (failure.IsTimeout()) answering = false;
    return Fail(ErrorCode::kDevice, "{}: {}", what, failure.text());
  }
  Result<guint32> ReadRegister(guint64 address, const char* what) {
    ArvFailure failure;
    guint32 value = 0;
    arv_device_read_register(device.get(), address, &value, failure.out());
    FORESIGHT_CHECK(Judge(failure, what));
    return value;
  }

  static void OnStream(void* self, ArvStreamCallbackType type, ArvBuffer* /*buffer*/) {
    if (type == ARV_STREAM_CALLBACK_TYPE_BUFFER_DONE) static_cast<Impl*>(self)->wake();
  }
  /// Asked for, and not heard from the signal "control-lost": Aravis' heartbeat thread holds a
  /// reference while it emits that. Dropped meanwhile, the device would be destroyed by that
  /// thread, which then waits for itself, and GLib ends the program.
  bool InControl() const { return arv_gv_device_is_controller(ARV_GV_DEVICE(device.get())) != 0; }

  const GigeCameraOptions options;
  const std::function<void()> wake;
  std::atomic<bool> answering{true};
  Limits limits;
  double ticks_per_s = 0.0;
  bool has_thermometer = false;
  ArvHandle<ArvDevice> device;
  ArvHandle<ArvCamera> camera;
  ArvHandle<ArvStream> stream;
};

/// Stopping asks the camera: not one that does not answer.
GigeSession::Impl::~Impl() {
  if (stream && answering && InControl()) arv_camera_stop_acquisition(camera.get(), nullptr);
}

Status GigeSession::Impl::Open() {
  FORESIGHT_CHECK(OpenDevice());
  FORESIGHT_CHECK(ConfigureForTriggers());
  FORESIGHT_CHECK(ReadLimits());
  return StartStream();
}

Status GigeSession::Impl::OpenDevice() {
  FORESIGHT_TRY(const std::string local, LocalAddressTowards(options.address));
  const ArvHandle<GInetAddress> here(g_inet_address_new_from_string(local.c_str()));
  const ArvHandle<GInetAddress> there(g_inet_address_new_from_string(options.address.c_str()));
  ArvFailure failure;
  {
    // Aravis fills tables of the process, without a lock, when it reads a camera's XML.
    static std::mutex reading;
    const std::lock_guard lock(reading);
    device.reset(arv_gv_device_new(here.get(), there.get(), failure.out()));
  }
  FORESIGHT_CHECK(Judge(failure, "cannot open"));
  if (!device) return Fail(ErrorCode::kDevice, "cannot open");
  // Open nonetheless: Aravis leaves a device readable that somebody else controls.
  if (!InControl())
    return Fail(ErrorCode::kDevice,
                "is controlled by another client, or by one that crashed a few seconds ago");
  // Raw packet sockets need rights that the program must not have.
  arv_gv_device_set_stream_options(ARV_GV_DEVICE(device.get()),
                                   ARV_GV_STREAM_OPTION_PACKET_SOCKET_DISABLED);
  camera.reset(arv_camera_new_with_device(device.get(), failure.out()));
  return Judge(failure, "cannot open");
}

Status GigeSession::Impl::ConfigureForTriggers() {
  const auto step = [&](const char* what, auto&& call) -> Status {
    ArvFailure failure;
    call(failure.out());
    return Judge(failure, what);
  };
  ArvCamera* const c = camera.get();
  FORESIGHT_CHECK(step("stopping what an earlier client began",
                       [&](GError** e) { arv_camera_stop_acquisition(c, e); }));
  FORESIGHT_CHECK(step("pixel format", [&](GError** e) {
    arv_camera_set_pixel_format_from_string(c, ToString(options.format), e);
  }));
  FORESIGHT_CHECK(step("continuous acquisition", [&](GError** e) {
    arv_camera_set_acquisition_mode(c, ARV_ACQUISITION_MODE_CONTINUOUS, e);
  }));
  FORESIGHT_CHECK(
      step("software trigger", [&](GError** e) { arv_camera_set_trigger(c, "Software", e); }));
  if (options.packet_bytes > 0)
    FORESIGHT_CHECK(step("packet size", [&](GError** e) {
      arv_camera_gv_set_packet_size(c, options.packet_bytes, e);
    }));
  if (options.packet_delay_s > 0.0)
    FORESIGHT_CHECK(step("packet delay", [&](GError** e) {
      arv_camera_gv_set_packet_delay(c, static_cast<gint64>(1e9 * options.packet_delay_s), e);
    }));
  return {};
}

Status GigeSession::Impl::ReadLimits() {
  double shortest_us = 0.0;
  double longest_us = 0.0;
  {
    ArvFailure failure;
    arv_camera_get_exposure_time_bounds(camera.get(), &shortest_us, &longest_us, failure.out());
    FORESIGHT_CHECK(Judge(failure, "limits of the exposure"));
  }
  limits.shortest_s = 1e-6 * shortest_us;
  limits.longest_s = 1e-6 * longest_us;
  {
    ArvFailure failure;
    arv_camera_get_gain_bounds(camera.get(), &limits.lowest_db, &limits.highest_db, failure.out());
    FORESIGHT_CHECK(Judge(failure, "limits of the gain"));
  }
  ArvFailure failure;
  ticks_per_s = static_cast<double>(
      arv_gv_device_get_timestamp_tick_frequency(ARV_GV_DEVICE(device.get()), failure.out()));
  FORESIGHT_CHECK(Judge(failure, "frequency of the clock"));
  has_thermometer = arv_device_is_feature_available(device.get(), "DeviceTemperature", nullptr);
  return {};
}

Status GigeSession::Impl::StartStream() {
  ArvFailure failure;
  stream.reset(arv_camera_create_stream(camera.get(), &OnStream, this, failure.out()));
  FORESIGHT_CHECK(Judge(failure, "cannot receive images"));
  // A camera answers requests for lost packets; without them an image with one hole is none.
  g_object_set(stream.get(), "packet-resend", ARV_GV_STREAM_PACKET_RESEND_ALWAYS, "socket-buffer",
               ARV_GV_STREAM_SOCKET_BUFFER_AUTO, "packet-request-ratio", 1.0, "frame-retention",
               static_cast<guint>(1e6 * options.frame_retention_s), nullptr);
  const guint payload = arv_camera_get_payload(camera.get(), failure.out());
  FORESIGHT_CHECK(Judge(failure, "size of an image"));
  for (int i = 0; i < options.buffers; ++i)
    arv_stream_push_buffer(stream.get(), arv_buffer_new_allocate(payload));
  arv_camera_start_acquisition(camera.get(), failure.out());
  return Judge(failure, "cannot start");
}

GigeSession::GigeSession(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
GigeSession::~GigeSession() = default;

Result<std::unique_ptr<GigeSession>> GigeSession::Open(const GigeCameraOptions& options,
                                                       std::function<void()> wake) {
  auto impl = std::make_unique<Impl>(options, std::move(wake));
  FORESIGHT_CHECK(impl->Open());
  return std::unique_ptr<GigeSession>(new GigeSession(std::move(impl)));
}

GigeSession::Identity GigeSession::identity() const {
  const auto text = [](const char* found) { return std::string(found ? found : ""); };
  ArvCamera* const camera = impl_->camera.get();
  return {text(arv_camera_get_vendor_name(camera, nullptr)),
          text(arv_camera_get_model_name(camera, nullptr)),
          text(arv_camera_get_device_serial_number(camera, nullptr))};
}

const GigeSession::Limits& GigeSession::limits() const {
  return impl_->limits;
}

Result<CameraSettings> GigeSession::Apply(const CameraSettings& settings) {
  ArvCamera* const camera = impl_->camera.get();
  ArvFailure exposure;
  arv_camera_set_exposure_time(camera, 1e6 * settings.exposure_s, exposure.out());
  FORESIGHT_CHECK(impl_->Judge(exposure, "exposure"));
  ArvFailure gain;
  arv_camera_set_gain(camera, settings.gain_db, gain.out());
  FORESIGHT_CHECK(impl_->Judge(gain, "gain"));
  ArvFailure read;
  CameraSettings taken;
  taken.exposure_s = 1e-6 * arv_camera_get_exposure_time(camera, read.out());
  FORESIGHT_CHECK(impl_->Judge(read, "exposure"));
  taken.gain_db = arv_camera_get_gain(camera, read.out());
  FORESIGHT_CHECK(impl_->Judge(read, "gain"));
  return taken;
}

Status GigeSession::Trigger() {
  ArvFailure failure;
  arv_camera_software_trigger(impl_->camera.get(), failure.out());
  return impl_->Judge(failure, "trigger");
}

std::optional<GigeSession::ReceivedImage> GigeSession::TakeImage() {
  ArvBuffer* const buffer = arv_stream_try_pop_buffer(impl_->stream.get());
  if (!buffer) return std::nullopt;
  ReceivedImage received;
  if (arv_buffer_get_status(buffer) == ARV_BUFFER_STATUS_SUCCESS) {
    received.device_s = 1e-9 * static_cast<double>(arv_buffer_get_timestamp(buffer));
    std::size_t size = 0;
    const auto* const data =
        static_cast<const std::uint8_t*>(arv_buffer_get_image_data(buffer, &size));
    Result<ColorImage> image =
        ToColorImage({data, size}, impl_->options.format, arv_buffer_get_image_width(buffer),
                     arv_buffer_get_image_height(buffer));
    if (image) {
      received.image = std::move(*image);
      received.complete = true;
    }
  }
  arv_stream_push_buffer(impl_->stream.get(), buffer);
  return received;
}

bool GigeSession::HasClock() const {
  return impl_->ticks_per_s > 0.0;
}

Result<CameraClock::Reading> GigeSession::ReadClock(const SensorClock& clock) {
  CameraClock::Reading reading;
  ArvFailure failure;
  reading.asked_s = clock.Now();
  arv_device_write_register(impl_->device.get(), kTimestampControl, kLatch, failure.out());
  reading.answered_s = clock.Now();
  FORESIGHT_CHECK(impl_->Judge(failure, "latch of the clock"));
  FORESIGHT_TRY(const guint32 high, impl_->ReadRegister(kTimestampHigh, "clock"));
  FORESIGHT_TRY(const guint32 low, impl_->ReadRegister(kTimestampLow, "clock"));
  const auto ticks = static_cast<std::uint64_t>(high) << 32U | low;
  reading.device_s = static_cast<double>(ticks) / impl_->ticks_per_s;
  return reading;
}

double GigeSession::ReadTemperature_c() {
  if (!impl_->has_thermometer) return std::numeric_limits<double>::quiet_NaN();
  ArvFailure failure;
  const double temperature_c =
      arv_device_get_float_feature_value(impl_->device.get(), "DeviceTemperature", failure.out());
  return impl_->Judge(failure, "temperature") ? temperature_c
                                              : std::numeric_limits<double>::quiet_NaN();
}

Status GigeSession::Probe() {
  const Result<guint32> read = impl_->ReadRegister(kControlPrivilege, "control");
  if (!read) return tl::unexpected(read.error());
  if (*read == 0) impl_->answering = false;  // it was switched off and on
  return {};
}

bool GigeSession::answering() const {
  return impl_->answering && impl_->InControl();
}

GigeSession::Counts GigeSession::counts() const {
  guint64 completed = 0;
  guint64 failures = 0;
  Counts counts;
  guint64 underruns = 0;
  arv_stream_get_statistics(impl_->stream.get(), &completed, &failures, &underruns);
  guint64 resent = 0;
  guint64 missing = 0;
  arv_gv_stream_get_statistics(ARV_GV_STREAM(impl_->stream.get()), &resent, &missing);
  counts.underruns = static_cast<std::int64_t>(underruns);
  counts.resent_packets = static_cast<std::int64_t>(resent);
  counts.missing_packets = static_cast<std::int64_t>(missing);
  return counts;
}

}  // namespace foresight
