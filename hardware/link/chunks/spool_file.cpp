#include "hardware/link/chunks/spool_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

#include "core/base/atomic_file.h"
#include "core/base/crc32c.h"
#include "hardware/link/chunks/item_bytes.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "foresight spool 1\n";
constexpr std::size_t kMostIdBytes = 100;
constexpr const char* kExtension = ".spool";
constexpr std::size_t kRecordHead = 8;  ///< length and CRC of what follows
constexpr std::size_t kMostRecordBytes = kRecordHead + kMaxPartBytes + 64;
constexpr std::size_t kReadBytes = std::size_t{1} << 20;

std::string FileHead(const std::string& scan_id) {
  const std::string head = ItemWriter().Raw(kMagic).Text(scan_id).Take();
  return ItemWriter().Raw(head).U32(Crc32c(head)).Take();
}

std::string RecordOf(const Chunk& chunk) {
  const std::string body = ItemWriter()
                               .U8(static_cast<std::uint8_t>(chunk.id.kind))
                               .Varint(static_cast<std::uint64_t>(chunk.id.item))
                               .Varint(static_cast<std::uint64_t>(chunk.id.part))
                               .Varint(static_cast<std::uint64_t>(chunk.parts))
                               .U32(chunk.item_crc)
                               .U32(chunk.crc)
                               .Raw(chunk.bytes)
                               .Take();
  return ItemWriter()
      .U32(static_cast<std::uint32_t>(body.size()))
      .U32(Crc32c(body))
      .Raw(body)
      .Take();
}

/// nullopt where the body is not of a whole chunk.
std::optional<Chunk> ChunkOf(std::string_view body) {
  ItemReader reader(body);
  Chunk chunk;
  chunk.id.kind = static_cast<ChunkKind>(reader.U8());
  chunk.id.item = static_cast<std::int64_t>(reader.Count(kMaxItems - 1));
  chunk.id.part = static_cast<std::int32_t>(reader.Count(kMaxParts - 1));
  chunk.parts = static_cast<std::int32_t>(reader.Count(kMaxParts));
  chunk.item_crc = reader.U32();
  chunk.crc = reader.U32();
  if (!reader.ok()) return std::nullopt;
  chunk.bytes = reader.Raw(reader.left());
  if (!CheckChunk(chunk)) return std::nullopt;
  return chunk;
}

Status CheckId(const std::string& scan_id) {
  const auto plain = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-';
  };
  if (scan_id.empty() || scan_id.size() > kMostIdBytes ||
      !std::all_of(scan_id.begin(), scan_id.end(), plain))
    return Fail(ErrorCode::kInvalidInput,
                "scan id of {} bytes cannot name a spool: letters, digits and '-', at most {}",
                scan_id.size(), kMostIdBytes);
  return {};
}

tl::unexpected<Error> Failed(const fs::path& path, const char* what) {
  return Fail(ErrorCode::kIo, "{}: {}: {}", path.string(), what, std::strerror(errno));
}

Status WriteAt(int descriptor, std::int64_t at, std::string_view bytes, const fs::path& path) {
  while (!bytes.empty()) {
    const ssize_t written = pwrite(descriptor, bytes.data(), bytes.size(), at);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return Failed(path, "cannot write");
    bytes.remove_prefix(static_cast<std::size_t>(written));
    at += written;
  }
  return {};
}

/// At most `most` bytes; fewer at the end of the file.
Result<std::string> ReadAt(int descriptor, std::int64_t at, std::size_t most,
                           const fs::path& path) {
  std::string bytes(most, '\0');
  std::size_t count = 0;
  while (count < most) {
    const ssize_t got = pread(descriptor, bytes.data() + count, most - count,
                              at + static_cast<std::int64_t>(count));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return Failed(path, "cannot read");
    if (got == 0) break;
    count += static_cast<std::size_t>(got);
  }
  bytes.resize(count);
  return bytes;
}

/// The id that a spool's head names; nullopt where it is none.
std::optional<std::string> ScanIdOf(std::string_view head) {
  ItemReader reader(head);
  if (reader.Raw(kMagic.size()) != kMagic) return std::nullopt;
  const std::string scan_id(reader.Text());
  if (!reader.ok() || !head.starts_with(FileHead(scan_id))) return std::nullopt;
  return scan_id;
}

}  // namespace

std::size_t ReadSpoolRecords(std::string_view bytes,
                             const std::function<void(const Chunk&)>& read) {
  std::size_t clean = 0;
  for (;;) {
    ItemReader reader(bytes.substr(clean));
    const std::size_t size = reader.U32();
    const std::uint32_t crc = reader.U32();
    const std::string_view body = reader.Raw(size);
    if (!reader.ok() || size > kMostRecordBytes || Crc32c(body) != crc) return clean;
    const std::optional<Chunk> chunk = ChunkOf(body);
    if (!chunk) return clean;
    read(*chunk);
    clean += kRecordHead + size;
  }
}

