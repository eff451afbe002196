#include "hardware/link/chunks/scan_builder.h"
#include "hardware/link/chunks/enlarged_frame.h"

#include <algorithm>

#include "core/base/crc32c.h"
#include "core/base/sha256.h"
#include "core/sensor/rig_id.h"
#include "hardware/link/chunks/health_item.h"
#include "hardware/link/chunks/scan_digest.h"
#include "hardware/link/chunks/text_item.h"
#include "hardware/link/chunks/track_block.h"

namespace foresight {
namespace {

/// Of a scan in memory: 40 times a room scan with 12 images. A head that sends more is out of
/// order.
constexpr std::size_t kMostScanBytes = std::size_t{2} << 30;
constexpr std::size_t kMostOpenBytes = std::size_t{512} << 20;
constexpr std::size_t kOverheadBytes = 256;  ///< of a value in a map
constexpr std::int64_t kMostCloudPoints = 20'000'000;

bool IsSingle(ChunkKind kind) {
  return kind == ChunkKind::kHeader || kind == ChunkKind::kRig ||
         kind == ChunkKind::kDeviceHealth || kind == ChunkKind::kEnd;
}

/// Whether blocks 0 to size - 1 are there and no others.
template <class Blocks>
bool HasNoGap(const Blocks& blocks) {
  return blocks.empty() || blocks.rbegin()->first == static_cast<std::int64_t>(blocks.size()) - 1;
}

}  // namespace

const CameraFrame* ScanBuilder::Image(std::int64_t position) const {
  const auto frame = frames_.find(position);
  return frame == frames_.end() ? nullptr : frame->second.get();
}

const FrameItem* ScanBuilder::Find(const FrameItems& items, std::int64_t position) {
  const auto item = items.find(position);
  return item == items.end() ? nullptr : &item->second;
}

Result<ScanBuilder::Taken> ScanBuilder::Take(const Chunk& chunk) {
  FORESIGHT_CHECK(CheckChunk(chunk));
  const ItemId id = chunk.id.Item();
  if (IsSingle(id.kind) && id.item != 0)
    return Fail(ErrorCode::kBadData, "{}: a scan has only one", Describe(chunk));
  if (have_.HasPart(chunk.id, chunk.item_crc)) return Taken::kAlreadyHere;
  if (chunk.parts > 1) {
    FORESIGHT_TRY(const bool whole, KeepPart(chunk));
    if (!whole) return Taken::kNew;
  }
  const std::string bytes = chunk.parts > 1 ? JoinedParts(id) : chunk.bytes;
  ForgetParts(id);
  if (Crc32c(bytes) != chunk.item_crc)
    return Fail(ErrorCode::kBadData, "{}: the item's CRC is {:08x} and not {:08x}", Describe(chunk),
                Crc32c(bytes), chunk.item_crc);
  if (const Status taken = TakeItem(id, bytes); !taken)
    return Fail(taken.error().code, "scan {}, {}: {}", scan_id_, Describe(chunk),
                taken.error().message);
  have_.Add(id);
  whole_.reset();
  return Taken::kNew;
}

Result<bool> ScanBuilder::KeepPart(const Chunk& chunk) {
  const ItemId id = chunk.id.Item();
  auto begun = open_.find(id);
  if (begun != open_.end() && begun->second.item_crc != chunk.item_crc) {
    ForgetParts(id);
    begun = open_.end();
  }
  if (begun != open_.end() && begun->second.parts != chunk.parts)
    return Fail(ErrorCode::kBadData, "{}: it had {} parts before", Describe(chunk),
                begun->second.parts);
  if (open_bytes_ + chunk.bytes.size() + kOverheadBytes > kMostOpenBytes)
    return Fail(ErrorCode::kBadData, "{}: more than {} MB of items that are not whole",
                Describe(chunk), kMostOpenBytes >> 20);
  OpenItem& item = open_[id];
  item.item_crc = chunk.item_crc;
  item.parts = chunk.parts;
  item.bytes[chunk.id.part] = chunk.bytes;
  open_bytes_ += chunk.bytes.size() + kOverheadBytes;
  if (item.bytes.size() == static_cast<std::size_t>(item.parts)) return true;
  have_.AddPart(chunk);
  return false;
}

std::string ScanBuilder::JoinedParts(const ItemId& id) const {
  std::string bytes;
  for (const auto& [part, part_bytes] : open_.at(id).bytes) bytes += part_bytes;
  return bytes;
}

void ScanBuilder::ForgetParts(const ItemId& id) {
  have_.ForgetParts(id);
  const auto item = open_.find(id);
  if (item == open_.end()) return;
  for (const auto& [part, bytes] : item->second.bytes) open_bytes_ -= bytes.size() + kOverheadBytes;
  open_.erase(item);
}

Status ScanBuilder::TakeItem(const ItemId& id, const std::string& bytes) {
  switch (id.kind) {
    case ChunkKind::kHeader:
      return TakeHeader(bytes);
    case ChunkKind::kRig: {
      FORESIGHT_TRY(const std::string yaml, DecodeText(bytes, "rig"));
      return TakeRig(yaml);
    }
    case ChunkKind::kTrack:
      return TakeTrack(id.item, bytes);
    case ChunkKind::kThumbnail:
      return TakeFrame(thumbnails_, id.item, bytes);
    case ChunkKind::kPreview:
      return TakeFrame(previews_, id.item, bytes);
    case ChunkKind::kJpeg:
      return TakeFrame(jpegs_, id.item, bytes);
    case ChunkKind::kCoarseCloud:
    case ChunkKind::kFineCloud:
      return TakeCloud(id, bytes);
    case ChunkKind::kRanges:
      return TakeRanges(id.item, bytes);
    case ChunkKind::kIntensities:
      return TakeIntensities(id.item, bytes);
    case ChunkKind::kImage:
      return TakeImage(id.item, bytes);
    case ChunkKind::kDeviceHealth: {
      FORESIGHT_TRY(health_json_, DecodeText(bytes, "device health"));
      return {};
    }
    case ChunkKind::kEnd: {
      FORESIGHT_TRY(end_, DecodeEnd(bytes));
      return {};
    }
  }
  return Fail(ErrorCode::kBadData, "items of kind {} are not known", static_cast<int>(id.kind));
}

Status ScanBuilder::TakeHeader(const std::string& bytes) {
  FORESIGHT_TRY(ScanHeader header, DecodeHeader(bytes));
  if (header.uuid != scan_id_) return Fail(ErrorCode::kBadData, "it is of scan {}", header.uuid);
  if (rig_ && rig_digest_ != header.rig_digest)
    return Fail(ErrorCode::kBadData, "its rig is {}, another one came", header.rig_digest);
  header_ = std::move(header);
  return {};
}

Status ScanBuilder::TakeRig(const std::string& yaml) {
  FORESIGHT_TRY(SensorRig rig, SensorRigFromYaml(yaml, "rig of scan " + scan_id_));
  const std::string digest = Sha256Hex(yaml);
  if (header_ && header_->rig_digest != digest)
    return Fail(ErrorCode::kBadData, "it is {}, the header says {}", digest, header_->rig_digest);
  rig_ = std::move(rig);
  rig_digest_ = digest;
  return {};
}

Status ScanBuilder::UseRig(const std::string& yaml) {
  if (!header_)
    return Fail(ErrorCode::kState, "scan {}: its rig is known when its header is here", scan_id_);
  if (Sha256Hex(yaml) != header_->rig_digest)
    return Fail(ErrorCode::kInvalidInput, "scan {}: its rig has the digest {}, not {}", scan_id_,
                header_->rig_digest, Sha256Hex(yaml));
  FORESIGHT_CHECK(TakeRig(yaml));
  ForgetParts({ChunkKind::kRig, 0});
  have_.Add({ChunkKind::kRig, 0});
  whole_.reset();
  return {};
}

Status ScanBuilder::Count(std::size_t bytes) {
  bytes += kOverheadBytes;
  if (bytes > kMostScanBytes - bytes_)
    return Fail(ErrorCode::kBadData, "a scan of more than {} MB is not taken",
                kMostScanBytes >> 20);
  bytes_ += bytes;
  return {};
}

Status ScanBuilder::TakeTrack(std::int64_t block, const std::string& bytes) {
  FORESIGHT_TRY(std::vector<MotorSample> samples, DecodeTrackBlock(bytes));
  FORESIGHT_CHECK(Count(samples.size() * sizeof(MotorSample)));
  samples_ += samples.size();
  track_[block] = std::move(samples);
  return {};
}

Status ScanBuilder::TakeRanges(std::int64_t block, const std::string& bytes) {
  FORESIGHT_TRY(std::vector<LidarLine> decoded, DecodeRanges(bytes));
  const auto intensities = intensities_.find(block);
  if (intensities != intensities_.end() && intensities->second.size() != decoded.size())
    return Fail(ErrorCode::kBadData, "{} lines, but intensities of {}", decoded.size(),
                intensities->second.size());
  std::size_t values = 0;
  for (const LidarLine& line : decoded) values += line.range_mm.size();
  FORESIGHT_CHECK(Count(2 * values));
  Lines lines;
  for (LidarLine& line : decoded)
    lines.push_back(std::make_shared<const LidarLine>(std::move(line)));
  lines_with_ranges_ += lines.size();
  if (intensities == intensities_.end()) {
    ranges_[block] = std::move(lines);
    return {};
  }
  Join(block, std::move(lines), std::move(intensities->second));
  intensities_.erase(intensities);
  return {};
}

Status ScanBuilder::TakeIntensities(std::int64_t block, const std::string& bytes) {
  FORESIGHT_TRY(IntensityBlock decoded, DecodeIntensities(bytes));
  const auto ranges = ranges_.find(block);
  if (ranges != ranges_.end() && ranges->second.size() != decoded.size())
    return Fail(ErrorCode::kBadData, "{} lines, but ranges of {}", decoded.size(),
                ranges->second.size());
  std::size_t values = 0;
  for (const auto& line : decoded) values += line.size();
  FORESIGHT_CHECK(Count(2 * values));
  if (ranges == ranges_.end()) {
    intensities_[block] = std::move(decoded);
    return {};
  }
  Join(block, std::move(ranges->second), std::move(decoded));
  ranges_.erase(ranges);
  return {};
}

void ScanBuilder::Join(std::int64_t block, Lines ranges, IntensityBlock intensities) {
  Lines& lines = lines_[block];
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (intensities[i].empty()) {
      lines.push_back(std::move(ranges[i]));
      continue;
    }
    LidarLine line = *ranges[i];
    line.intensity = std::move(intensities[i]);
    lines.push_back(std::make_shared<const LidarLine>(std::move(line)));
  }
  complete_lines_ += lines.size();
}

