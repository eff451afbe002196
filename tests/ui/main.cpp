#include <gtest/gtest.h>

#include <QCoreApplication>

/// View-models need an event loop, and nothing of a window system.
int main(int argc, char** argv) {
  const QCoreApplication application(argc, argv);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
