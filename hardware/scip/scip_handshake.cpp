#include "hardware/scip/scip_handshake.h"

#include "hardware/scip/scip_status.h"

namespace foresight {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr ScipSession::Duration kBootPoll = std::chrono::milliseconds(200);

tl::unexpected<Error> Refused(const ScipReply& reply) {
  const bool abnormal = reply.status == scip_status::kAbnormal;
  return Fail(abnormal ? ErrorCode::kState : ErrorCode::kDevice, "refused {}, {}",
              reply.echo.substr(0, reply.echo.find(';')), DescribeScipStatus(reply.status));
}

Result<ScipInfo> AskInfo(ScipSession& session, ScipCommand command, ScipSession::Duration timeout) {
  FORESIGHT_TRY(const ScipSession::Arrival arrival, session.Ask({.command = command}, timeout));
  if (arrival.reply.status != scip_status::kOk) return Refused(arrival.reply);
  return DecodeScipInfo(arrival.reply);
}

std::string FieldOf(const ScipInfo& info, const std::string& key) {
  const auto field = info.find(key);
  return field == info.end() ? "" : field->second;
}

Status CheckIdentity(const ScipParameters& found, const ScipLidarOptions& options) {
  if (found.model.rfind(options.model, 0) != 0)
    return Fail(ErrorCode::kInvalidInput, "is a {}, expected a {}", found.model, options.model);
  if (found.first_step != 0 || found.last_step != options.last_step)
    return Fail(ErrorCode::kInvalidInput, "measures steps {} to {}, expected 0 to {}",
                found.first_step, found.last_step, options.last_step);
  return {};
}

/// A device that is still booting accepts connections and refuses this.
Status EnterTimeMode(ScipSession& session, const ScipLidarOptions& options) {
  const auto deadline = SteadyClock::now() + DurationOf(options.boot_timeout_s);
  for (;;) {
    FORESIGHT_TRY(
        const ScipSession::Arrival arrival,
        session.Ask({.command = ScipCommand::kEnterTime}, DurationOf(options.reply_timeout_s)));
    const std::string& status = arrival.reply.status;
    if (status == scip_status::kOk || status == scip_status::kAlready) return {};
    if (status == scip_status::kAbnormal || SteadyClock::now() > deadline)
      return Refused(arrival.reply);
    FORESIGHT_CHECK(session.Drain(kBootPoll));
    // It may also be that a stop came too early and was ignored.
    FORESIGHT_CHECK(Quit(session, DurationOf(options.reply_timeout_s)));
  }
}

}  // namespace

ScipSession::Duration DurationOf(double seconds) {
  return std::chrono::duration_cast<ScipSession::Duration>(std::chrono::duration<double>(seconds));
}

Result<ScipIdentity> Identify(ScipSession& session, const ScipLidarOptions& options) {
  const auto timeout = DurationOf(options.reply_timeout_s);
  FORESIGHT_CHECK(Quit(session, timeout));
  FORESIGHT_CHECK(session.Drain(DurationOf(options.drain_s)));
  FORESIGHT_TRY(const ScipInfo version, AskInfo(session, ScipCommand::kVersion, timeout));
  FORESIGHT_TRY(const ScipInfo parameters, AskInfo(session, ScipCommand::kParameters, timeout));
  // Its words differ from firmware to firmware; that it answers is what counts.
  FORESIGHT_CHECK(AskInfo(session, ScipCommand::kState, timeout));
  ScipIdentity identity;
  FORESIGHT_TRY(identity.parameters, DecodeScipParameters(parameters));
  FORESIGHT_CHECK(CheckIdentity(identity.parameters, options));
  identity.serial = FieldOf(version, "SERI");
  identity.firmware = FieldOf(version, "FIRM");
  return identity;
}

Result<std::vector<ClockReading>> ReadDeviceClock(ScipSession& session, const SensorClock& clock,
                                                  const ScipLidarOptions& options) {
  const auto timeout = DurationOf(options.reply_timeout_s);
  FORESIGHT_CHECK(EnterTimeMode(session, options));
  std::vector<ClockReading> readings;
  for (int i = 0; i < options.clock_readings; ++i) {
    ClockReading reading;
    reading.asked_s = clock.Now();
    FORESIGHT_TRY(const ScipSession::Arrival arrival,
                  session.Ask({.command = ScipCommand::kReadTime}, timeout));
    reading.answered_s = arrival.time_s;
    if (arrival.reply.status != scip_status::kOk) return Refused(arrival.reply);
    FORESIGHT_TRY(reading.stamp_ms, DecodeScipTime(arrival.reply));
    readings.push_back(reading);
  }
  FORESIGHT_CHECK(session.Ask({.command = ScipCommand::kLeaveTime}, timeout));
  return readings;
}

Status Quit(ScipSession& session, ScipSession::Duration timeout) {
  if (session.Ask({.command = ScipCommand::kQuit}, timeout / 2)) return {};
  FORESIGHT_CHECK(session.Ask({.command = ScipCommand::kQuit}, timeout));
  return {};
}

Status BeginStream(ScipSession& session, const ScipRequest& request,
                   ScipSession::Duration timeout) {
  FORESIGHT_CHECK(Quit(session, timeout));
  FORESIGHT_TRY(ScipSession::Arrival arrival, session.Ask(request, timeout));
  if (arrival.reply.status == scip_status::kRefused) {
    FORESIGHT_CHECK(Quit(session, timeout));
    FORESIGHT_TRY(arrival, session.Ask(request, timeout));
  }
  if (arrival.reply.status != scip_status::kOk) return Refused(arrival.reply);
  return {};
}

Status Reboot(ScipSession& session, ScipSession::Duration timeout) {
  FORESIGHT_CHECK(session.Ask({.command = ScipCommand::kReboot}, timeout));
  // The device is gone when it has understood, often before its answer is out.
  static_cast<void>(session.Ask({.command = ScipCommand::kReboot}, timeout));
  return {};
}

}  // namespace foresight
