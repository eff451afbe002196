#include "hardware/link/pki/certificate_gate.h"

#include <gmock/gmock.h>

#include <atomic>
#include <thread>
#include <vector>

#include "core/base/log.h"
#include "tests/support/link_keys.h"

namespace foresight {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kGateNow = 1'790'000'000;

class Gate : public testing::Test {
 protected:
  Gate() {
    SetLogListener([this](LogLevel level, std::string_view line) {
      if (level >= LogLevel::kWarning) log_ += std::string(line) + "\n";
    });
  }
  ~Gate() override { SetLogListener({}); }

  std::shared_ptr<CertificateGate> Open(const std::filesystem::path& folder) {
    auto gate =
        CertificateGate::Open(LoadTlsFiles(folder, kGateNow).value(), [this] { return now_; });
    EXPECT_TRUE(gate) << gate.error().message;
    return *gate;
  }
  std::string Pem(const std::filesystem::path& folder) const {
    return ReadFile(folder / kCertificateFile).value();
  }

  LinkKeys keys_{kGateNow};
  std::filesystem::path head_ = keys_.Head();
  std::string anna_ = Pem(keys_.Operator());
  std::int64_t now_ = kGateNow;
  std::string log_;
};

TEST_F(Gate, OfAHeadAdmitsOperatorsAndObserversAndNoHeads) {
  const auto gate = Open(head_);
  EXPECT_EQ(gate->Admit(anna_)->identity, (LinkIdentity{LinkRole::kOperator, "anna"}));
  EXPECT_TRUE(gate->Admit(Pem(keys_.Observer())));
  const auto other_head = gate->Admit(Pem(keys_.Head("right")));
  ASSERT_FALSE(other_head);
  EXPECT_THAT(other_head.error().message, HasSubstr("is not the certificate of an operator"));
}

TEST_F(Gate, OfAStationAdmitsHeadsOnly) {
  const auto gate = Open(keys_.folder("anna"));
  EXPECT_TRUE(gate->Admit(Pem(head_)));
  EXPECT_FALSE(gate->Admit(Pem(keys_.Operator("eve"))));
}

TEST_F(Gate, TakesANewListWithoutARestart) {
  const auto gate = Open(head_);
  ASSERT_TRUE(gate->Admit(anna_));
  ASSERT_TRUE(gate->CheckStillGood(anna_));
  ASSERT_TRUE(keys_.ca().Revoke("anna", kGateNow));  // writes into the folder of the head
  const auto admitted = gate->Admit(anna_);
  ASSERT_FALSE(admitted);
  EXPECT_THAT(admitted.error().message, HasSubstr("was revoked"));
  EXPECT_FALSE(gate->CheckStillGood(anna_));
}

TEST_F(Gate, ADamagedListIsLoggedAndTheOneBeforeHolds) {
  ASSERT_TRUE(keys_.ca().Revoke("anna", kGateNow));
  const auto gate = Open(head_);
  ASSERT_TRUE(WriteFileAtomically(head_ / kRevocationsFile, "nothing"));
  EXPECT_FALSE(gate->Admit(anna_));
  EXPECT_THAT(log_, HasSubstr("holds no revocation list"));
  ASSERT_TRUE(std::filesystem::remove(head_ / kRevocationsFile));
  EXPECT_FALSE(gate->Admit(anna_));
  EXPECT_THAT(log_, HasSubstr("cannot open"));
  EXPECT_TRUE(gate->Admit(Pem(keys_.Observer())));
}

TEST_F(Gate, AnOlderListIsNotTaken) {
  const std::string before = ReadFile(head_ / kRevocationsFile).value();
  ASSERT_TRUE(keys_.ca().Revoke("anna", kGateNow));
  const auto gate = Open(head_);
  ASSERT_TRUE(WriteFileAtomically(head_ / kRevocationsFile, before));
  EXPECT_FALSE(gate->Admit(anna_));
  EXPECT_THAT(log_, HasSubstr("older than list"));
}

TEST_F(Gate, AListOfAnotherCaIsNotTaken) {
  LinkKeys foreign(kGateNow);
  ASSERT_TRUE(keys_.ca().Revoke("anna", kGateNow));
  const auto gate = Open(head_);
  foreign.DeliverRevocations(head_);
  EXPECT_FALSE(gate->Admit(anna_));
  EXPECT_THAT(log_, HasSubstr("was not signed by this CA"));
}

TEST_F(Gate, AnOverdueListHoldsAndIsWarnedAbout) {
  ASSERT_TRUE(keys_.ca().MakeRevocationsAnew(10, kGateNow));
  now_ = kGateNow + 11 * kDayS;
  const auto gate = Open(head_);
  EXPECT_THAT(log_, HasSubstr("was to be made anew by 2026-10-01"));
  EXPECT_TRUE(gate->Admit(anna_));
}

TEST_F(Gate, AConnectionThatLastsBeyondTheCertificateIsRefused) {
  const auto gate = Open(head_);
  ASSERT_TRUE(gate->CheckStillGood(anna_));
  now_ = kGateNow + (kDaysOfCertificate + 1) * kDayS;
  const auto late = gate->CheckStillGood(anna_);
  ASSERT_FALSE(late);
  EXPECT_THAT(late.error().message, HasSubstr("foresight:operator:anna: expired on"));
}

TEST_F(Gate, IsAskedFromManyThreadsWhileListsChange) {
  const auto gate = Open(head_);
  const std::string otto = Pem(keys_.Observer());
  std::atomic<int> refused = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < 100; ++k)
        if (!gate->Admit(otto) || !gate->CheckStillGood(otto)) ++refused;
    });
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(keys_.ca().MakeRevocationsAnew(30, kGateNow + i));
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(refused, 0);
}

TEST_F(Gate, DoesNotOpenWithoutAListOrForARevokedCertificate) {
  const TlsFiles files = LoadTlsFiles(keys_.folder("anna"), kGateNow).value();
  const TlsFiles of_head = LoadTlsFiles(head_, kGateNow).value();
  ASSERT_TRUE(std::filesystem::remove(head_ / kRevocationsFile));
  EXPECT_EQ(CertificateGate::Open(of_head).error().code, ErrorCode::kIo);
  ASSERT_TRUE(keys_.ca().Revoke("anna", kGateNow));
  std::filesystem::create_directories(files.folder);  // anna has not heard of it yet
  keys_.DeliverRevocations(files.folder);
  const auto gate = CertificateGate::Open(files);
  ASSERT_FALSE(gate);
  EXPECT_THAT(gate.error().message, HasSubstr("the certificate of anna was revoked"));
}

}  // namespace
}  // namespace foresight
