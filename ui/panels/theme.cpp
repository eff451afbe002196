#include "ui/panels/theme.h"

#include <QApplication>
#include <QFont>
#include <QPalette>
#include <QStyleFactory>

/// Resources of a static library are not registered by themselves; Qt's macro must stand outside
/// of a namespace.
static void RegisterIcons() {
  Q_INIT_RESOURCE(icons);
}

namespace foresight {
namespace {

QPalette DarkPalette() {
  const QColor window(38, 42, 48), button(52, 57, 64), base(28, 31, 36);
  const QColor text(232, 235, 239), faint(140, 147, 156), accent(58, 130, 196);
  QPalette palette(button, window);  // Light, Mid and Dark follow from these two
  palette.setColor(QPalette::WindowText, text);
  palette.setColor(QPalette::Base, base);
  palette.setColor(QPalette::AlternateBase, window);
  palette.setColor(QPalette::Text, text);
  palette.setColor(QPalette::ButtonText, text);
  palette.setColor(QPalette::BrightText, Qt::white);
  palette.setColor(QPalette::ToolTipBase, button);
  palette.setColor(QPalette::ToolTipText, text);
  palette.setColor(QPalette::PlaceholderText, faint);
  palette.setColor(QPalette::Highlight, accent);
  palette.setColor(QPalette::HighlightedText, Qt::white);
  palette.setColor(QPalette::Link, state_color::kActive);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    palette.setColor(QPalette::Disabled, role, faint);
  palette.setColor(QPalette::Disabled, QPalette::Highlight, button);
  return palette;
}

constexpr const char* kStyle = R"(
QToolTip { border: 1px solid #596270; padding: 4px; }
QToolBar { border: none; spacing: 2px; padding: 2px 6px; }
QToolBar QToolButton { padding: 3px 6px; }
QLabel#emptyState { color: #a4acb6; background: #16191d; font-size: 12pt; padding: 24px; }
QLabel#faint { color: #a4acb6; }
QLabel#fault { color: #f0a35e; }
QLabel#cornerTag { color: #e8ebef; background: rgba(20, 22, 26, 215); border-radius: 4px;
  padding: 3px 8px; }
QLabel#sectionTitle { color: #a4acb6; font-weight: bold; }
QLabel#badge { color: #16181c; font-weight: bold; border-radius: 4px; padding: 2px 10px; }
QFrame#strip { background: #1c1f24; border-bottom: 1px solid #14161a; }
QFrame#notice { background: #23272d; border-bottom: 1px solid #14161a; }
QFrame#card { background: #2c3138; border-radius: 6px; }
QToolButton:checked { background: #2f74b0; border: 1px solid #2f74b0; border-radius: 3px; color: white; }
QToolBar QToolButton:checked { border-radius: 4px; }
QPushButton { padding: 6px 12px; }
QPushButton#scanButton { background: #2f74b0; color: white; border: none; border-radius: 6px;
  font-size: 13pt; font-weight: bold; padding: 10px 4px; }
QPushButton#scanButton:hover { background: #3a82c0; }
QPushButton#scanButton:pressed { background: #27639a; }
QPushButton#scanButton:disabled { background: #3a4048; color: #8c939c; }
QPushButton#stopButton { background: #b84a1c; color: white; border: none; border-radius: 4px;
  font-weight: bold; padding: 6px 16px; }
QPushButton#stopButton:hover { background: #cc5523; }
QPushButton#stopButton:pressed { background: #9c3d15; }
)";

}  // namespace

void ApplyTheme(QApplication* application) {
  RegisterIcons();
  application->setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
  application->setPalette(DarkPalette());
  QFont font(QStringLiteral("DejaVu Sans"), 10);
  application->setFont(font);
  application->setStyleSheet(QString::fromLatin1(kStyle));
}

QIcon Icon(const char* name) {
  return QIcon(QStringLiteral(":/icons/%1.svg").arg(QString::fromLatin1(name)));
}

}  // namespace foresight
