#include "core/mission/sqlite_pages.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace foresight {
namespace {

constexpr std::size_t kFileHeaderBytes = 100;
constexpr std::uint32_t kOurPageBytes = 8192;
constexpr std::uint64_t kMaxRecordBytes = 256 << 20;
/// Our widest table has 13 columns; the header of a record has a varint for its own size and one a
/// column.
constexpr std::uint64_t kMaxRecordHeader = 13 * 9 + 1;

std::uint32_t BigEndian(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + size; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

/// Reads from the front of bytes; every call fails once something did not fit.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : bytes_(bytes) {}

  bool good() const { return good_; }
  std::string_view rest() const { return bytes_; }

  std::uint64_t Varint() {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < 9; ++i) {
      if (i >= bytes_.size()) break;
      const auto byte = static_cast<unsigned char>(bytes_[i]);
      if (i == 8) {
        bytes_.remove_prefix(9);
        return value << 8 | byte;
      }
      value = value << 7 | (byte & 0x7fu);
      if (byte < 0x80) {
        bytes_.remove_prefix(i + 1);
        return value;
      }
    }
    good_ = false;
    return 0;
  }

  std::string_view Take(std::uint64_t size) {
    if (size > bytes_.size()) {
      good_ = false;
      return {};
    }
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }

 private:
  std::string_view bytes_;
  bool good_ = true;
};

std::int64_t SignedBigEndian(std::string_view bytes) {
  std::uint64_t value = static_cast<unsigned char>(bytes.front()) >= 0x80 ? ~std::uint64_t{0} : 0;
  for (const char byte : bytes) value = value << 8 | static_cast<unsigned char>(byte);
  return static_cast<std::int64_t>(value);
}

/// The value of a serial type; nullopt where the type is none or the bytes end.
std::optional<StoredValue> ValueOf(std::uint64_t type, Cursor& body) {
  constexpr std::array<std::uint64_t, 7> kIntegerBytes = {0, 1, 2, 3, 4, 6, 8};
  if (type == 0) return StoredValue();
  if (type <= 6) {
    const std::string_view bytes = body.Take(kIntegerBytes[type]);
    return body.good() ? std::optional<StoredValue>(SignedBigEndian(bytes)) : std::nullopt;
  }
  if (type == 7) {
    const std::string_view bytes = body.Take(8);
    return body.good() ? std::optional<StoredValue>(std::bit_cast<double>(SignedBigEndian(bytes)))
                       : std::nullopt;
  }
  if (type == 8 || type == 9) return StoredValue(static_cast<std::int64_t>(type - 8));
  if (type < 12) return std::nullopt;
  const std::string_view bytes = body.Take((type - 12) / 2);
  if (!body.good()) return std::nullopt;
  const bool is_text = type % 2 == 1;
  return is_text ? StoredValue(std::string(bytes)) : StoredValue(StoredBlob{std::string(bytes)});
}

std::optional<std::vector<StoredValue>> DecodeRecord(std::string_view payload) {
  Cursor sized(payload);
  const std::uint64_t header_bytes = sized.Varint();
  if (!sized.good() || header_bytes < 2 || header_bytes > payload.size() ||
      header_bytes > kMaxRecordHeader)
    return std::nullopt;
  Cursor header(payload.substr(0, header_bytes));
  header.Varint();
  Cursor body(payload.substr(header_bytes));
  std::vector<StoredValue> values;
  while (!header.rest().empty()) {
    const std::uint64_t type = header.Varint();
    if (!header.good()) return std::nullopt;
    std::optional<StoredValue> value = ValueOf(type, body);
    if (!value) return std::nullopt;
    values.push_back(std::move(*value));
  }
  if (!body.rest().empty()) return std::nullopt;
  return values;
}

/// Whether the beginning of a payload is the header of a record of just that many bytes: rejects
/// nearly everything that is none before what follows on other pages is read.
bool HasRecordHeader(std::string_view beginning, std::uint64_t payload_bytes) {
  constexpr std::array<std::uint64_t, 12> kBytes = {0, 1, 2, 3, 4, 6, 8, 8, 0, 0, 0, 0};
  Cursor sized(beginning);
  const std::uint64_t header_bytes = sized.Varint();
  if (!sized.good() || header_bytes < 2 || header_bytes > kMaxRecordHeader ||
      header_bytes > beginning.size())
    return false;
  Cursor header(beginning.substr(0, header_bytes));
  header.Varint();
  std::uint64_t body_bytes = 0;
  while (!header.rest().empty()) {
    const std::uint64_t type = header.Varint();
    if (!header.good() || type == 10 || type == 11 || type > 2 * kMaxRecordBytes + 13) return false;
    body_bytes += type < kBytes.size() ? kBytes[type] : (type - 12) / 2;
  }
  return header_bytes + body_bytes == payload_bytes;
}

