// The link's codecs on a scan of the room, one thread: raw bytes a second, and the ratio of what
// travels to them.
#include <benchmark/benchmark.h>

#include <stdexcept>

#include "core/geometry/angles.h"
#include "core/io/png.h"
#include "core/simulation/scene.h"
#include "core/simulation/simulate_scan.h"
#include "hardware/link/chunks/frame_items.h"
#include "hardware/link/chunks/line_blocks.h"
#include "hardware/link/chunks/scan_digest.h"
#include "hardware/link/chunks/scan_items.h"

namespace foresight {
namespace {

const ScanToSend& Room() {
  static const ScanToSend kRoom = [] {
    auto scene = LoadScene(FORESIGHT_SOURCE_DIR "/resources/scenes/room.yaml");
    if (!scene) throw std::runtime_error(scene.error().message);
    const World world(std::make_shared<const Scene>(std::move(*scene)), DefaultSensorRig(), {});
    ScanPlan plan;
    plan.from_rad = RadiansFromDegrees(-30.0);
    plan.to_rad = RadiansFromDegrees(80.0);
    plan.speed_rad_s = RadiansFromDegrees(10.0);
    plan.image_angles_rad = {0.0};
    auto scan = SimulateScan(world, plan, {});
    if (!scan) throw std::runtime_error(scan.error().message);
    return ScanToSend{std::move(*scan), ""};
  }();
  return kRoom;
}

std::int64_t RawBytesOf(ChunkKind kind) {
  const Scan& scan = Room().scan;
  switch (kind) {
    case ChunkKind::kRanges:
    case ChunkKind::kIntensities:
      return static_cast<std::int64_t>(2 * 1081 * scan.lines.size());
    case ChunkKind::kTrack:
      return static_cast<std::int64_t>(scan.track.samples().size_bytes());
    default:
      return static_cast<std::int64_t>(3 * scan.frames[0].image.size());
  }
}

void Encode(benchmark::State& state, ChunkKind kind) {
  const std::int64_t items = ItemsOf(Room())[kind];
  std::int64_t bytes = 0;
  for (auto _ : state) {
    bytes = 0;
    for (std::int64_t item = 0; item < items; ++item)
      bytes += static_cast<std::int64_t>(EncodeItem(Room(), {kind, item})->size());
    benchmark::DoNotOptimize(bytes);
  }
  state.SetBytesProcessed(state.iterations() * RawBytesOf(kind));
  state.counters["ratio"] = static_cast<double>(bytes) / static_cast<double>(RawBytesOf(kind));
  state.counters["bytes"] = static_cast<double>(bytes);
  state.counters["bytes_an_item"] = static_cast<double>(bytes) / static_cast<double>(items);
}

template <class Decoder>
void Decode(benchmark::State& state, ChunkKind kind, const Decoder& decode) {
  std::vector<std::string> items;
  for (std::int64_t item = 0; item < ItemsOf(Room())[kind]; ++item)
    items.push_back(EncodeItem(Room(), {kind, item}).value());
  for (auto _ : state)
    for (const std::string& item : items) benchmark::DoNotOptimize(decode(item));
  state.SetBytesProcessed(state.iterations() * RawBytesOf(kind));
}

void Digest(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(ScanDigest(Room().scan));
  state.SetBytesProcessed(state.iterations() *
                          (2 * RawBytesOf(ChunkKind::kRanges) + RawBytesOf(ChunkKind::kImage)));
}

void EncodeAsPng(benchmark::State& state) {
  const ColorImage& image = Room().scan.frames[0].image;
  std::size_t bytes = 0;
  for (auto _ : state) bytes = EncodePng(image, PngContent::kCapture)->size();
  state.SetBytesProcessed(state.iterations() * RawBytesOf(ChunkKind::kImage));
  state.counters["bytes"] = static_cast<double>(bytes);
}

BENCHMARK_CAPTURE(Encode, ranges, ChunkKind::kRanges)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Encode, intensities, ChunkKind::kIntensities)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Encode, track, ChunkKind::kTrack)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Encode, image, ChunkKind::kImage)->Unit(benchmark::kMillisecond);
BENCHMARK(EncodeAsPng)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Encode, jpeg, ChunkKind::kJpeg)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Encode, preview, ChunkKind::kPreview)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Encode, thumbnail, ChunkKind::kThumbnail)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Encode, coarse_cloud, ChunkKind::kCoarseCloud)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Encode, fine_cloud, ChunkKind::kFineCloud)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Encode, header, ChunkKind::kHeader)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Encode, rig, ChunkKind::kRig)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Encode, end, ChunkKind::kEnd)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Decode, ranges, ChunkKind::kRanges, DecodeRanges)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Decode, intensities, ChunkKind::kIntensities, DecodeIntensities)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Decode, image, ChunkKind::kImage, DecodeFrameImage)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(Digest)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace foresight
