#include "app/workstation/unattended.h"

#include <QBuffer>
#include <QCoreApplication>
#include <QPixmap>

#include "core/base/atomic_file.h"
#include "core/base/log.h"

namespace foresight {
namespace {

constexpr int kIdleLooks = 10;  // the panes draw after the last result has come

Status Save(const QPixmap& image, const std::string& file) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  if (!image.save(&buffer, "PNG"))
    return Fail(ErrorCode::kIo, "{}: the window cannot be made a PNG image", file);
  return WriteFileAtomically(file, {bytes.constData(), static_cast<std::size_t>(bytes.size())});
}

}  // namespace

Unattended::Unattended(Workbench* bench, QWidget* window, const UnattendedOptions& options)
    : bench_(bench), window_(window), options_(options) {
  connect(&timer_, &QTimer::timeout, this, &Unattended::Look);
  if (options_.scan || !options_.screenshot.empty()) timer_.start(100);
}

void Unattended::Look() {
  if (options_.scan) {
    if (!bench_->head.CanScan()) return;
    options_.scan = false;
    bench_->head.scan();
    return;
  }
  idle_looks_ = bench_->Idle() ? idle_looks_ + 1 : 0;
  if (options_.screenshot.empty() || idle_looks_ < kIdleLooks) return;
  timer_.stop();
  const Status saved = Save(window_->grab(), options_.screenshot);
  if (!saved) LogError("{}", saved.error().message);
  QCoreApplication::exit(saved ? 0 : 1);
}

}  // namespace foresight