Status ScanBuilder::TakeFrame(FrameItems& items, std::int64_t position, const std::string& bytes) {
  FORESIGHT_TRY(FrameItem item, DecodeFrameJpeg(bytes));
  FORESIGHT_CHECK(Count(item.frame->image.size() * sizeof(Rgb8)));
  items[position] = std::move(item);
  return {};
}

Status ScanBuilder::TakeImage(std::int64_t position, const std::string& bytes) {
  FORESIGHT_TRY(CameraFrame frame, DecodeFrameImage(bytes));
  FORESIGHT_CHECK(Count(frame.image.size() * sizeof(Rgb8)));
  frames_[position] = std::make_shared<const CameraFrame>(std::move(frame));
  jpegs_.erase(position);
  enlarged_.erase(position);
  return {};
}

Status ScanBuilder::TakeCloud(const ItemId& id, const std::string& bytes) {
  const bool coarse = id.kind == ChunkKind::kCoarseCloud;
  const CloudStep& step = coarse ? kCoarseStep : kFineStep;
  FORESIGHT_TRY(CloudBlock block, DecodeCloudBlock(bytes));
  if (block.step != step ||
      block.lines.size() > static_cast<std::size_t>(kLinesPerCloudBlock / step.lines))
    return Fail(ErrorCode::kBadData, "{} lines of steps {} x {}", block.lines.size(),
                block.step.lines, block.step.beams);
  std::size_t values = 0;
  for (const CloudLine& line : block.lines) values += line.range_mm.size();
  FORESIGHT_CHECK(Count(2 * values));
  (coarse ? coarse_ : fine_)[id.item] = std::move(block);
  return {};
}

