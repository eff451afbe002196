// Docks as narrow as they may get.
#include <gtest/gtest.h>

#include <QComboBox>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QScrollBar>

#include "tests/display/paint_counter.h"
#include "ui/panels/notes_panel.h"
#include "ui/panels/objects_panel.h"
#include "ui/viewmodels/map_view_model.h"

namespace foresight {
namespace {

struct NarrowDock : testing::Test {
  NarrowDock() {
    for (const char* id : {"object.accept", "object.reject", "object.copy", "object.delete",
                           "object.fit", "measure.tool", "notes.delete"})
      commands.Add({.id = id, .run = [] {}});
  }
  FoundObject Valve() const {
    FoundObject object;
    object.detection = ValveDetection();
    object.name = QStringLiteral("The valve behind the second door on the left");
    return object;
  }
  SessionModel session{SessionMode::kSimulation};
  FitViewModel fit{&session};
  MapViewModel map{&session};
  MeasureViewModel measure{&session, &map};
  CommandTable commands;
};

TEST_F(NarrowDock, TheListOfObjectsShowsThreeRowsAndNoBarBelowThem) {
  ObjectsPanel panel(&session, &fit, &commands);
  for (int i = 0; i < 3; ++i) session.AddObject(Valve());
  panel.resize(220, 500);
  panel.show();
  ASSERT_TRUE(WaitUntilDrawn(panel));
  const auto* list = panel.findChild<QListWidget*>();
  EXPECT_FALSE(list->horizontalScrollBar()->isVisible());
  EXPECT_LE(list->visualItemRect(list->item(2)).bottom(), list->viewport()->height());
  EXPECT_TRUE(list->item(0)->toolTip().startsWith(list->item(0)->text())) << "it may be cut off";
}

TEST_F(NarrowDock, NothingOfTheNotesIsCutOff) {
  NotesPanel panel(&session, &measure, &commands);
  panel.resize(panel.minimumWidth(), 500);
  panel.show();
  ASSERT_TRUE(WaitUntilDrawn(panel));
  const auto expect_whole = [&](const QWidget* widget) {
    if (!widget->isVisible()) return;
    EXPECT_EQ(widget->visibleRegion().boundingRect(), widget->rect())
        << widget->objectName().toStdString();
  };
  for (const auto* button : panel.findChildren<QPushButton*>()) {
    expect_whole(button);
    EXPECT_GE(button->width(), button->fontMetrics().horizontalAdvance(button->text()))
        << button->text().toStdString();
  }
  for (const auto* box : panel.findChildren<QComboBox*>()) expect_whole(box);
  for (const auto* field : panel.findChildren<QLineEdit*>()) expect_whole(field);
}

}  // namespace
}  // namespace foresight
