#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/registration/register_scan.h"
#include "core/sensor/scan.h"
#include "hardware/api/sensor_head.h"
#include "hardware/link/chunks/chunk_set.h"
#include "hardware/link/chunks/cloud_items.h"
#include "hardware/link/chunks/end_item.h"
#include "hardware/link/chunks/frame_items.h"
#include "hardware/link/chunks/header_item.h"
#include "hardware/link/chunks/line_blocks.h"

namespace foresight {

/// What a sink has heard of a scan.
struct Delivered {
  bool started = false;
  std::size_t lines = 0;
  std::size_t samples = 0;
  std::size_t frames = 0;
  bool ended = false;
  bool operator==(const Delivered&) const = default;
};

/// How much of a scan has arrived. "of" is nullopt until the end is here.
struct ScanProgress {
  std::size_t lines = 0;           ///< with ranges
  std::size_t complete_lines = 0;  ///< with ranges and intensities
  std::optional<std::size_t> of_lines;
  std::size_t frames = 0;  ///< lossless
  std::optional<std::size_t> of_frames;
  bool complete = false;  ///< everything that the digest covers is here
};

/// The part of a scan that is there.
struct PartialScan {
  /// Lines in order, with gaps (jumps of seq), and without intensities where those have not come;
  /// motor samples with gaps; frames as JPEG has them where the lossless image has not come, and
  /// enlarged previews or thumbnails where that has not either.
  /// `state` is kRunning until the end is here. A later one may have more in the middle, which
  /// GrowingRegistration would not notice: it is to be registered as a whole.
  Scan scan;
  std::vector<bool> lossless;           ///< one a frame of `scan`
  std::vector<std::int64_t> positions;  ///< of the frames in the whole scan
  ScanProgress progress;
};

/// The station's side: makes a scan of chunks that come in any order. Not for several threads at a
/// time. Memory is that of the scan, and of the parts of items that are not whole.
class ScanBuilder {
 public:
  enum class Taken { kNew, kAlreadyHere };

  explicit ScanBuilder(std::string scan_id) : scan_id_(std::move(scan_id)) {}

  /// Takes a chunk. A damaged one, and one that contradicts what is here, fails with kBadData and
  /// changes nothing but this: where the last part makes an item whole that cannot be read, all its
  /// parts are forgotten, so that they come again. Parts of an item that was made anew replace
  /// those of the older one.
  Result<Taken> Take(const Chunk& chunk);
  const ChunkSet& Have() const { return have_; }
  const std::string& scan_id() const { return scan_id_; }

  /// Has the digest of the rig's YAML: a station that keeps rigs by it needs not fetch this one.
  const std::optional<ScanHeader>& header() const { return header_; }
  /// A rig that the station knows. Fails with kInvalidInput where it is not the one of the header,
  /// kState before that is here.
  Status UseRig(const std::string& yaml);

  /// Tells the sink what has become deliverable in scan order since the last call: OnScanStarted,
  /// motor samples, lines with ranges and intensities, frames, and at the end device health and
  /// OnScanEnded. The end is told once Whole() gives the scan.
  void DeliverTo(ScanSink& sink);
  const Delivered& delivered() const { return delivered_; }
  /// After a restart: what the sink's mission has already.
  void SetDelivered(const Delivered& delivered) { delivered_ = delivered; }

  ScanProgress Progress() const;
  /// Fails with kState before header and rig are here.
  Result<PartialScan> Partial() const;
  /// Everything; fails with kState while something is missing, with kBadData where the digest is
  /// another than the head's. The first call once all is here reads the whole scan (0.1 s).
  Result<Scan> Whole() const;

  /// The lines of coarse and fine clouds in scan order.
  /// Fails with kState before the rig is here, kTooFewPoints while there is no line.
  Result<PlacedCloud> Cloud() const;
  /// Images of a frame, smaller or with loss; nullptr = not here. Positions count from 0.
  const FrameItem* Thumbnail(std::int64_t position) const { return Find(thumbnails_, position); }
  const FrameItem* Preview(std::int64_t position) const { return Find(previews_, position); }
  const FrameItem* Jpeg(std::int64_t position) const { return Find(jpegs_, position); }
  /// The lossless one; the JPEG is forgotten when it comes.
  const CameraFrame* Image(std::int64_t position) const;
  /// Empty before it is here.
  const std::string& health_json() const { return health_json_; }
  const std::optional<ScanEnd>& end() const { return end_; }

 private:
  using FrameItems = std::map<std::int64_t, FrameItem>;
  using Lines = std::vector<std::shared_ptr<const LidarLine>>;
  using BlocksOfLines = std::map<std::int64_t, Lines>;
  struct OpenItem {
    std::uint32_t item_crc = 0;
    std::int32_t parts = 0;
    std::map<std::int32_t, std::string> bytes;
  };

  static const FrameItem* Find(const FrameItems& items, std::int64_t position);

  /// Whether all parts of the item are here now.
  Result<bool> KeepPart(const Chunk& chunk);
  std::string JoinedParts(const ItemId& id) const;
  void ForgetParts(const ItemId& id);
  Status TakeItem(const ItemId& id, const std::string& bytes);
  Status TakeHeader(const std::string& bytes);
  Status TakeRig(const std::string& yaml);
  Status TakeTrack(std::int64_t block, const std::string& bytes);
  Status TakeRanges(std::int64_t block, const std::string& bytes);
  Status TakeIntensities(std::int64_t block, const std::string& bytes);
  Status TakeFrame(FrameItems& items, std::int64_t position, const std::string& bytes);
  Status TakeImage(std::int64_t position, const std::string& bytes);
  Status TakeCloud(const ItemId& id, const std::string& bytes);
  /// Adds to what the scan takes in memory; fails beyond kMostScanBytes.
  Status Count(std::size_t bytes);
  void Join(std::int64_t block, Lines ranges, IntensityBlock intensities);

  void DeliverSamples(ScanSink& sink);
  void DeliverLines(ScanSink& sink);
  void DeliverFrames(ScanSink& sink);
  void DeliverEnd(ScanSink& sink);

  Status CheckAllIsHere() const;
  Scan HeaderOnly() const;
  void AddFrames(PartialScan& partial) const;
  std::shared_ptr<const CameraFrame> Enlarged(std::int64_t position, const FrameItem& item) const;

  std::string scan_id_;
  ChunkSet have_;
  std::map<ItemId, OpenItem> open_;  ///< of which some parts are here
  std::size_t open_bytes_ = 0;
  std::size_t bytes_ = 0;  ///< of what was decoded
  std::optional<ScanHeader> header_;
  std::optional<SensorRig> rig_;
  std::string rig_digest_;
  std::optional<ScanEnd> end_;
  std::string health_json_;
  std::map<std::int64_t, std::vector<MotorSample>> track_;
  std::size_t samples_ = 0;
  BlocksOfLines ranges_;                                ///< whose intensities are not here
  std::map<std::int64_t, IntensityBlock> intensities_;  ///< whose ranges are not here
  BlocksOfLines lines_;                                 ///< complete
  std::size_t lines_with_ranges_ = 0;
  std::size_t complete_lines_ = 0;
  std::map<std::int64_t, std::shared_ptr<const CameraFrame>> frames_;
  FrameItems thumbnails_, previews_, jpegs_;
  using Frame = std::shared_ptr<const CameraFrame>;
  mutable std::map<std::int64_t, std::pair<Frame, Frame>> enlarged_;  ///< small and enlarged
  std::map<std::int64_t, CloudBlock> coarse_, fine_;
  Delivered delivered_;
  mutable std::optional<Result<Scan>> whole_;
};

}  // namespace foresight