void ScanBuilder::DeliverTo(ScanSink& sink) {
  if (!header_ || !rig_ || delivered_.ended) return;
  if (!delivered_.started) sink.OnScanStarted(HeaderOnly());
  delivered_.started = true;
  DeliverSamples(sink);
  DeliverLines(sink);
  DeliverFrames(sink);
  DeliverEnd(sink);
}

void ScanBuilder::DeliverSamples(ScanSink& sink) {
  for (;;) {
    const auto block =
        track_.find(static_cast<std::int64_t>(delivered_.samples / kSamplesPerBlock));
    const std::size_t heard = delivered_.samples % kSamplesPerBlock;
    if (block == track_.end() || block->second.size() <= heard) return;
    const std::span<const MotorSample> samples = block->second;
    sink.OnMotorSamples(samples.subspan(heard));
    delivered_.samples += samples.size() - heard;
  }
}

void ScanBuilder::DeliverLines(ScanSink& sink) {
  for (;;) {
    const auto block = lines_.find(static_cast<std::int64_t>(delivered_.lines / kLinesPerBlock));
    const std::size_t heard = delivered_.lines % kLinesPerBlock;
    if (block == lines_.end() || block->second.size() <= heard) return;
    for (std::size_t i = heard; i < block->second.size(); ++i, ++delivered_.lines)
      sink.OnLine(*block->second[i]);
  }
}

