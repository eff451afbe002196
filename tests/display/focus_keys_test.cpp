// Whose key Space and Enter are while a control has the focus.
#include "app/workstation/focus_keys.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QGraphicsView>
#include <QLineEdit>
#include <QListWidget>
#include <QMainWindow>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QTest>
#include <QVBoxLayout>

#include "tests/display/paint_counter.h"

namespace foresight {
namespace {

/// A window with two shortcuts, as Scan and Valve have them.
struct FocusKeysOnScreen : testing::Test {
  FocusKeysOnScreen() {
    Shortcut(&scan, Qt::Key_Space, &scans);
    Shortcut(&valve, Qt::Key_V, &valves);
    window.setCentralWidget(centre);
    new QVBoxLayout(centre);
  }
  void Shortcut(QAction* action, Qt::Key key, int* count) {
    action->setShortcut(key);
    window.addAction(action);
    QObject::connect(action, &QAction::triggered, [count] { ++*count; });
  }
  template <class Control>
  Control* Add() {
    auto* control = new Control;
    centre->layout()->addWidget(control);
    return control;
  }
  void Show() {
    window.show();
    QApplication::setActiveWindow(&window);
    ASSERT_TRUE(WaitUntilDrawn(window));
  }
  static void Press(QWidget* control, Qt::Key key) {
    control->setFocus();
    QTest::keyClick(control, key);
    if (QWidget* popup = QApplication::activePopupWidget()) popup->close();
  }

  QMainWindow window;
  QWidget* centre = new QWidget;
  QAction scan, valve;
  int scans = 0, valves = 0;
  FocusKeys keys;
};

TEST_F(FocusKeysOnScreen, SpaceStartsAScanOnlyWhereNoControlUsesIt) {
  auto* button = Add<QPushButton>();
  auto* box = Add<QCheckBox>();
  const std::vector<QWidget*> controls = {button,
                                          box,
                                          Add<QComboBox>(),
                                          Add<QListWidget>(),
                                          Add<QLineEdit>(),
                                          Add<QPlainTextEdit>(),
                                          Add<QDoubleSpinBox>()};
  auto* pane = Add<QGraphicsView>();
  int clicks = 0;
  QObject::connect(button, &QPushButton::clicked, [&] { ++clicks; });
  Show();
  for (QWidget* control : controls) {
    Press(control, Qt::Key_Space);
    EXPECT_EQ(scans, 0) << control->metaObject()->className();
  }
  EXPECT_EQ(clicks, 1) << "Space does what Qt does with it";
  EXPECT_TRUE(box->isChecked());
  Press(pane, Qt::Key_Space);
  EXPECT_EQ(scans, 1);
}

TEST_F(FocusKeysOnScreen, EnterPressesTheButtonThatHasTheFocus) {
  auto* button = Add<QPushButton>();
  int clicks = 0;
  QObject::connect(button, &QPushButton::clicked, [&] { ++clicks; });
  Show();
  Press(button, Qt::Key_Return);
  Press(button, Qt::Key_Enter);
  EXPECT_EQ(clicks, 2);
}

TEST_F(FocusKeysOnScreen, ALetterInAFieldIsWrittenAndStartsNothing) {
  auto* line = Add<QLineEdit>();
  auto* text = Add<QPlainTextEdit>();
  Show();
  Press(line, Qt::Key_V);
  Press(text, Qt::Key_V);
  EXPECT_EQ(valves, 0);
  EXPECT_EQ(line->text(), "v");
  EXPECT_EQ(text->toPlainText(), "v");
}

}  // namespace
}  // namespace foresight
