#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "hardware/api/head_link.h"
#include "hardware/api/sensor_head.h"
#include "hardware/link/client/burst_client.h"
#include "hardware/link/client/command_sender.h"
#include "hardware/link/client/head_mirror.h"
#include "hardware/link/client/look_client.h"
#include "hardware/link/client/remote_stand.h"
#include "hardware/link/client/scan_fetcher.h"
#include "hardware/link/client/stop_sender.h"
#include "hardware/link/client/stops_client.h"
#include "hardware/link/client/watch_client.h"

namespace foresight {

/// A head at the far end of a link (ADR 0015). What it shows is what the head said last; Health()
/// has how old that is. Calls that make the head act return at once, and show in Status(); but
/// SetRig waits for the head's answer, so a window calls it from a task.
class RemoteHead final : public SensorHead, public HeadLink {
 public:
  struct Options {
    std::string address;                   ///< for messages
    double status_rate_hz = 10.0;          ///< of a head that moves; 1 suits a thin path
    bool thin = false;                     ///< the path is known to carry some kilobits a second
    bool looks_on = false;                 ///< leaves control to whoever has it, or nobody
    double command_good_s = 8.0;           ///< what the head did not get by then is void
    std::filesystem::path spool;           ///< folder for what has come of scans that are not whole
    std::shared_ptr<ScanArchive> archive;  ///< may be null: sinks are all there is
    std::optional<BurstClient::Options> burst;  ///< a one-way path from the head, beside the link
  };

  /// Identifies both sides to each other and fetches its rig. Fails with kDevice where nobody
  /// answers in time, kState where the head speaks another version of the protocol.
  static Result<std::shared_ptr<RemoteHead>> Connect(std::vector<ChannelMaker> channels,
                                                     const Options& options,
                                                     std::chrono::milliseconds timeout);
  ~RemoteHead() override;

  std::string Describe() const override;
  HeadStatus Status() const override;
  SensorRig Rig() const override;
  foresight::Status SetRig(const SensorRig& rig) override;
  HeadLink* Link() override { return this; }
  HeadMotion Motion() const override;
  foresight::Status Home() override;
  foresight::Status StartScan(const ScanPlan& plan, std::shared_ptr<ScanSink> sink) override;
  foresight::Status StartStops(const StopPlan& plan, std::shared_ptr<StopSink> sink) override;
  foresight::Status StartLiveView(const LiveViewOptions& options,
                                  std::shared_ptr<LiveViewSink> sink) override;
  void StopLiveView() override;
  void EndScan(const std::string& reason) override;
  void StopMotor() override;
  void OperatorSeen() override;

  LinkHealth Health() const override;
  std::vector<LinkedScan> Scans() const override { return fetcher_->Scans(); }
  std::shared_ptr<const EarlyScan> Early() const override { return fetcher_->Early(); }
  void Fetch(const std::string& scan_id) override { fetcher_->Fetch(scan_id); }
  void FetchFirst(const std::string& scan_id) override { fetcher_->FetchFirst(scan_id); }
  void LinesFirst(std::optional<std::pair<std::int64_t, std::int64_t>> seqs) override {
    fetcher_->LinesFirst(seqs);
  }
  void Pause(const std::string& scan_id) override { fetcher_->Pause(scan_id); }
  std::shared_ptr<MovingStand> Stand() const override { return stand_; }
  bool MayOperate() const override { return session_.HeadIdentity().may_operate(); }
  foresight::Status TakeControl() override;
  foresight::Status GiveControl(const std::string& successor) override;
  Result<RobotAnswer> SendPose(const std::string& pose_json) override;
  Result<HeadFit> Fit(const HeadFitOrder& order, const RunContext& context) override;
  Result<HeadImage> FetchImage(const HeadImageOrder& order) override;

  bool Simulated() const { return session_.HeadIdentity().simulated(); }

 private:
  RemoteHead(std::vector<ChannelMaker> channels, const Options& options);
  foresight::Status FetchRig();
  foresight::Status FetchStand();
  foresight::Status MayAct(const char* what) const;
  void OnScanEndAnswer(int asked, const CommandEnd& end);
  void OnBegin();
  void OnEvent(const link::Event& event);

  const Options options_;
  mutable LinkSession session_;
  HeadMirror mirror_;
  mutable std::mutex mutex_;  ///< guards what follows
  SensorRig rig_;
  std::string rig_yaml_;
  std::string rig_id_;
  HeadMotion motion_;
  std::string boot_id_;
  int ends_asked_ = 0;  ///< of scans
  StopAnswer end_scan_ = StopAnswer::kNone;
  std::string end_scan_refusal_;
  std::shared_ptr<StopsClient> stops_;
  std::unique_ptr<LookClient> look_;
  std::unique_ptr<BurstClient> burst_;
  // Last: their threads use what is above.
  std::unique_ptr<ScanFetcher> fetcher_;
  std::unique_ptr<StopSender> stopper_;
  std::unique_ptr<CommandSender> commands_;
  std::shared_ptr<RemoteStand> stand_;  ///< as it was when the link began; null = it is carried
  std::unique_ptr<WatchClient> watch_;
};

}  // namespace foresight