Result<std::unique_ptr<SpoolFile>> SpoolFile::Open(const fs::path& folder,
                                                   const std::string& scan_id,
                                                   const std::function<void(const Chunk&)>& read) {
  FORESIGHT_CHECK(CheckId(scan_id));
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Fail(ErrorCode::kIo, "{}: {}", folder.string(), error.message());
  const fs::path path = folder / (scan_id + kExtension);
  const int descriptor =
      open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0644);
  if (descriptor < 0) return Failed(path, "cannot open");
  std::unique_ptr<SpoolFile> spool(new SpoolFile(path, descriptor));
  struct stat status = {};
  if (fstat(descriptor, &status) != 0) return Failed(path, "cannot open");
  if (!S_ISREG(status.st_mode))
    return Fail(ErrorCode::kIo, "{}: it is no regular file", path.string());
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0)
    return Fail(ErrorCode::kIo, "{}: another program has it open", path.string());
  try {
    FORESIGHT_CHECK(spool->ReadAll(scan_id, read));
  } catch (const std::exception& thrown) {
    return Fail(ErrorCode::kIo, "{}: {}", path.string(), thrown.what());
  }
  return spool;
}

SpoolFile::~SpoolFile() {
  close(descriptor_);
}

Status SpoolFile::Begin(const std::string& scan_id) {
  const std::string head = FileHead(scan_id);
  FORESIGHT_CHECK(WriteAt(descriptor_, 0, head, path_));
  if (fsync(descriptor_) != 0) return Failed(path_, "cannot synchronise");
  size_ = static_cast<std::int64_t>(head.size());
  return SyncFolderOf(path_);
}

Status SpoolFile::ReadAll(const std::string& scan_id,
                          const std::function<void(const Chunk&)>& read) {
  const std::string head = FileHead(scan_id);
  FORESIGHT_TRY(const std::string found, ReadAt(descriptor_, 0, head.size(), path_));
  // A crash may have left a part of the head, and nothing behind it.
  if (found.size() < head.size() && head.starts_with(found)) return Begin(scan_id);
  if (found != head)
    return Fail(ErrorCode::kBadData, "{}: it is no spool of scan {}; move it away", path_.string(),
                scan_id);
  size_ = static_cast<std::int64_t>(head.size());
  std::string bytes;
  for (;;) {
    FORESIGHT_TRY(
        const std::string more,
        ReadAt(descriptor_, size_ + static_cast<std::int64_t>(bytes.size()), kReadBytes, path_));
    bytes += more;
    const std::size_t clean = ReadSpoolRecords(bytes, read);
    size_ += static_cast<std::int64_t>(clean);
    bytes.erase(0, clean);
    if (more.size() < kReadBytes || bytes.size() > kMostRecordBytes) break;
  }
  struct stat status = {};
  if (fstat(descriptor_, &status) != 0) return Failed(path_, "cannot read");
  cut_ = status.st_size - size_;
  if (cut_ > 0 && ftruncate(descriptor_, size_) != 0) return Failed(path_, "cannot cut");
  return {};
}

Status SpoolFile::Append(std::span<const Chunk> chunks) {
  std::string records;
  for (const Chunk& chunk : chunks) {
    FORESIGHT_CHECK(CheckChunk(chunk));  // a reader would stop there
    records += RecordOf(chunk);
  }
  Status kept = WriteAt(descriptor_, size_, records, path_);
  if (kept && fdatasync(descriptor_) != 0) kept = Failed(path_, "cannot synchronise");
  if (kept) {
    size_ += static_cast<std::int64_t>(records.size());
    return {};
  }
  // A part of a record would hide what is appended behind it.
  if (ftruncate(descriptor_, size_) != 0) kept.error().message += "; its end could not be cut";
  return kept;
}

Status SpoolFile::Remove() {
  if (unlink(path_.c_str()) != 0) return Failed(path_, "cannot delete");
  return SyncFolderOf(path_);
}

Result<std::vector<SpoolSummary>> ListSpools(const fs::path& folder) {
  std::vector<SpoolSummary> spools;
  std::error_code error;
  if (!fs::exists(folder, error)) return spools;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    const fs::path& path = entry->path();
    if (path.extension() != kExtension || !entry->is_regular_file(ignored)) continue;
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) continue;
    const auto head = ReadAt(descriptor, 0, kMagic.size() + kMostIdBytes + 16, path);
    close(descriptor);
    const auto scan_id = head ? ScanIdOf(*head) : std::nullopt;
    if (!scan_id || path.stem() != *scan_id) continue;
    const auto size = fs::file_size(path, ignored);
    spools.push_back({*scan_id, path, ignored ? 0 : static_cast<std::int64_t>(size)});
  }
  if (error) return Fail(ErrorCode::kIo, "{}: {}", folder.string(), error.message());
  std::sort(spools.begin(), spools.end(),
            [](const SpoolSummary& a, const SpoolSummary& b) { return a.scan_id < b.scan_id; });
  return spools;
}

}  // namespace foresight
