#include "hardware/link/chunks/scan_items.h"

#include <algorithm>

#include "hardware/link/chunks/cloud_items.h"
#include "hardware/link/chunks/end_item.h"
#include "hardware/link/chunks/frame_items.h"
#include "hardware/link/chunks/header_item.h"
#include "hardware/link/chunks/item_bytes.h"
#include "hardware/link/chunks/line_blocks.h"
#include "hardware/link/chunks/scan_digest.h"
#include "hardware/link/chunks/text_item.h"
#include "hardware/link/chunks/track_block.h"

namespace foresight {
namespace {

bool HasEnded(const Scan& scan) {
  return scan.state != ScanState::kRunning;
}

/// Full ones, and the last one once nothing comes behind it.
std::int64_t Blocks(std::size_t values, int per_block, bool ended) {
  const auto count = static_cast<std::int64_t>(values);
  return (count + (ended ? per_block - 1 : 0)) / per_block;
}

std::vector<const LidarLine*> LinesOf(const Scan& scan, std::int64_t block) {
  const auto begin = static_cast<std::size_t>(block * kLinesPerBlock);
  const std::size_t end = std::min(begin + kLinesPerBlock, scan.lines.size());
  std::vector<const LidarLine*> lines;
  for (std::size_t i = begin; i < end; ++i) lines.push_back(&scan.lines[i]);
  return lines;
}

std::span<const MotorSample> SamplesOf(const Scan& scan, std::int64_t block) {
  const auto samples = scan.track.samples();
  const auto begin = static_cast<std::size_t>(block * kSamplesPerBlock);
  return samples.subspan(begin, std::min<std::size_t>(kSamplesPerBlock, samples.size() - begin));
}

ScanEnd EndOf(const ScanToSend& source) {
  const Scan& scan = source.scan;
  ScanEnd end;
  end.state = scan.state;
  end.reason = scan.reason;
  end.lines = static_cast<std::int64_t>(scan.lines.size());
  end.samples = static_cast<std::int64_t>(scan.track.samples().size());
  end.frames = static_cast<std::int64_t>(scan.frames.size());
  end.has_health = !source.health_json.empty();
  end.digest = ScanDigest(scan);
  return end;
}

}  // namespace

ItemCounts ItemsOf(const ScanToSend& source) {
  const Scan& scan = source.scan;
  const bool ended = HasEnded(scan);
  const auto frames = static_cast<std::int64_t>(scan.frames.size());
  ItemCounts counts;
  counts[ChunkKind::kHeader] = 1;
  counts[ChunkKind::kRig] = 1;
  counts[ChunkKind::kTrack] = Blocks(scan.track.samples().size(), kSamplesPerBlock, ended);
  counts[ChunkKind::kRanges] = Blocks(scan.lines.size(), kLinesPerBlock, ended);
  counts[ChunkKind::kIntensities] = counts[ChunkKind::kRanges];
  counts[ChunkKind::kCoarseCloud] = CloudBlocksOf(scan, kCoarseStep);
  counts[ChunkKind::kFineCloud] = CloudBlocksOf(scan, kFineStep);
  for (const ChunkKind kind :
       {ChunkKind::kThumbnail, ChunkKind::kPreview, ChunkKind::kJpeg, ChunkKind::kImage})
    counts[kind] = frames;
  counts[ChunkKind::kDeviceHealth] = ended && !source.health_json.empty() ? 1 : 0;
  counts[ChunkKind::kEnd] = ended ? 1 : 0;
  return counts;
}

Result<std::string> EncodeItem(const ScanToSend& source, const ItemId& id) {
  const Scan& scan = source.scan;
  if (id.item < 0 || id.item >= ItemsOf(source)[id.kind])
    return Fail(ErrorCode::kState, "scan {} has no {} {} now", scan.uuid, ToString(id.kind),
                id.item);
  const auto frame = [&]() -> const CameraFrame& {
    return scan.frames[static_cast<std::size_t>(id.item)];
  };
  switch (id.kind) {
    case ChunkKind::kHeader:
      return EncodeHeader(scan);
    case ChunkKind::kRig:
      return EncodeText(SensorRigToYaml(scan.rig));
    case ChunkKind::kTrack:
      return EncodeTrackBlock(SamplesOf(scan, id.item));
    case ChunkKind::kThumbnail:
      return EncodeFrameJpeg(frame(), kThumbnailSide_px, kSmallQuality);
    case ChunkKind::kCoarseCloud:
      return EncodeCloudBlock(scan, id.item, kCoarseStep);
    case ChunkKind::kPreview:
      return EncodeFrameJpeg(frame(), kPreviewSide_px, kSmallQuality);
    case ChunkKind::kRanges:
      return EncodeRanges(LinesOf(scan, id.item));
    case ChunkKind::kJpeg:
      return EncodeFrameJpeg(frame(), 0, kFullQuality);
    case ChunkKind::kIntensities:
      return EncodeIntensities(LinesOf(scan, id.item));
    case ChunkKind::kImage:
      return EncodeFrameImage(frame());
    case ChunkKind::kDeviceHealth:
      return EncodeText(source.health_json);
    case ChunkKind::kEnd:
      return EncodeEnd(EndOf(source));
    case ChunkKind::kFineCloud:
      return EncodeCloudBlock(scan, id.item, kFineStep);
  }
  return Fail(ErrorCode::kState, "items of kind {} are not known", static_cast<int>(id.kind));
}

std::int64_t ExpectedBytes(const ScanToSend& source, const ItemId& id) {
  // Of a room scan with the usual camera; who asks wants to know how long it may take.
  const Scan& scan = source.scan;
  const auto pixels = [&]() -> std::int64_t {
    const auto at = static_cast<std::size_t>(id.item);
    return at < scan.frames.size() ? static_cast<std::int64_t>(scan.frames[at].image.size()) : 0;
  };
  const auto values = [&](auto member) {
    std::int64_t count = 0;
    for (const LidarLine* line : LinesOf(scan, id.item))
      count += static_cast<std::int64_t>((line->*member).size());
    return count;
  };
  switch (id.kind) {
    case ChunkKind::kHeader:
      return 500;
    case ChunkKind::kRig:
      return 700;
    case ChunkKind::kTrack:
      return 500;
    case ChunkKind::kThumbnail:
      return 2'000;
    case ChunkKind::kCoarseCloud:
      return 350;
    case ChunkKind::kPreview:
      return 6'000;
    case ChunkKind::kRanges:
      return values(&LidarLine::range_mm) * 17 / 25;
    case ChunkKind::kJpeg:
      return pixels() / 7;
    case ChunkKind::kIntensities:
      return values(&LidarLine::intensity) * 21 / 20;
    case ChunkKind::kImage:
      return pixels() * 2 / 5;
    case ChunkKind::kDeviceHealth:
      return 600;
    case ChunkKind::kEnd:
      return 120;
    case ChunkKind::kFineCloud:
      return 4'000;
  }
  return 0;
}

}  // namespace foresight
