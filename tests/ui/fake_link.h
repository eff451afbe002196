#pragma once

#include <mutex>

#include "hardware/api/head_link.h"

namespace foresight {

/// A link that shows what a test says and notes what it is asked. Safe from any thread.
class FakeLink final : public HeadLink {
 public:
  LinkHealth Health() const override {
    const std::lock_guard lock(mutex);
    return health;
  }
  std::vector<LinkedScan> Scans() const override {
    const std::lock_guard lock(mutex);
    return scans;
  }
  std::shared_ptr<const EarlyScan> Early() const override {
    const std::lock_guard lock(mutex);
    return early;
  }
  void Fetch(const std::string& scan_id) override { Note("fetch " + scan_id); }
  void FetchFirst(const std::string& scan_id) override { Note("first " + scan_id); }
  void LinesFirst(std::optional<std::pair<std::int64_t, std::int64_t>> seqs) override {
    Note(seqs ? "lines " + std::to_string(seqs->first) + " " + std::to_string(seqs->second)
              : "lines in any order");
  }
  void Pause(const std::string& scan_id) override { Note("pause " + scan_id); }
  bool MayOperate() const override { return may_operate; }
  Status TakeControl() override {
    Note("take");
    return control;
  }
  Status GiveControl(const std::string& successor) override {
    Note("give " + successor);
    return control;
  }
  Result<RobotAnswer> SendPose(const std::string& pose_json) override {
    Note("pose " + pose_json);
    const std::lock_guard lock(mutex);
    return answer;
  }
  Result<HeadFit> Fit(const HeadFitOrder& order, const RunContext& /*context*/) override {
    Note("fit " + order.scan_id);
    const std::lock_guard lock(mutex);
    fit_order = order;
    return fit;
  }
  Result<HeadImage> FetchImage(const HeadImageOrder& order) override {
    Note("image " + order.scan_id);
    return Fail(ErrorCode::kState, "no image");
  }
  std::vector<std::string> Asked() const {
    const std::lock_guard lock(mutex);
    return asked;
  }

  mutable std::mutex mutex;  ///< guards what follows
  LinkHealth health;
  std::vector<LinkedScan> scans;
  std::shared_ptr<const EarlyScan> early;
  bool may_operate = true;
  Status control;
  HeadFitOrder fit_order;
  Result<HeadFit> fit = Fail(ErrorCode::kState, "no fit");
  Result<RobotAnswer> answer = RobotAnswer{RobotAnswer::Kind::kAccepted, ""};

 private:
  void Note(const std::string& what) {
    const std::lock_guard lock(mutex);
    asked.push_back(what);
  }
  std::vector<std::string> asked;
};

}  // namespace foresight
