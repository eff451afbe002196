#include "ui/viewmodels/command_table.h"

#include <gtest/gtest.h>

#include "core/base/contract.h"

namespace foresight {
namespace {

TEST(CommandTable, ACommandThatIsNotAllowedIsNotRunAndSaysWhy) {
  CommandTable table;
  bool allowed = false;
  int runs = 0;
  table.Add({.id = "a.b",
             .text = QStringLiteral("Do it"),
             .run = [&] { ++runs; },
             .why_not = [&] { return allowed ? QString() : QStringLiteral("not yet"); }});
  QString why;
  QObject::connect(&table, &CommandTable::refused,
                   [&](const QString&, const QString& reason) { why = reason; });
  EXPECT_FALSE(table.Run("a.b"));
  EXPECT_EQ(runs, 0);
  EXPECT_EQ(why.toStdString(), "not yet");
  allowed = true;
  EXPECT_TRUE(table.Run("a.b"));
  EXPECT_EQ(runs, 1);
}

TEST(CommandTable, EveryCommandHasAnIdOfItsOwn) {
  CommandTable table;
  table.Add({.id = "a", .run = [] {}});
  EXPECT_THROW(table.Add({.id = "a", .run = [] {}}), ContractViolation);
  EXPECT_THROW(table.Add({.id = "b"}), ContractViolation);
  EXPECT_THROW(table.Run("c"), ContractViolation);
}

}  // namespace
}  // namespace foresight
