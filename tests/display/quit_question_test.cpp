// That nobody ends a sweep by closing the window without meaning it.
#include "app/workstation/quit_question.h"

#include <gtest/gtest.h>

#include <QCloseEvent>
#include <QPushButton>
#include <QTest>

#include "tests/ui/linked_head.h"
#include "tests/ui/wait_for.h"

namespace foresight {
namespace {

class AskingWindow final : public QWidget {
 public:
  explicit AskingWindow(HeadViewModel* head) : question_(new QuitQuestion(head, this)) {}
  QMessageBox* Question() { return findChild<QMessageBox*>(QStringLiteral("quitQuestion")); }
  void Forget() { question_->Forget(); }
  int tries = 0;
  bool refuses = false;

 protected:
  void closeEvent(QCloseEvent* event) override {
    ++tries;
    event->setAccepted(question_->MayClose() && !refuses);
  }

 private:
  QuitQuestion* question_;
};

struct QuitQuestionOnScreen : testing::Test {
  QuitQuestionOnScreen() { window.show(); }
  void Sweep() {
    head->SetState(HeadState::kSweeping);
    model.Poll();
  }
  std::shared_ptr<FakeHead> head = std::make_shared<FakeHead>(DefaultSensorRig());
  HeadViewModel model{head};
  AskingWindow window{&model};
};

TEST_F(QuitQuestionOnScreen, NothingIsAskedWhileTheHeadStands) {
  EXPECT_TRUE(window.close());
}

TEST_F(QuitQuestionOnScreen, InMidSweepTheWindowStaysUnlessTheOperatorMeansIt) {
  model.scan();
  head->Begin(Scan());
  EXPECT_FALSE(window.close());
  ASSERT_NE(window.Question(), nullptr);
  EXPECT_FALSE(window.Question()->isModal()) << "nothing modal opens during a scan";
  EXPECT_EQ(window.Question()->defaultButton()->text(), "Stay");
  QTest::keyClick(window.Question(), Qt::Key_Escape);
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  EXPECT_TRUE(window.isVisible());
  EXPECT_FALSE(head->Stopped());
  EXPECT_FALSE(window.close());
  ScanState ended = ScanState::kRunning;
  QObject::connect(&model, &HeadViewModel::scanEnded,
                   [&](const std::shared_ptr<const Scan>& scan) { ended = scan->state; });
  for (QAbstractButton* button : window.Question()->buttons())
    if (button != window.Question()->defaultButton()) button->click();
  EXPECT_TRUE(WaitFor([&] { return !window.isVisible(); }, 1000));
  EXPECT_TRUE(head->Stopped());
  EXPECT_EQ(ended, ScanState::kAborted) << "the scan has its end";
}

TEST_F(QuitQuestionOnScreen, AWindowThatStaysAfterAllIsNotClosedByTheNextStatus) {
  model.scan();
  head->Begin(Scan());
  EXPECT_FALSE(window.close());
  window.refuses = true;  // another question holds it
  for (QAbstractButton* button : window.Question()->buttons())
    if (button != window.Question()->defaultButton()) button->click();
  ASSERT_TRUE(window.isVisible());
  const int tries = window.tries;
  window.Forget();
  window.refuses = false;
  for (int i = 0; i < 3; ++i) model.Poll();
  Q_EMIT model.statusChanged();
  EXPECT_TRUE(window.isVisible());
  EXPECT_EQ(window.tries, tries);
  EXPECT_TRUE(model.StopLatched());
  model.releaseStop();
  model.scan();
  head->Begin(Scan());
  EXPECT_FALSE(window.close()) << "the next sweep is asked about";
}

TEST_F(QuitQuestionOnScreen, TheQuestionGoesWhenTheSweepIsOver) {
  Sweep();
  EXPECT_FALSE(window.close());
  head->SetState(HeadState::kReady);
  model.Poll();
  EXPECT_TRUE(window.Question() == nullptr || !window.Question()->isVisible());
  EXPECT_TRUE(window.close());
}

TEST(QuitQuestionOverALink, AHeadThatCannotBeReachedIsNotSaidToStop) {
  const auto head = std::make_shared<LinkedHead>(DefaultSensorRig());
  head->link.health.connected = true;
  head->link.health.has_control = true;
  HeadViewModel model(head);
  AskingWindow window(&model);
  window.show();
  head->SetState(HeadState::kSweeping);
  model.Poll();
  EXPECT_FALSE(window.close());
  ASSERT_NE(window.Question(), nullptr);
  EXPECT_TRUE(window.Question()->informativeText().contains("stops the head"));
  head->link.health.connected = false;
  model.Poll();
  EXPECT_FALSE(window.Question()->informativeText().contains("stops the head"));
  EXPECT_TRUE(window.Question()->informativeText().contains("goes on moving"));
  for (QAbstractButton* button : window.Question()->buttons())
    if (button != window.Question()->defaultButton()) button->click();
  EXPECT_TRUE(model.Answers().Text().contains("STOP")) << model.Answers().Text().toStdString();
}

TEST(QuitQuestionOverALink, AnotherOperatorsSweepGoesOnWhenThisWindowCloses) {
  const auto head = std::make_shared<LinkedHead>(DefaultSensorRig());
  head->link.health.connected = true;
  HeadViewModel model(head);
  AskingWindow window(&model);
  window.show();
  head->SetState(HeadState::kSweeping);
  model.Poll();
  EXPECT_TRUE(window.close());
  EXPECT_EQ(window.Question(), nullptr);
  EXPECT_FALSE(head->Stopped());
}

}  // namespace
}  // namespace foresight
