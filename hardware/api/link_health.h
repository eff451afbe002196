#pragma once

#include <cstdint>
#include <string>

namespace foresight {

/// A path from the head that nobody answers on, beside the link.
struct BurstHealth {
  bool wanted = false;
  std::int64_t bytes = 0;    ///< that came by it
  std::int64_t refused = 0;  ///< datagrams that were not the head's, or came twice
  std::string trouble;       ///< why the head sends none; empty when it does
};

/// What this computer knows of the operator's last stop, or of the last end of a scan that the
/// operator asked for.
enum class StopAnswer {
  kNone,     ///< there was no stop
  kWaiting,  ///< it is sent again and again, and the head has not answered
  kObeyed,   ///< the head answered that it did so: told its motor to stop, told the scan to end
  kRefused,  ///< the head answered that it does not obey
  kUnknown,  ///< the head did not answer in time; it is sent no longer
};

/// How the connection to a head at the far end of a link does. Times are of this computer's own
/// clock, so an age grows when everything else is dead.
struct LinkHealth {
  bool connected = false;         ///< words come; false while the link is lost or was never there
  double age_s = 0.0;             ///< since the last word of the head
  double round_trip_s = 0.0;      ///< of the last sign of life that was answered; 0 = none yet
  double down_bytes_per_s = 0.0;  ///< over the last seconds
  std::int64_t left_bytes = 0;    ///< of scans that are on their way
  double left_s = 0.0;            ///< at that rate; infinite where nothing comes
  BurstHealth burst;
  StopAnswer stop = StopAnswer::kNone;
  StopAnswer end_scan = StopAnswer::kNone;
  std::string end_scan_refusal;  ///< why, where that is kRefused
  bool has_control = false;
  std::string holder;   ///< who has control; empty = nobody
  std::string address;  ///< of the head
  std::string trouble;  ///< what is wrong and what to do; empty when all is well
};

}  // namespace foresight