Result<std::string> ReadAt(int descriptor, std::int64_t offset, std::size_t size,
                           const std::string& name) {
  std::string bytes(size, '\0');
  std::size_t got = 0;
  while (got < size) {
    const ssize_t count = ::pread(descriptor, bytes.data() + got, size - got,
                                  offset + static_cast<std::int64_t>(got));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      return Fail(ErrorCode::kIo, "{}: {}", name, std::generic_category().message(errno));
    if (count == 0) break;  // cut: the rest stays zero
    got += static_cast<std::size_t>(count);
  }
  return bytes;
}

std::int64_t SizeOf(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 ? status.st_size : 0;
}

bool IsPageSize(std::uint32_t bytes) {
  return bytes >= 512 && bytes <= 65536 && std::has_single_bit(bytes);
}

/// The running checksum of a write-ahead log.
class LogChecksum {
 public:
  explicit LogChecksum(bool big_endian) : big_endian_(big_endian) {}

  void Add(std::string_view bytes) {
    for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
      first_ += Word(bytes, at) + second_;
      second_ += Word(bytes, at + 4) + first_;
    }
  }
  bool Is(std::string_view eight_bytes) const {
    return BigEndian(eight_bytes, 0, 4) == first_ && BigEndian(eight_bytes, 4, 4) == second_;
  }

 private:
  std::uint32_t Word(std::string_view bytes, std::size_t at) const {
    const std::uint32_t word = BigEndian(bytes, at, 4);
    return big_endian_ ? word : __builtin_bswap32(word);
  }

  bool big_endian_;
  std::uint32_t first_ = 0;
  std::uint32_t second_ = 0;
};

}  // namespace

void SqlitePages::CloseFile::operator()(const int* descriptor) const {
  ::close(*descriptor);
  delete descriptor;
}

Result<SqlitePages::File> SqlitePages::OpenFile(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0)
    return Fail(ErrorCode::kIo, "{}: {}", path.string(), std::generic_category().message(errno));
  File file(new int(descriptor));
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode))
    return Fail(ErrorCode::kIo, "{}: is no regular file", path.string());
  return file;
}

Result<SqlitePages> SqlitePages::Open(const std::filesystem::path& path) {
  SqlitePages pages;
  pages.name_ = path.string();
  FORESIGHT_TRY(pages.file_, OpenFile(path));
  pages.ReadHeader();
  std::error_code error;
  const std::filesystem::path real = std::filesystem::weakly_canonical(path, error);
  const std::filesystem::path log = (error ? path : real).string() + "-wal";
  if (std::filesystem::is_regular_file(log, error)) FORESIGHT_CHECK(pages.OverlayLog(log));
  return pages;
}

void SqlitePages::ReadHeader() {
  const auto header = ReadAt(*file_, 0, kFileHeaderBytes, name_);
  page_bytes_ = header ? BigEndian(*header, 16, 2) : 0;
  if (page_bytes_ == 1) page_bytes_ = 65536;
  std::uint32_t reserved = header ? BigEndian(*header, 20, 1) : 0;
  // SQLite's own files begin with its name; behind anything else no number of the header holds.
  if (!header || !header->starts_with("SQLite format 3") || !IsPageSize(page_bytes_)) {
    page_bytes_ = kOurPageBytes;
    reserved = 0;
  }
  usable_bytes_ = page_bytes_ - (reserved <= 32 ? reserved : 0);
  user_version_ = header ? BigEndian(*header, 60, 4) : 0;
  count_ = static_cast<std::uint32_t>((SizeOf(*file_) + page_bytes_ - 1) / page_bytes_);
}

Status SqlitePages::OverlayLog(const std::filesystem::path& log) {
  constexpr std::size_t kLogHeaderBytes = 32, kFrameHeaderBytes = 24;
  constexpr std::uint32_t kMagic = 0x377f0682;  // the last bit tells the byte order of checksums
  FORESIGHT_TRY(log_, OpenFile(log));
  FORESIGHT_TRY(const std::string header, ReadAt(*log_, 0, kLogHeaderBytes, log.string()));
  const std::uint32_t magic = BigEndian(header, 0, 4);
  if ((magic & ~1u) != kMagic || BigEndian(header, 8, 4) != page_bytes_) return {};
  LogChecksum checksum((magic & 1u) != 0);
  checksum.Add(std::string_view(header).substr(0, 24));
  if (!checksum.Is(std::string_view(header).substr(24))) return {};
  const std::string salt = header.substr(16, 8);
  const auto frame_bytes = static_cast<std::int64_t>(kFrameHeaderBytes + page_bytes_);
  std::unordered_map<std::uint32_t, std::int64_t> not_committed;
  const std::int64_t end = SizeOf(*log_);
  for (auto at = static_cast<std::int64_t>(kLogHeaderBytes); at + frame_bytes <= end;
       at += frame_bytes) {
    FORESIGHT_TRY(const std::string frame,
                  ReadAt(*log_, at, static_cast<std::size_t>(frame_bytes), log.string()));
    const std::string_view bytes = frame;
    checksum.Add(bytes.substr(0, 8));
    checksum.Add(bytes.substr(kFrameHeaderBytes));
    if (bytes.substr(8, 8) != salt || !checksum.Is(bytes.substr(16))) break;
    not_committed[BigEndian(bytes, 0, 4)] = at + static_cast<std::int64_t>(kFrameHeaderBytes);
    const std::uint32_t pages_after_commit = BigEndian(bytes, 4, 4);
    if (pages_after_commit == 0) continue;
    for (const auto& [page, where] : not_committed) in_log_[page] = where;
    not_committed.clear();
    count_ = std::max(count_, pages_after_commit);
  }
  return {};
}

