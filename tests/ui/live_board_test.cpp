#include "ui/viewmodels/live_board_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QTemporaryDir>

#include "core/io/image_file.h"
#include "core/objects/board_mount.h"
#include "tests/ui/board_pictures.h"
#include "tests/ui/fake_head.h"
#include "tests/ui/wait_for.h"

namespace foresight {
namespace {

using testing::HasSubstr;

struct LiveBoard : testing::Test {
  QTemporaryDir folder;
  std::shared_ptr<FakeHead> head = std::make_shared<FakeHead>(DefaultSensorRig());
  TaskQueue tasks;
  HeadViewModel head_model{head};
  LiveBoardModel model{&head_model, &tasks};

  LiveImage ImageOfBoard(CalibrationBoard* board) {
    *board = WriteBoardPictures(folder.path(), 1);
    const auto gray = ReadImageGray(folder.filePath("board1.png").toStdString());
    EXPECT_TRUE(gray);
    LiveImage live;
    live.image = ColorImage(gray->width(), gray->height());
    for (int y = 0; y < gray->height(); ++y)
      for (int x = 0; x < gray->width(); ++x)
        live.image(x, y) = {(*gray)(x, y), (*gray)(x, y), (*gray)(x, y)};
    return live;
  }
  /// Waits until another image was looked at.
  bool Look(const LiveImage& image) {
    const auto before = model.Image();
    head->live_view->OnLiveImage(image);
    return WaitFor([&] { return model.Image() != before; }, 20'000);
  }
};

TEST_F(LiveBoard, TheNumberOfCornersIsTestedWhileTheBoardIsSeen) {
  CalibrationBoard board;
  const LiveImage image = ImageOfBoard(&board);
  CalibrationBoard wrong = board;
  wrong.columns = board.columns + 1;
  model.SetBoard(wrong);
  model.start();
  ASSERT_TRUE(head->live_view);
  ASSERT_TRUE(Look(image));
  EXPECT_THAT(model.Text().toStdString(),
              HasSubstr("7x6 inner corners was found where 8x6 was asked for"));
  EXPECT_TRUE(model.Corners().empty());
  model.SetBoard(board);
  ASSERT_TRUE(Look(image));
  EXPECT_THAT(model.Text().toStdString(), HasSubstr("Found: 7 x 6"));
  ASSERT_EQ(model.Corners().size(), 1u);
  EXPECT_EQ(model.Corners()[0].size(), 42u);
}

// Without its left column of squares the larger board could be the smaller one.
TEST_F(LiveBoard, ABoardThatMayBeAPartOfTheOtherOneIsNotCalledFound) {
  CalibrationBoard board;
  LiveImage image = ImageOfBoard(&board);
  BoardMount mount = UsualBoardMount();
  mount.b = board;
  mount.a.columns = board.columns + 2;
  mount.a.rows = board.rows;
  model.SetMount(mount, head->Rig().camera);
  model.start();
  ASSERT_TRUE(Look(image));
  EXPECT_THAT(model.Text().toStdString(), HasSubstr("Found: 7 x 6")) << "its margin is in sight";
  double left = image.image.width();
  for (const Eigen::Vector2d& corner : model.Corners().at(0)) left = std::min(left, corner.x());
  for (int y = 0; y < image.image.height(); ++y)
    for (int x = 0; x < static_cast<int>(left) - 8; ++x) image.image(x, y) = {110, 110, 110};
  ASSERT_TRUE(Look(image));
  EXPECT_THAT(model.Text().toStdString(), testing::Not(HasSubstr("Found")));
  EXPECT_THAT(model.Text().toStdString(), HasSubstr("7 x 6: this may be a part of the other"));
}

TEST_F(LiveBoard, OfManyImagesTheNewestIsLookedAt) {
  CalibrationBoard board;
  LiveImage image = ImageOfBoard(&board);
  model.SetBoard(board);
  model.start();
  for (int i = 1; i <= 20; ++i) {
    image.time_s = i;
    head->live_view->OnLiveImage(image);
  }
  int looks = 0;
  const QObject counting;  // the model outlives what is counted
  QObject::connect(&model, &LiveBoardModel::changed, &counting, [&looks] { ++looks; });
  ASSERT_TRUE(WaitFor([&] { return model.Image() && model.Image()->time_s == 20.0; }));
  EXPECT_LT(looks, 20) << "images that came meanwhile are left out";
}

TEST_F(LiveBoard, WhoLooksNextTakesTheViewAndATroubleIsSaid) {
  model.start();
  head->live_view->OnLiveViewTrouble("the camera is gone");
  ASSERT_TRUE(WaitFor([&] { return model.Text() == "the camera is gone"; }));
  LiveBoardModel other(&head_model, &tasks);
  other.start();
  EXPECT_FALSE(model.Running());
  EXPECT_TRUE(other.Running());
  other.stop();
  EXPECT_EQ(head->live_view, nullptr);
}

}  // namespace
}  // namespace foresight
