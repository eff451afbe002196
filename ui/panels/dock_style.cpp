#include "ui/panels/dock_style.h"

#include <qtadvanceddocking/DockManager.h>

namespace foresight {
namespace {

constexpr const char* kStyle = R"(
ads--CDockContainerWidget { background: #14161a; }
ads--CDockContainerWidget > QSplitter { padding: 0; }
ads--CDockContainerWidget ads--CDockSplitter::handle { background: #14161a; }
ads--CDockAreaWidget { background: #262a30; border: none; }
ads--CDockAreaTitleBar { background: #1c1f24; padding: 0; border: none; }
ads--CDockWidgetTab { background: #1c1f24; border: none; padding: 5px 12px; }
ads--CDockWidgetTab QLabel { color: #a4acb6; }
ads--CDockWidgetTab[activeTab="true"] { background: #262a30; border-top: 2px solid #3a82c4; }
ads--CDockWidgetTab[activeTab="true"] QLabel { color: #e8ebef; font-weight: bold; }
ads--CDockWidget { background: #262a30; border: none; }
)";

}  // namespace

void SetUpDocks() {
  using ads::CDockManager;
  CDockManager::setConfigFlags(CDockManager::OpaqueSplitterResize |
                               CDockManager::XmlCompressionEnabled |
                               CDockManager::FloatingContainerHasWidgetTitle);
}

void StyleDocks(ads::CDockManager* docks) {
  docks->setStyleSheet(QString::fromLatin1(kStyle));
}

}  // namespace foresight
