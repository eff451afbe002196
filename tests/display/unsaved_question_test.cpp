// That nobody loses what no file has taken by closing the window.
#include "app/workstation/unsaved_question.h"

#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QCloseEvent>
#include <QTemporaryDir>
#include <QTest>

#include "tests/support/file_size_limit.h"
#include "tests/ui/synthetic_scan.h"
#include "tests/ui/wait_for.h"

namespace foresight {
namespace {

class WindowOfRecording final : public QWidget {
 public:
  explicit WindowOfRecording(RecordingViewModel* recording)
      : question_(new UnsavedQuestion(
            recording, [this] { ++asked_for_file; }, this)) {
    QObject::connect(question_, &UnsavedQuestion::stayed, this, [this] { ++stayed; });
  }
  /// The one on the screen: a closed one goes with the next events.
  QMessageBox* Question() {
    for (auto* question : findChildren<QMessageBox*>(QStringLiteral("unsavedQuestion")))
      if (question->isVisible()) return question;
    return nullptr;
  }
  void Press(const char* text) {
    for (QAbstractButton* button : Question()->buttons())
      if (button->text() == text) return button->click();
    ADD_FAILURE() << "there is no button " << text;
  }
  int asked_for_file = 0;
  int stayed = 0;
  bool refuses = false;

 protected:
  void closeEvent(QCloseEvent* event) override {
    event->setAccepted(!refuses && question_->MayClose());
  }

 private:
  UnsavedQuestion* question_;
};

struct UnsavedQuestionOnScreen : testing::Test {
  UnsavedQuestionOnScreen() { window.show(); }
  void Keep() {
    recording.keepScan(std::make_shared<const Scan>(
        WallAndValveScan({.from_rad = -0.02, .to_rad = 0.02, .speed_rad_s = 0.1})));
  }
  QTemporaryDir folder;
  TaskQueue tasks;
  SessionModel session{SessionMode::kSimulation, &tasks};
  RecordingViewModel recording{&session};
  WindowOfRecording window{&recording};
};

TEST_F(UnsavedQuestionOnScreen, NothingIsAskedWhenAllIsWritten) {
  ASSERT_TRUE(recording.Begin(folder.filePath("m.foresight")));
  Keep();
  ASSERT_TRUE(recording.WriteAll());
  EXPECT_TRUE(window.close());
}

TEST_F(UnsavedQuestionOnScreen, WhatNoFileTookIsLostOnlyIfTheOperatorMeansIt) {
  Keep();
  EXPECT_FALSE(window.close());
  ASSERT_NE(window.Question(), nullptr);
  EXPECT_TRUE(window.Question()->text().contains(QLatin1String("1")));
  EXPECT_EQ(window.Question()->defaultButton()->text(), "Stay");
  window.Press("Stay");
  EXPECT_TRUE(window.isVisible());
  EXPECT_FALSE(window.close());
  window.Press("Quit and lose it");
  EXPECT_FALSE(window.isVisible());
}

// Who hears it forgets what the window was to close for.
TEST_F(UnsavedQuestionOnScreen, HoweverTheQuestionIsClosedTheOperatorStays) {
  Keep();
  EXPECT_FALSE(window.close());
  window.Press("Stay");
  EXPECT_EQ(window.stayed, 1);
  EXPECT_FALSE(window.close());
  QTest::keyClick(window.Question(), Qt::Key_Escape);
  EXPECT_EQ(window.stayed, 2);
  EXPECT_FALSE(window.close());
  window.Question()->close();
  EXPECT_EQ(window.stayed, 3);
  EXPECT_FALSE(window.close());
  ASSERT_TRUE(recording.Begin(folder.filePath("m.foresight")));
  ASSERT_TRUE(recording.WriteAll());
  EXPECT_TRUE(WaitFor([&] { return window.stayed == 4; })) << "all is safe now";
  EXPECT_TRUE(window.isVisible());
}

TEST_F(UnsavedQuestionOnScreen, WhoQuitsAndLosesItDoesNotStay) {
  Keep();
  EXPECT_FALSE(window.close());
  window.Press("Quit and lose it");
  EXPECT_FALSE(window.isVisible());
  EXPECT_EQ(window.stayed, 0);
}

TEST_F(UnsavedQuestionOnScreen, AnotherFileTakesItAndTheWindowCloses) {
  Keep();
  EXPECT_FALSE(window.close());
  window.Press("Record into another file");
  EXPECT_EQ(window.asked_for_file, 1);
  ASSERT_TRUE(recording.Begin(folder.filePath("m.foresight")));
  ASSERT_TRUE(recording.WriteAll());
  EXPECT_TRUE(window.close());
}

// The room that was made shows in a last try, without a question.
TEST_F(UnsavedQuestionOnScreen, TheLastTryIsMadeBeforeAnybodyIsAsked) {
  const QString path = folder.filePath("m.foresight"), away = folder.filePath("away.foresight");
  ASSERT_TRUE(recording.Begin(path));
  ASSERT_TRUE(QFile::rename(path, away));
  Keep();
  ASSERT_TRUE(WaitFor([&] { return recording.Stuck() && !recording.Busy(); }));
  EXPECT_FALSE(window.close());
  ASSERT_NE(window.Question(), nullptr);
  window.Press("Stay");
  ASSERT_TRUE(WaitFor([&] { return recording.Stuck() && !recording.Busy(); }));
  ASSERT_TRUE(QFile::rename(away, path));
  window.close();
  EXPECT_TRUE(WaitFor([&] { return !window.isVisible(); }));
  EXPECT_EQ(recording.Waiting(), 0);
}

// The write that fails may have begun just before: a scan that ends because the window closes.
TEST_F(UnsavedQuestionOnScreen, WhatIsStillBeingWrittenIsWaitedFor) {
  ASSERT_TRUE(recording.Begin(folder.filePath("m.foresight")));
  {
    const FileSizeLimit limit(4096);
    Keep();
    EXPECT_FALSE(window.close());
    EXPECT_TRUE(WaitFor([&] { return window.Question() != nullptr; }));
    EXPECT_TRUE(window.isVisible());
  }
  window.Press("Stay");
  recording.tryAgain();
  EXPECT_FALSE(window.close());
  EXPECT_TRUE(WaitFor([&] { return !window.isVisible(); })) << "it closes when all is written";
  EXPECT_EQ(recording.Waiting(), 0);
}

TEST_F(UnsavedQuestionOnScreen, AFileThatWasDeletedIsAskedAboutThoughNothingWaits) {
  const QString path = folder.filePath("m.foresight");
  ASSERT_TRUE(recording.Begin(path));
  Keep();
  ASSERT_TRUE(recording.WriteAll());
  ASSERT_TRUE(QFile::remove(path));
  EXPECT_FALSE(window.close());
  ASSERT_NE(window.Question(), nullptr);
  EXPECT_TRUE(window.Question()->text().contains("m.foresight was moved or deleted"));
}

// To lose one thing is not to lose the next.
TEST_F(UnsavedQuestionOnScreen, ThePermissionToLoseIsForOneTime) {
  Keep();
  EXPECT_FALSE(window.close());
  window.refuses = true;  // as in the middle of a sweep
  window.Press("Quit and lose it");
  ASSERT_TRUE(window.isVisible());
  window.refuses = false;
  EXPECT_FALSE(window.close());
  ASSERT_TRUE(WaitFor([&] { return window.Question() != nullptr; }));
}

}  // namespace
}  // namespace foresight
