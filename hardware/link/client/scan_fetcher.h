#pragma once

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "hardware/api/head_link.h"
#include "hardware/api/sensor_head.h"
#include "hardware/link/client/burst_client.h"
#include "hardware/link/client/link_session.h"
#include "hardware/link/client/scan_archive.h"
#include "hardware/link/client/scan_transfer.h"
#include "hardware/link/client/silence_watch.h"
#include "hardware/link/client/transfer_rate.h"

namespace foresight {

/// Brings scans from a head to this station, from a thread of its own, which also calls the sinks:
/// the newest scan first, for which the operator waits, then those that an earlier run left in the
/// spool. When another scan begins, the sink of the one before hears an end, and the rest of that
/// scan goes to the archive when it comes.
class ScanFetcher {
 public:
  struct Options {
    std::filesystem::path spool;            ///< folder of what has come and is not whole
    std::shared_ptr<ScanArchive> archive;   ///< may be null: sinks are all there is
    std::function<std::string()> rig_yaml;  ///< that is in force on the head, if known
    std::function<double()> round_trip;     ///< of the link, s; 0 = not known
    BurstClient* burst = nullptr;           ///< null = no burst path. Outlives the fetcher.
    bool thin = false;  ///< until it is measured: before that, a block of ranges fills a thin path
  };

  /// `session` outlives it.
  ScanFetcher(LinkSession& session, Options options);
  /// Sinks hear that their scans are interrupted; the spool keeps what has come.
  ~ScanFetcher();

  /// A scan was asked for; the sink hears of it when it begins, and of its end whatever happens.
  /// `header` is the station's, for a scan that the head refuses.
  void Expect(const Scan& header, std::shared_ptr<ScanSink> sink);
  /// The head took the command.
  void Started(const std::string& scan_id);
  /// The head will not make the scan: its sink hears a start and this end.
  void Refuse(const std::string& scan_id, const std::string& reason);
  /// Nobody knows whether the head took the command; its list of scans will tell.
  void Doubt(const std::string& scan_id);
  /// What the head says of its scans. `all` = it has no others.
  void Heard(const std::vector<link::ScanOnHead>& scans, bool all);

  /// As HeadLink has them.
  std::vector<LinkedScan> Scans() const;
  std::shared_ptr<const EarlyScan> Early() const;
  void Fetch(const std::string& scan_id);
  void FetchFirst(const std::string& scan_id);
  void Pause(const std::string& scan_id);
  double DownBytesPerS() const;
  void LinesFirst(std::optional<std::pair<std::int64_t, std::int64_t>> seqs);

 private:
  struct Fetched {
    Scan header;
    std::shared_ptr<ScanSink> sink;  ///< null = for the archive alone
    std::int64_t order = 0;          ///< the highest is fetched first
    enum class Command { kSent, kTaken, kDoubtful, kRefused } command = Command::kSent;
    std::string refusal;
    bool paused = false;
    bool done = false;          ///< all of it is here, and kept
    bool confirmed = false;     ///< the head knows that
    double not_before_s = 0.0;  ///< after a failure
    double pause_s = 0.0;       ///< that came before it, where the link broke at once
    LinkedScan shown;
    bool begun = false;                      ///< its first bytes came, so what is left is known
    std::unique_ptr<ScanTransfer> transfer;  ///< of the thread alone
  };

  class Inbox;
  using Stub = std::shared_ptr<link::SensorHead::Stub>;
  using Stream = grpc::ClientReaderWriter<link::TransferRequest, link::Chunk>;

  void TakeInSpools();
  void Work(const std::stop_token& stop);
  std::shared_ptr<Fetched> Next(const std::stop_token& stop);
  bool MayBeFetched(const Fetched& scan) const;
  LinkedScan::Place PlaceOf(const Fetched& scan) const;
  static void Describe(const link::ScanOnHead& there, bool left_is_known, LinkedScan& scan);
  void SetComing(const std::string& scan_id);
  bool Superseded(const Fetched& scan) const;
  void EndSinksOfOthers(const Fetched& newest);
  void EndSink(Fetched& scan, ScanState state, const std::string& reason);
  Status Bring(Fetched& scan, const std::stop_token& stop);
  Fetched& Queued(const std::string& scan_id);
  link::TransferStart StartOf(const Fetched& scan, const std::string& have);
  static std::chrono::milliseconds WaitBeforeTakingIn(const ScanTransfer& transfer,
                                                      double silent_s);
  Status Receive(Fetched& scan, const Stub& stub, Stream& stream, Inbox& inbox);
  Status Acknowledge(Fetched& scan, Stream& stream, std::vector<Chunk> chunks,
                     std::int64_t left_bytes);
  Result<bool> KeepBurst(Fetched& scan, Stream& stream);
  Status TakeIn(Fetched& scan, std::int64_t most_waiting, std::int64_t left_bytes);
  Status Finish(Fetched& scan);
  static void SayThatAllIsHere(Stream& stream, Inbox& inbox);
  void Show(Fetched& scan, std::int64_t left_bytes);
  bool SeemsWide() const;
  double RoundTrip() const;
  link::TransferPreferences Preferences();

  LinkSession& session_;
  const Options options_;
  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable_any wake_;
  std::map<std::string, std::shared_ptr<Fetched>> scans_;
  std::map<std::string, link::ScanOnHead> on_head_;
  std::string coming_;  ///< the scan whose stream is open; empty = none
  std::string newest_;  ///< that was asked for: the scan that Early() is about
  std::int64_t order_ = 0;
  std::int64_t preferences_changed_ = 0;
  std::optional<std::pair<std::int64_t, std::int64_t>> lines_first_;
  std::shared_ptr<const EarlyScan> early_;
  TransferRate rate_;
  double early_s_ = 0.0;  ///< of the thread alone, as what follows
  SilenceWatch silence_;
  std::atomic<bool> ending_ =
      false;            ///< the last of a scan is here, and the head does not know yet
  bool again_ = false;  ///< a stream is to begin at once: on a fresh connection, or with less here
  std::atomic<bool> thin_{false};  ///< the path is known to be thin: only what is small may travel
  std::jthread thread_;            ///< last: starts when everything else is there
};

}  // namespace foresight
