// Byte vectors are written out: encoder and decoder could share a mistake.
#include "hardware/scip/scip_codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hardware/scip/scip_encoding.h"
#include "hardware/scip/scip_status.h"

namespace foresight {
namespace {

using testing::HasSubstr;

ScipReply ReplyOf(const std::string& bytes) {
  ScipParser parser;
  parser.Push(bytes);
  return parser.Take().value();
}

TEST(ScipEncoding, WritesSixBitsACharacter) {
  EXPECT_EQ(EncodeScipValue(1000, 3), "0?X");
  EXPECT_EQ(EncodeScipValue(1234, 3), "0CB");
  EXPECT_EQ(EncodeScipValue(5432, 3), "1Dh");
  EXPECT_EQ(EncodeScipValue(30000, 3), "7D`");
  EXPECT_EQ(EncodeScipValue(60000, 3), ">YP");
  EXPECT_EQ(EncodeScipValue(65535, 3), "?oo");
  EXPECT_EQ(EncodeScipValue(1234, 2), "CB");
  EXPECT_EQ(EncodeScipValue(123456, 4), "0N90");
}

TEST(ScipEncoding, ReadsWhatItWritesInTwoThreeAndFourCharacters) {
  EXPECT_EQ(DecodeScipValue("CB"), 1234u);
  EXPECT_EQ(DecodeScipValue(">YP"), 60000u);
  EXPECT_EQ(DecodeScipValue("oooo"), 0xFFFFFFu);
}

TEST(ScipEncoding, RefusesBytesOutsideTheAlphabet) {
  EXPECT_FALSE(DecodeScipValue("0&0"));
  EXPECT_FALSE(DecodeScipValue("0p0"));
  EXPECT_FALSE(DecodeScipValue("0/0"));
  EXPECT_FALSE(DecodeScipValue("0\xff\x30"));
}

TEST(ScipEncoding, SumsAreTheLowSixBits) {
  const std::pair<const char*, char> cases[] = {{"00", 'P'}, {"01", 'Q'}, {"02", 'R'},
                                                {"03", 'S'}, {"0C", 'c'}, {"0E", 'e'},
                                                {"10", 'Q'}, {"99", 'b'}, {"98", 'a'}};
  for (const auto& [text, sum] : cases) EXPECT_EQ(ScipSum(text), sum) << text;
}

TEST(ScipStatus, EveryCodeHasWords) {
  for (const char* code :
       {"00", "01", "02", "03", "04", "05", "06", "07", "0A", "0B", "0C", "0D", "0E",
        "0F", "0G", "0H", "0I", "0L", "10", "21", "49", "50", "97", "98", "99"})
    EXPECT_NE(ScipStatusMeaning(code), "unknown status") << code;
  EXPECT_EQ(DescribeScipStatus("10"), "status 10: refused in this state");
  EXPECT_EQ(ScipStatusMeaning("0Z"), "unknown status");
}

TEST(ScipRequest, HasTheDevicesForm) {
  EXPECT_EQ(EncodeScipRequest({.command = ScipCommand::kVersion}), "VV");
  EXPECT_EQ(EncodeScipRequest({.command = ScipCommand::kReadTime, .tag = "t1"}), "TM1;t1");
  EXPECT_EQ(EncodeScipRequest({.command = ScipCommand::kStreamIntensity, .tag = "s17"}),
            "ME0000108001000;s17");
  EXPECT_EQ(EncodeScipRequest({.command = ScipCommand::kSingleAll, .last_step = 5, .group = 2}),
            "HE0000000502");
}

TEST(ScipRequest, ParsesWhatItEncodes) {
  for (int i = 0; i <= static_cast<int>(ScipCommand::kSingleAll); ++i) {
    ScipRequest request{.command = static_cast<ScipCommand>(i), .tag = "a b;c"};
    if (IsStream(request.command)) request.count = 7;
    EXPECT_EQ(ParseScipRequest(EncodeScipRequest(request)), request) << ToText(request.command);
  }
}

TEST(ScipRequest, AnswersMistakesWithTheDevicesStatus) {
  const std::pair<const char*, const char*> cases[] = {
      {"XX", "0E"},
      {"", "0E"},
      {"ME0000108001000;12345678901234567", "0G"},
      {"VV;a\x01", "0H"},
      {"ME00x01080010000", "0D"},
      {"ME00x0108001000", "01"},
      {"ME0000-08001000", "02"},
      {"ME00001080 1000", "03"},
      {"ME0000108001x00", "06"},
      {"ME00001080010x0", "07"},
      {"ME0005000401000", "05"},
      {"ME0000108001", "0C"},
      {"VV1", "0D"},
  };
  for (const auto& [text, status] : cases)
    EXPECT_EQ(ParseScipRequest(text).error(), status) << text;
}

TEST(ScipCodec, DecodesAScanOfBytes) {
  const ScipScan scan =
      DecodeScipScan(ReplyOf("ME0538054201001\n99b\n0N90W\n0CB0^h0CC0_20CH0^^1Dh0<P0010003\n\n"))
          .value();
  EXPECT_EQ(scan.stamp_ms, 123456u);
  EXPECT_EQ(scan.request.count, 1);
  ASSERT_EQ(scan.steps.size(), 5u);
  EXPECT_EQ(scan.steps[0].echoes[0], (ScipEcho{1234, 3000}));
  EXPECT_EQ(scan.steps[3].echoes[0].range_mm, 5432u);
  EXPECT_EQ(scan.steps[4].echoes[0], (ScipEcho{1, 0})) << "a code stays a code";
}

TEST(ScipCodec, EncodesTheSameBytes) {
  ScipScan scan{
      {.command = ScipCommand::kStreamIntensity, .first_step = 538, .last_step = 542, .count = 1},
      123456,
      {}};
  for (const ScipEcho echo :
       {ScipEcho{1234, 3000}, {1235, 3010}, {1240, 2990}, {5432, 800}, {1, 0}})
    scan.steps.push_back({{echo}, 1});
  EXPECT_EQ(EncodeScipScan(scan),
            "ME0538054201001\n99b\n0N90W\n0CB0^h0CC0_20CH0^^1Dh0<P0010003\n\n");
}

TEST(ScipCodec, FurtherEchoesFollowAnAmpersand) {
  const std::string data = "0CB0^h&0RR0:l0010000CB0^h";
  const ScipScan scan = DecodeScipScan(ReplyOf("NE0000000201000\n99b\n" + WithScipSum("0N90") +
                                               "\n" + WithScipSum(data) + "\n\n"))
                            .value();
  ASSERT_EQ(scan.steps[0].count, 2u);
  EXPECT_EQ(scan.steps[0].echoes[0], (ScipEcho{1234, 3000}));
  EXPECT_EQ(scan.steps[0].echoes[1], (ScipEcho{2210, 700}));
  EXPECT_EQ(scan.steps[1].count, 1u);
  EXPECT_EQ(scan.steps[2].count, 1u);
}

TEST(ScipCodec, EveryKindOfScanSurvivesTheWire) {
  for (int i = static_cast<int>(ScipCommand::kStream);
       i <= static_cast<int>(ScipCommand::kSingleAll); ++i) {
    ScipScan scan;
    scan.request = {.command = static_cast<ScipCommand>(i), .last_step = 1080, .group = 2};
    scan.stamp_ms = 0xFFFFFF;
    for (int v = 0; v < scan.request.Values(); ++v) {
      ScipStep step;
      step.count = HasEchoes(scan.request.command) ? static_cast<std::size_t>(1 + v % 3) : 1;
      for (std::size_t e = 0; e < step.count; ++e) {
        step.echoes[e].range_mm = static_cast<std::uint32_t>(v * 100 + 7 * static_cast<int>(e));
        if (HasIntensity(scan.request.command)) step.echoes[e].intensity = 262143;
      }
      scan.steps.push_back(step);
    }
    ASSERT_EQ(scan.steps.size(), 541u);
    EXPECT_EQ(DecodeScipScan(ReplyOf(EncodeScipScan(scan))).value(), scan)
        << ToText(scan.request.command);
  }
}

TEST(ScipCodec, AFullScanHasTheSizeOnTheWireOfTheRealOne) {
  for (const auto& [command, bytes] :
       {std::pair(ScipCommand::kStream, 3372u), std::pair(ScipCommand::kStreamIntensity, 6717u)}) {
    ScipScan scan{{.command = command}, 0, std::vector<ScipStep>(1081)};
    EXPECT_EQ(EncodeScipScan(scan).size(), bytes);
  }
}

TEST(ScipCodec, AFlippedBitAnywhereInTheDataIsNoticed) {
  const std::string clean = "ME0538054201001\n99b\n0N90W\n0CB0^h0CC0_20CH0^^1Dh0<P0010003\n\n";
  const std::size_t data = clean.find("0N90");
  for (std::size_t at = data; at + 2 < clean.size(); ++at) {
    if (clean[at] == '\n') continue;
    std::string damaged = clean;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    EXPECT_FALSE(DecodeScipScan(ReplyOf(damaged))) << at;
  }
}

TEST(ScipCodec, SaysWhatIsDamaged) {
  const auto bad = DecodeScipScan(ReplyOf("ME0538054201001\n99b\n0N90W\n0CB0^h0\n\n"));
  EXPECT_EQ(bad.error().code, ErrorCode::kBadData);
  EXPECT_EQ(bad.error().message, "reply to ME0538054201001: wrong sum in line 1 of the scan");
}

TEST(ScipCodec, ReadsInformationFromItsEndBecauseTheSumMayBeASemicolon) {
  const ScipInfo info =
      DecodeScipInfo(ReplyOf("VV\n00P\nVEND:Hokuyo Automatic Co., Ltd.;;\n\n")).value();
  EXPECT_EQ(info.at("VEND"), "Hokuyo Automatic Co., Ltd.");
}

TEST(ScipCodec, AcceptsTheSumsOfAllFirmwares) {
  const std::string text = "FIRM:3.3.00(20/Jul./2010)";
  const std::string comment = "<-comment";
  for (const std::string& line :
       {text + ";" + ScipSum(text), text + ";" + ScipSum(text + ";"),
        text + comment + ";" + ScipSum(text), text + comment + ";" + ScipSum(text + comment)})
    EXPECT_EQ(DecodeScipInfo(ReplyOf("VV\n00P\n" + line + "\n\n")).value().at("FIRM"),
              "3.3.00(20/Jul./2010)")
        << line;
}

TEST(ScipCodec, InformationWithAWrongSumIsDamaged) {
  EXPECT_THAT(DecodeScipInfo(ReplyOf("PP\n00P\nDMIN:23;0\n\n")).error().message,
              HasSubstr("damaged line 'DMIN:23;0'"));
}

TEST(ScipCodec, ParametersSurviveTheWire) {
  ScipParameters parameters;
  parameters.model = "UTM-30LX-EW";
  parameters.last_step = 60;
  const auto info = DecodeScipInfo(ReplyOf(EncodeScipInfo("PP", ToFields(parameters)))).value();
  EXPECT_EQ(DecodeScipParameters(info).value(), parameters);
}

TEST(ScipCodec, AMissingParameterIsNamed) {
  ScipInfo info{{"MODL", "x"}, {"DMIN", "23"}};
  EXPECT_EQ(DecodeScipParameters(info).error().message, "parameters: DMAX is missing");
  info["DMAX"] = "x";
  EXPECT_EQ(DecodeScipParameters(info).error().message, "parameters: DMAX is 'x', no number");
}

TEST(ScipCodec, ReadsTheTime) {
  EXPECT_EQ(DecodeScipTime(ReplyOf("TM1;t\n00P\n0N90W\n\n")).value(), 123456u);
  EXPECT_FALSE(DecodeScipTime(ReplyOf("TM1;t\n00P\n0N90X\n\n")));
  EXPECT_EQ(EncodeScipTime("TM1;t", 123456), "TM1;t\n00P\n0N90W\n\n");
}

}  // namespace
}  // namespace foresight