Result<std::string> SqlitePages::PageBytes(std::uint32_t page) const {
  const auto in_log = in_log_.find(page);
  if (in_log != in_log_.end()) return ReadAt(*log_, in_log->second, page_bytes_, name_);
  return ReadAt(*file_, std::int64_t{page - 1} * page_bytes_, page_bytes_, name_);
}

Result<std::optional<StoredRow>> SqlitePages::CellAt(std::string_view bytes, std::size_t offset,
                                                     CellKind kind) const {
  if (offset >= usable_bytes_) return std::nullopt;
  Cursor cell(bytes.substr(offset, usable_bytes_ - offset));
  const std::uint64_t size = cell.Varint();
  StoredRow row;
  if (kind == CellKind::kTable) row.rowid = static_cast<std::int64_t>(cell.Varint());
  if (!cell.good() || size < 3 || size > kMaxRecordBytes) return std::nullopt;
  const std::uint64_t most_local =
      kind == CellKind::kTable ? usable_bytes_ - 35 : (usable_bytes_ - 12) * 64 / 255 - 23;
  std::string payload;
  if (size <= most_local) {
    payload = cell.Take(size);
    if (!cell.good() || !HasRecordHeader(payload, size)) return std::nullopt;
  } else {
    const std::uint64_t least_local = (usable_bytes_ - 12) * 32 / 255 - 23;
    const std::uint64_t wanted = least_local + (size - least_local) % (usable_bytes_ - 4);
    payload = cell.Take(wanted <= most_local ? wanted : least_local);
    const std::string_view link = cell.Take(4);
    if (!cell.good() || !HasRecordHeader(payload, size)) return std::nullopt;
    std::uint32_t next = BigEndian(link, 0, 4);
    while (payload.size() < size) {
      if (next < 2 || next > count_) return std::nullopt;
      FORESIGHT_TRY(const std::string page, PageBytes(next));
      next = BigEndian(page, 0, 4);
      payload.append(page, 4, std::min<std::uint64_t>(size - payload.size(), usable_bytes_ - 4));
    }
  }
  std::optional<std::vector<StoredValue>> values = DecodeRecord(payload);
  if (!values) return std::nullopt;
  row.values = std::move(*values);
  return row;
}

Result<bool> SqlitePages::VisitListed(std::string_view bytes, std::size_t header,
                                      const Accept& accept) const {
  constexpr unsigned char kIndexInterior = 2, kTableInterior = 5, kIndexLeaf = 10, kTableLeaf = 13;
  const auto type = static_cast<unsigned char>(bytes[header]);
  if (type == kTableInterior) return true;  // holds no rows
  if (type != kIndexInterior && type != kIndexLeaf && type != kTableLeaf) return false;
  const std::uint32_t cells = BigEndian(bytes, header + 3, 2);
  const std::size_t list = header + (type == kIndexInterior ? 12 : 8);
  if (list + 2 * std::size_t{cells} > usable_bytes_) return false;
  bool all = true;
  for (std::uint32_t i = 0; i < cells; ++i) {
    std::size_t offset = BigEndian(bytes, list + 2 * std::size_t{i}, 2);
    if (type == kIndexInterior) offset += 4;  // behind the number of the page below
    FORESIGHT_TRY(std::optional<StoredRow> row,
                  CellAt(bytes, offset, type == kTableLeaf ? CellKind::kTable : CellKind::kIndex));
    all = row && accept(std::move(*row)) && all;
  }
  return all;
}

Status SqlitePages::VisitEveryByte(std::string_view bytes, const Accept& accept) const {
  for (std::size_t offset = 0; offset < usable_bytes_; ++offset) {
    for (const CellKind kind : {CellKind::kTable, CellKind::kIndex}) {
      FORESIGHT_TRY(std::optional<StoredRow> row, CellAt(bytes, offset, kind));
      if (row) accept(std::move(*row));
    }
  }
  return {};
}

Status SqlitePages::VisitRows(std::uint32_t page, const Accept& accept) const {
  FORESIGHT_TRY(const std::string bytes, PageBytes(page));
  FORESIGHT_TRY(const bool all, VisitListed(bytes, page == 1 ? kFileHeaderBytes : 0, accept));
  return all ? Status() : VisitEveryByte(bytes, accept);
}

}  // namespace foresight
