#include "core/exchange/zip_file.h"

#include <archive.h>
#include <archive_entry.h>

#include <system_error>

#include "core/base/atomic_file.h"
#include "core/base/publish_file.h"

namespace foresight {
namespace {

struct FreeEntry {
  void operator()(archive_entry* entry) const { archive_entry_free(entry); }
};

}  // namespace

struct ZipFile::Impl {
  std::filesystem::path target;
  std::filesystem::path part;
  archive* out = nullptr;

  ~Impl() {
    if (out == nullptr) return;
    archive_write_free(out);
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
  }

  Status Done(int code) const {
    if (code == ARCHIVE_OK) return {};
    const char* what = archive_error_string(out);
    return Fail(ErrorCode::kIo, "{}: {}", target.string(),
                what != nullptr ? what : "could not be written");
  }
};

ZipFile::ZipFile(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ZipFile::ZipFile(ZipFile&&) noexcept = default;
ZipFile::~ZipFile() = default;

Result<ZipFile> ZipFile::Create(const std::filesystem::path& path) {
  auto impl = std::make_unique<Impl>();
  FORESIGHT_TRY(impl->target, ResolveOutput(path));
  impl->part = impl->target.string() + ".part";
  impl->out = archive_write_new();
  if (impl->out == nullptr) return Fail(ErrorCode::kIo, "{}: no memory", path.string());
  FORESIGHT_CHECK(impl->Done(archive_write_set_format_zip(impl->out)));
  FORESIGHT_CHECK(impl->Done(archive_write_open_filename(impl->out, impl->part.c_str())));
  return ZipFile(std::move(impl));
}

Status ZipFile::Add(const std::string& name, std::string_view bytes) {
  constexpr std::time_t k1980 = 315532800;  // ZIP knows no earlier time
  const std::unique_ptr<archive_entry, FreeEntry> entry(archive_entry_new());
  archive_entry_set_pathname_utf8(entry.get(), name.c_str());
  archive_entry_set_size(entry.get(), static_cast<la_int64_t>(bytes.size()));
  archive_entry_set_filetype(entry.get(), AE_IFREG);
  archive_entry_set_perm(entry.get(), 0644);
  archive_entry_set_mtime(entry.get(), k1980, 0);
  FORESIGHT_CHECK(impl_->Done(archive_write_header(impl_->out, entry.get())));
  while (!bytes.empty()) {
    const la_ssize_t written = archive_write_data(impl_->out, bytes.data(), bytes.size());
    if (written <= 0) return impl_->Done(ARCHIVE_FATAL);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

Status ZipFile::Finish() {
  FORESIGHT_CHECK(impl_->Done(archive_write_close(impl_->out)));
  archive_write_free(impl_->out);
  impl_->out = nullptr;
  return PublishFile(impl_->part, impl_->target);
}

}  // namespace foresight
