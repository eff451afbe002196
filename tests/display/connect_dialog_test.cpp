#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QComboBox>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QTest>
#include <atomic>

#include "app/workstation/connect_dialog.h"
#include "tests/ui/fake_head.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// A network and a head that answer as a test wants.
struct ConnectOnScreen : testing::Test {
  ConnectOnScreen() {
    network.heads = {{"left", "10.0.0.7:47130", false}, {"right", "10.0.0.8:47130", true}};
    model = std::make_unique<ConnectModel>(
        [this] { return network; },
        [this](const LinkArguments& link) -> Result<OpenedHead> {
          asked = link;
          while (slow) std::this_thread::sleep_for(std::chrono::milliseconds(1));
          if (refuses) return Fail(ErrorCode::kDevice, "{}: nobody answers", link.head);
          OpenedHead head;
          head.head = std::make_shared<FakeHead>(DefaultSensorRig());
          return head;
        },
        nullptr);
    QObject::connect(model.get(), &ConnectModel::opened, [this] { ++opened; });
    dialog = std::make_unique<ConnectDialog>(model.get(), QStringList{"robot:5"}, "keys");
    dialog->show();
  }
  ~ConnectOnScreen() override { slow = false; }

  template <class T>
  T* Find(const char* name) {
    return dialog->findChild<T*>(QString::fromLatin1(name));
  }
  void Click(const char* name) { QTest::mouseClick(Find<QPushButton>(name), Qt::LeftButton); }
  std::string State() { return Find<QLabel>("connectState")->text().toStdString(); }
  bool Answered() {
    return QTest::qWaitFor([this] { return !model->Connecting(); }, 5000);
  }

  ConnectModel::Network network;
  std::atomic<bool> slow = false, refuses = false;
  LinkArguments asked;
  int opened = 0;
  std::unique_ptr<ConnectModel> model;
  std::unique_ptr<ConnectDialog> dialog;
};

TEST_F(ConnectOnScreen, AHeadOfTheListIsAskedForItsName) {
  auto* list = Find<QListWidget>("announcedHeads");
  ASSERT_EQ(list->count(), 2);
  list->setCurrentRow(1);
  Click("connectToHead");
  ASSERT_TRUE(Answered());
  EXPECT_EQ(asked.head, "10.0.0.8:47130");
  EXPECT_EQ(asked.name, "right");
  EXPECT_EQ(asked.keys, "keys");
  EXPECT_EQ(opened, 1);
  EXPECT_TRUE(model->TakeHead().has_value());
  EXPECT_FALSE(model->TakeHead().has_value());
}

TEST_F(ConnectOnScreen, TheOnlyHeadIsChosenWhereNothingWasTyped) {
  network.heads.resize(1);
  ConnectDialog first_time(model.get(), {}, "");
  ASSERT_TRUE(QTest::qWaitFor([&] { return model->Heads().size() == 1; }, 5000));
  EXPECT_EQ(first_time.findChild<QComboBox*>("headAddress")->currentText(), "10.0.0.7:47130");
  EXPECT_EQ(Find<QComboBox>("headAddress")->currentText(), "robot:5") << "that was typed";
}

TEST_F(ConnectOnScreen, AnAddressThatWasTypedProvesItself) {
  Find<QListWidget>("announcedHeads")->setCurrentRow(0);
  Find<QComboBox>("headAddress")->setCurrentText("elsewhere");
  Click("connectToHead");
  ASSERT_TRUE(Answered());
  EXPECT_EQ(asked.head, "elsewhere");
  EXPECT_EQ(asked.name, "");
}

TEST_F(ConnectOnScreen, TheLastAddressStandsThereAndAWrongOneIsRefusedAtOnce) {
  EXPECT_EQ(Find<QComboBox>("headAddress")->currentText(), "robot:5");
  Find<QComboBox>("headAddress")->setCurrentText("robot:port");
  Click("connectToHead");
  EXPECT_THAT(State(), HasSubstr("HOST or HOST:PORT"));
  EXPECT_TRUE(asked.head.empty());
}

TEST_F(ConnectOnScreen, AHeadThatDoesNotAnswerIsSaidAndTheDialogueStays) {
  refuses = true;
  Click("connectToHead");
  ASSERT_TRUE(Answered());
  EXPECT_THAT(State(), HasSubstr("robot:5: nobody answers"));
  EXPECT_TRUE(dialog->isVisible());
  EXPECT_EQ(opened, 0);
  EXPECT_TRUE(Find<QPushButton>("connectToHead")->isEnabled());
}

TEST_F(ConnectOnScreen, AnAnswerThatNobodyWaitsForAnyMoreChangesNothing) {
  slow = true;
  Click("connectToHead");
  EXPECT_FALSE(Find<QPushButton>("connectToHead")->isEnabled());
  EXPECT_EQ(Find<QPushButton>("closeConnect")->text(), "Cancel");
  Click("closeConnect");
  slow = false;
  ASSERT_TRUE(Answered());
  EXPECT_EQ(opened, 0);
  EXPECT_TRUE(dialog->isVisible());
}

TEST_F(ConnectOnScreen, HeadsThatComeLaterAppearAndTheChosenOneStaysChosen) {
  auto* list = Find<QListWidget>("announcedHeads");
  list->setCurrentRow(1);
  network.heads.insert(network.heads.begin(), {"first", "10.0.0.6:47130", false});
  ASSERT_TRUE(QTest::qWaitFor([&] { return list->count() == 3; }, 5000));
  EXPECT_EQ(list->currentRow(), 2);
  network = {{}, "no mDNS on this computer: avahi-daemon does not run"};
  ASSERT_TRUE(QTest::qWaitFor([&] { return list->count() == 0; }, 5000));
  EXPECT_THAT(Find<QLabel>("searchText")->text().toStdString(),
              HasSubstr("avahi-daemon does not run. Type the head's address."));
}

}  // namespace
}  // namespace foresight
