#include "tests/display/workstation_fixture.h"

#include <QGuiApplication>
#include <QScreen>

namespace foresight {

std::unique_ptr<RunningWindow> Workstation::running;
bool Workstation::scanned = false;

void Workstation::SetUpTestSuite() {
  running = std::make_unique<RunningWindow>();
  scanned = running->ScanWithTheMouse();
}

void Workstation::TearDown() {
  if (HasFailure())
    QGuiApplication::primaryScreen()->grabWindow(0).save(
        QStringLiteral("%1/failed_%2.png")
            .arg(QCoreApplication::applicationDirPath(),
                 testing::UnitTest::GetInstance()->current_test_info()->name()));
}

}  // namespace foresight