void ScanBuilder::DeliverFrames(ScanSink& sink) {
  for (;; ++delivered_.frames) {
    const auto frame = frames_.find(static_cast<std::int64_t>(delivered_.frames));
    if (frame == frames_.end()) return;
    sink.OnFrame(*frame->second);
  }
}

void ScanBuilder::DeliverEnd(ScanSink& sink) {
  if (!Whole()) return;
  if (const auto health = HealthReportFromJson(health_json_, scan_id_))
    sink.OnDeviceHealth(health->at_start, health->at_end);
  sink.OnScanEnded(end_->state, end_->reason);
  delivered_.ended = true;
}

Status ScanBuilder::CheckAllIsHere() const {
  if (!header_ || !rig_ || !end_)
    return Fail(ErrorCode::kState, "scan {}: its {} is missing", scan_id_,
                !header_ ? "header"
                : !rig_  ? "rig"
                         : "end");
  const auto check = [this](const char* what, std::size_t here, std::int64_t all,
                            bool no_gap) -> Status {
    if (static_cast<std::int64_t>(here) < all || !no_gap)
      return Fail(ErrorCode::kState, "scan {}: {} of {} {} are here", scan_id_, here, all, what);
    return {};
  };
  FORESIGHT_CHECK(check("lines", complete_lines_, end_->lines, HasNoGap(lines_)));
  FORESIGHT_CHECK(check("motor samples", samples_, end_->samples, HasNoGap(track_)));
  return check("images", frames_.size(), end_->frames, HasNoGap(frames_));
}

ScanProgress ScanBuilder::Progress() const {
  ScanProgress progress;
  progress.lines = lines_with_ranges_;
  progress.complete_lines = complete_lines_;
  progress.frames = frames_.size();
  if (end_) {
    progress.of_lines = static_cast<std::size_t>(end_->lines);
    progress.of_frames = static_cast<std::size_t>(end_->frames);
  }
  progress.complete = CheckAllIsHere().has_value();
  return progress;
}

Scan ScanBuilder::HeaderOnly() const {
  Scan scan;
  scan.uuid = header_->uuid;
  scan.start_utc_ns = header_->start_utc_ns;
  scan.source = header_->source;
  scan.simulated = header_->simulated;
  scan.plan = header_->plan;
  scan.rig = *rig_;
  return scan;
}

