#include "app/workstation/unattended.h"

#include <QCoreApplication>
#include <QPixmap>

#include "core/base/log.h"

namespace foresight {
namespace {

constexpr int kIdleLooks = 10;  // the panes draw after the last result has come

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
  const bool saved = window_->grab().save(QString::fromStdString(options_.screenshot));
  if (!saved) LogError("{}: cannot write the picture", options_.screenshot);
  QCoreApplication::exit(saved ? 0 : 1);
}

}  // namespace foresight
