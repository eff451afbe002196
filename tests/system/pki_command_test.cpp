// foresightctl pki: from nothing to keys of a head and its people.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"

namespace foresight {
namespace {

using testing::HasSubstr;
using testing::Not;

class PkiCommand : public testing::Test {
 protected:
  ProgramResult Pki(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "pki");
    arguments.insert(arguments.end(), {"--pki", ca_});
    return RunProgram(FORESIGHTCTL, arguments);
  }
  void Make(const std::vector<std::string>& arguments) {
    const ProgramResult result = Pki(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.errors;
  }
  ProgramResult Check(const std::string& folder, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"pki", "check", folder};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram(FORESIGHTCTL, arguments);
  }
  std::string Machine(const std::string& name) const { return ca_ + "/machines/" + name; }

  TemporaryFolder folder_;
  std::string ca_ = folder_ / "pki";
};

TEST_F(PkiCommand, SaysWhichFilesGoWhere) {
  Make({"init"});
  const ProgramResult head = Pki({"head", "left", "--address", "10.0.0.2", "head.local"});
  ASSERT_EQ(head.exit_code, 0) << head.errors;
  for (const char* file : {"ca.crt", "ca.crl", "link.crt", "link.key"}) {
    EXPECT_THAT(head.output, HasSubstr(Machine("left") + "/" + file));
    EXPECT_TRUE(std::filesystem::exists(Machine("left") + "/" + file)) << file;
  }
  EXPECT_THAT(head.output, HasSubstr("Copy them into /etc/foresight/link on the head left"));
  const ProgramResult anna = Pki({"operator", "anna"});
  ASSERT_EQ(anna.exit_code, 0) << anna.errors;
  EXPECT_THAT(anna.output, HasSubstr("Copy them into ~/.config/foresight/link"));
  EXPECT_THAT(anna.output, Not(HasSubstr("ca.key")));
}

TEST_F(PkiCommand, ListsWhatThereIsAndWhatEndsWhen) {
  Make({"init"});
  Make({"head", "left", "--address", "10.0.0.2"});
  Make({"operator", "anna"});
  Make({"observer", "otto"});
  Make({"renew", "left", "--address", "10.0.0.3"});
  Make({"revoke", "anna"});
  const auto json = nlohmann::json::parse(Pki({"list", "--json"}).output);
  EXPECT_EQ(json["revocations"]["number"], 2);
  EXPECT_EQ(json["revocations"]["overdue"], false);
  const auto& all = json["certificates"];
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[0]["name"], "anna");
  EXPECT_EQ(all[0]["state"], "revoked");
  EXPECT_EQ(all[1]["state"], "renewed");
  EXPECT_EQ(all[2]["role"], "head");
  EXPECT_EQ(all[2]["state"], "valid");
  EXPECT_EQ(all[2]["addresses"][1], "10.0.0.3");
  EXPECT_EQ(all[3]["role"], "observer");
  EXPECT_THAT(Pki({"list"}).output, HasSubstr("left.foresight.internal 10.0.0.3"));
}

TEST_F(PkiCommand, CheckEndsWithOneWhereKeysCannotBeUsed) {
  Make({"init"});
  Make({"operator", "anna"});
  const ProgramResult good = Check(Machine("anna"), {"--json"});
  EXPECT_EQ(good.exit_code, 0) << good.errors;
  EXPECT_EQ(nlohmann::json::parse(good.output)["usable"], true);
  std::filesystem::remove(Machine("anna") + "/link.key");
  const ProgramResult bad = Check(Machine("anna"));
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.output, HasSubstr("link.key: cannot open"));
  EXPECT_EQ(bad.ErrorLines(), 1);
  EXPECT_EQ(Check(folder_ / "none").exit_code, 3);
}

TEST_F(PkiCommand, NothingIsOverwrittenUnlessAskedFor) {
  Make({"init"});
  Make({"operator", "anna"});
  const ProgramResult ca = Pki({"init"});
  EXPECT_EQ(ca.exit_code, 3);
  EXPECT_THAT(ca.errors, HasSubstr("never overwritten"));
  const ProgramResult again = Pki({"operator", "anna"});
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_EQ(again.ErrorLines(), 1);
  Make({"operator", "anna", "--replace"});
}

TEST_F(PkiCommand, RevokingSaysWhereTheListGoes) {
  Make({"init"});
  Make({"operator", "anna"});
  const ProgramResult result = Pki({"revoke", "anna"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr(ca_ + "/ca.crl"));
  EXPECT_THAT(result.output, HasSubstr("Copy it into /etc/foresight/link on each head"));
  EXPECT_EQ(nlohmann::json::parse(Pki({"revocations", "--json"}).output)["number"], 3);
}

TEST_F(PkiCommand, MistakesAreNamedInOneLine) {
  EXPECT_EQ(Pki({"operator", "anna"}).exit_code, 3);  // no CA yet
  Make({"init"});
  const auto expect = [](const ProgramResult& result, int exit_code, const char* text) {
    EXPECT_EQ(result.exit_code, exit_code);
    EXPECT_EQ(result.ErrorLines(), 1) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr(text));
    EXPECT_TRUE(result.output.empty()) << result.output;
  };
  expect(Pki({"operator", "a/b"}), 2, "a/b is no name of an operator");
  expect(Pki({"head", "left", "--address", "10.0.0.2:7411"}), 2, "no port");
  expect(Pki({"operator", "anna", "--days", "0"}), 2, "--days: 0 is not between 1 and 36");
  expect(Pki({"renew", "anna"}), 3, "anna: no certificate of that name");
  expect(Pki({"revoke", "anna"}), 3, "anna: no certificate of that name");
  EXPECT_EQ(Pki({"head", "left"}).exit_code, 2);  // no address
  EXPECT_EQ(RunProgram(FORESIGHTCTL, {"pki"}).exit_code, 2);
}

}  // namespace
}  // namespace foresight