Result<PartialScan> ScanBuilder::Partial() const {
  if (!header_ || !rig_)
    return Fail(ErrorCode::kState, "scan {}: its {} is missing", scan_id_,
                header_ ? "rig" : "header");
  PartialScan partial;
  partial.scan = HeaderOnly();
  partial.progress = Progress();
  if (end_) {
    partial.scan.state = end_->state;
    partial.scan.reason = end_->reason;
  }
  BlocksOfLines lines = ranges_;
  lines.insert(lines_.begin(), lines_.end());
  for (const auto& [block, of_block] : lines)
    for (const auto& line : of_block) partial.scan.lines.push_back(line);
  for (const auto& [block, samples] : track_)
    for (const MotorSample& sample : samples) partial.scan.track.Add(sample);
  AddFrames(partial);
  return partial;
}

/// Made once for each small image: who looks again sees the same one.
std::shared_ptr<const CameraFrame> ScanBuilder::Enlarged(std::int64_t position,
                                                         const FrameItem& item) const {
  auto& [small, enlarged] = enlarged_[position];
  if (small != item.frame) enlarged = EnlargedFrame(item);
  small = item.frame;
  return enlarged;
}

void ScanBuilder::AddFrames(PartialScan& partial) const {
  std::map<std::int64_t, std::shared_ptr<const CameraFrame>> frames = frames_;
  for (const auto& [position, item] : jpegs_)
    frames.emplace(position, item.frame);  // where the lossless one is not here
  for (const FrameItems* small : {&previews_, &thumbnails_})
    for (const auto& [position, item] : *small)
      if (frames.count(position) == 0) frames.emplace(position, Enlarged(position, item));
  for (const auto& [position, frame] : frames) {
    partial.scan.frames.push_back(frame);
    partial.lossless.push_back(frames_.count(position) != 0);
    partial.positions.push_back(position);
  }
}

Result<Scan> ScanBuilder::Whole() const {
  if (whole_) return *whole_;
  FORESIGHT_CHECK(CheckAllIsHere());
  Scan scan = HeaderOnly();
  scan.state = end_->state;
  scan.reason = end_->reason;
  for (const auto& [block, lines] : lines_)
    for (const auto& line : lines) scan.lines.push_back(line);
  for (const auto& [block, samples] : track_)
    for (const MotorSample& sample : samples) scan.track.Add(sample);
  for (const auto& [position, frame] : frames_) scan.frames.push_back(frame);
  const std::string digest = ScanDigest(scan);
  if (digest == end_->digest)
    whole_.emplace(std::move(scan));
  else
    whole_.emplace(Fail(ErrorCode::kBadData,
                        "scan {}: all of it is here, but its digest is {} and the head's {}",
                        scan_id_, digest, end_->digest));
  return *whole_;
}

Result<PlacedCloud> ScanBuilder::Cloud() const {
  if (!rig_) return Fail(ErrorCode::kState, "scan {}: its rig is missing", scan_id_);
  std::map<std::int64_t, const CloudBlock*> blocks;
  for (const auto& [item, block] : coarse_) blocks[item] = &block;
  for (const auto& [item, block] : fine_) blocks[item] = &block;
  std::vector<const CloudBlock*> in_order;
  std::int64_t points = 0;
  for (const auto& [item, block] : blocks) {
    in_order.push_back(block);
    points += static_cast<std::int64_t>(block->lines.size()) * rig_->lidar.beams;
  }
  if (points > kMostCloudPoints)
    return Fail(ErrorCode::kBadData, "scan {}: a cloud of {} points is not shown", scan_id_,
                points);
  PlacedCloud cloud = RegisterCloud(in_order, *rig_);
  if (cloud.seqs.empty())
    return Fail(ErrorCode::kTooFewPoints, "scan {}: no line of a cloud is here", scan_id_);
  return cloud;
}

}  // namespace foresight
