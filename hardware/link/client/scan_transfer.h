#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hardware/link/chunks/scan_builder.h"
#include "hardware/link/chunks/spool_file.h"

namespace foresight {

/// One scan on its way to this station: what has come is in its spool, and becomes the scan. Not
/// for several threads at a time.
class ScanTransfer {
 public:
  /// With what an earlier run kept. `rig_yaml` is a rig that is probably the scan's; empty = none.
  static Result<std::unique_ptr<ScanTransfer>> Open(const std::filesystem::path& spool,
                                                    const std::string& scan_id,
                                                    const std::string& rig_yaml);

  /// Leaves damaged chunks out, and has the others on the disk when it returns: the head may forget
  /// them. They wait until they are taken in, which may mean to decode an image. Fails with kIo
  /// where the disk does not take them: none is acknowledged then.
  Result<std::vector<ChunkId>> Keep(std::vector<Chunk> chunks);
  /// Bytes of the chunks that were kept and are not part of the scan yet.
  std::int64_t WaitingBytes() const { return waiting_bytes_; }
  bool Waiting() const { return !waiting_.empty(); }
  /// Of what is taken in next. @pre Waiting()
  ChunkKind NextKind() const { return waiting_.front().id.kind; }
  /// Makes the chunk that has waited longest part of the scan; false where it could not be read,
  /// and has to come again. @pre Waiting()
  bool TakeInNext();

  /// What the head need not send: what is here, and the rig where we hope to know it.
  ChunkSet Have() const;
  /// The scan has another rig than was hoped: Have() changed, and a stream that began before that
  /// leaves the rig out.
  bool MistakenRig() const { return mistaken_rig_; }
  bool TakeMistakenRig() { return std::exchange(mistaken_rig_, false); }

  ScanBuilder& builder() { return builder_; }
  /// Bytes that came since the program started.
  std::int64_t TakenBytes() const { return taken_bytes_; }
  /// The whole scan is kept elsewhere.
  Status Remove() { return spool_->Remove(); }

 private:
  ScanTransfer(const std::string& scan_id, std::string rig_yaml)
      : builder_(scan_id), rig_yaml_(std::move(rig_yaml)) {}
  void TryRig();

  ScanBuilder builder_;
  std::unique_ptr<SpoolFile> spool_;
  std::string rig_yaml_;
  bool mistaken_rig_ = false;
  bool coarse_ = false;  ///< some of the coarse cloud is here
  std::deque<Chunk> waiting_;
  std::int64_t waiting_bytes_ = 0;
  std::int64_t taken_bytes_ = 0;
};

}  // namespace foresight
