// Reading .dsa recordings: the format's own example, every variant of docs/notes/dsa_format.md, and
// the oddities that cost no more than a warning.
#include "palpate/recording/dsa_reader.h"

#include <algorithm>

#include "palpate/core/error.h"

#include "recording/dsa_corpus.h"
#include "testing/testing.h"

namespace palpate::dsa_reader_test {
namespace {

using testing::compressed;
using testing::exampleXml;
using testing::replaced;

Profile readText(std::string_view text, const DsaReadOptions& options = {}) {
  return readDsaBytes(std::as_bytes(std::span(text.data(), text.size())), "test.dsa", options);
}

void expectExample(const Profile& profile) {
  ASSERT_EQ(profile.numFrames(), 2u);
  EXPECT_EQ(profile.frameTimeUs(0), 1'400'000'000'000'000);
  EXPECT_EQ(profile.frameTimeUs(1), 1'400'000'000'032'000);
  EXPECT_EQ(profile.frame(0).values, std::vector<float>(6, 0.0F));
  EXPECT_EQ(profile.frame(1).values, (std::vector<float>{0, 0, 100, 0, 1000, 0}));
  ASSERT_EQ(profile.numTemperatures(), 1u);
  EXPECT_EQ(profile.temperatureTimeUs(0), 1'400'000'000'010'000);
  EXPECT_EQ(profile.temperatures(0).values,
            (std::vector<double>{35.5, 35.0, 31.25, 35.25, 31.5, 34.5, 32.0, 44.5, 44.25}));
  ASSERT_EQ(profile.numAngles(), 1u);
  EXPECT_EQ(profile.angleTimeUs(0), 1'400'000'000'001'000);
  EXPECT_EQ(profile.angles(0).values, (std::vector<double>{60, -10, 10, -90, 0, -10, 10}));
}

// The warnings in one text.
std::string warningsOf(std::string_view text) {
  std::string out;
  const Profile profile = readText(text);
  for (const std::string& warning : profile.info().warnings) out += warning + "\n";
  return out;
}

void expectWarning(std::string_view from, std::string_view to, std::string_view part) {
  const std::string text = replaced(exampleXml(), from, to);
  const std::string warnings = warningsOf(text);
  EXPECT_NE(warnings.find(part), std::string::npos) << warnings;
  EXPECT_EQ(std::count(warnings.begin(), warnings.end(), '\n'), 1) << warnings;
}

TEST(DsaReader, readsTheExampleOfTheFormat) {
  const Profile profile = readText(compressed(exampleXml()));
  expectExample(profile);
  EXPECT_EQ(profile.info().format, "dsa");
  EXPECT_EQ(profile.info().serial, "00000001");
  EXPECT_EQ(profile.info().firmware, "105");
  EXPECT_EQ(profile.info().valueType, ValueType::kCounts);
  EXPECT_TRUE(profile.info().warnings.empty());
  ASSERT_EQ(profile.layout().numMatrices(), 1u);
  EXPECT_EQ(profile.layout().matrix(0).rows, 2);
  EXPECT_EQ(profile.layout().matrix(0).columns, 3);
  EXPECT_EQ(profile.layout().matrix(0).pitchMm, 3.4);
  EXPECT_EQ(profile.hand().axes.size(), 7u);
  EXPECT_EQ(profile.hand().temperatureSensors.size(), 9u);
}

TEST(DsaReader, readsPlainXmlWithAndWithoutByteOrderMark) {
  expectExample(readText(exampleXml()));
  expectExample(readText("\xEF\xBB\xBF" + exampleXml()));
}

TEST(DsaReader, readsEveryBlockSizeAndConcatenatedStreams) {
  const std::string text = exampleXml();
  for (int level = 1; level <= 9; ++level) expectExample(readText(compressed(text, level)));
  expectExample(readText(compressed(text.substr(0, 1000)) + compressed(text.substr(1000), 5)));
  expectExample(readText(compressed(text) + compressed("")));
}

TEST(DsaReader, readsAFileAsItReadsBytes) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "a.dsa", compressed(exampleXml()));
  expectExample(readDsa(folder / "a.dsa"));
}

TEST(DsaReader, lineEndsAndIndentationMeanNothing) {
  std::string windows;
  for (const char c : exampleXml()) {
    if (c == '\n') windows += '\r';
    windows += c;
  }
  expectExample(readText(windows));
  std::string escapedLine = exampleXml();
  std::erase(escapedLine, '\n');
  expectExample(readText(escapedLine));
  expectExample(readText(replaced(exampleXml(), "42C80000", "\r\n\t42c8\r\n0000")));
  expectExample(readText(replaced(exampleXml(), "111 111", "\r\n 111\r\n\t111\r\n")));
}

TEST(DsaReader, readsAFrameOnOneLongLine) {
  // 256 x 256 values: 524,288 characters without a line end.
  std::string text;
  for (int i = 0; i < 65536; ++i) text += "3F800000";
  const Profile profile = readText(compressed(testing::framesXml(256, 256, {text})));
  ASSERT_EQ(profile.numFrames(), 1u);
  EXPECT_EQ(profile.frame(0).values, std::vector<float>(65536, 1.0F));
}

TEST(DsaReader, fractionalValuesMakeAFloatProfile) {
  const Profile profile = readText(replaced(exampleXml(), "42C80000", "42C88000"));  // 100.25
  EXPECT_EQ(profile.info().valueType, ValueType::kFloat);
  EXPECT_EQ(profile.frame(1).values[2], 100.25F);
}

TEST(DsaReader, readsOtherLayouts) {
  const Profile profile =
      readText(compressed(testing::framesXml(200, 200, {"C71C4000", "42C80000C71C3F00"})));
  ASSERT_EQ(profile.layout().numCells(), 40000u);
  ASSERT_EQ(profile.numFrames(), 2u);
  EXPECT_EQ(profile.frame(1).values[0], 100.0F);
  EXPECT_EQ(profile.frame(1).values[1], 0.0F);
}

TEST(DsaReader, missingAnglesAndTemperaturesAreAWarning) {
  std::string text = exampleXml();
  const std::size_t from = text.find("  <temperatures>");
  text.erase(from, text.find("</root>") - from);
  const Profile profile = readText(text);
  EXPECT_EQ(profile.numFrames(), 2u);
  EXPECT_EQ(profile.numAngles(), 0u);
  EXPECT_EQ(profile.numTemperatures(), 0u);
  EXPECT_EQ(profile.info().warnings,
            (std::vector<std::string>{"no element temperatures", "no element joint_angles"}));
}

TEST(DsaReader, angleAndTemperaturesMayComeBeforeTheData) {
  std::string text = exampleXml();
  const std::size_t from = text.find("  <data>");
  const std::size_t to = text.find("  <temperatures>");
  const std::string data = text.substr(from, to - from);
  text.erase(from, to - from);
  expectExample(readText(replaced(text, "</root>", data + "</root>")));
}

TEST(DsaReader, anEmptyRecordingHasNoFrames) {
  std::string text = replaced(exampleXml(), "<frame_count>2<", "<frame_count>0<");
  const std::size_t from = text.find("    <frame index");
  text.erase(from, text.find("  </data>") - from);
  const Profile profile = readText(text);
  EXPECT_EQ(profile.numFrames(), 0u);
  EXPECT_EQ(profile.numAngles(), 1u);
  EXPECT_TRUE(profile.info().warnings.empty());
}

TEST(DsaReader, declaredCountsAreOnlyCompared) {
  expectWarning("<frame_count>2<", "<frame_count>3<", "frame_count says \"3\", found 2");
  expectWarning("<frame_count>2<", "<frame_count>9223372036854775808<", "found 2");
  expectWarning("<frame_count>2<", "<frame_count>-1<", "frame_count says \"-1\", found 2");
  expectWarning("<temp_count>1<", "<temp_count>many<", "temp_count says \"many\", found 1");
  expectWarning("<angle_count>1</angle_count>", "", "no angle_count; found 1");
}

TEST(DsaReader, whatIsUnknownIsSkippedAndCounted) {
  expectWarning("<data>", "<new><a b=\"c\">d</a></new><data>", "2 unknown elements skipped");
  expectWarning("<frame index=\"0\">", "<frame index=\"0\"><x/>", "1 unknown element skipped");
  expectWarning("<data>", "<data version=\"2\">", "1 unknown attribute skipped");
  expectWarning("</frame_data>", "</frame_data> (-6: six zeros)", "1 piece of text");
  expectWarning("<frame index=\"1\">", "<frame index=\"7\">", "out of sequence");
}

TEST(DsaReader, missingPartsOfTheSensorAreAssumed) {
  expectWarning("<num_matrices>1</num_matrices>", "", "num_matrices is missing; found 1");
  expectWarning("<static_mask>111 111</static_mask>", "", "matrix 0: no static_mask");
  expectWarning("<dynamic_mask>111 111</dynamic_mask>", "", "matrix 0: no dynamic_mask");
  std::string text = replaced(exampleXml(), "<texel_width>3.4</texel_width>", "");
  EXPECT_EQ(warningsOf(text), "");  // texel_height says it
  text = replaced(text, "<texel_height>3.4</texel_height>", "");
  EXPECT_NE(warningsOf(text).find("no texel_width, 3.4 mm assumed"), std::string::npos);
}

TEST(DsaReader, masksAreReadRowByRow) {
  const Profile profile =
      readText(replaced(replaced(exampleXml(), "<static_mask>111 111", "<static_mask>110 111"),
                        "<dynamic_mask>111 111",
                        "<dynamic_mask>111 001"));
  const MatrixLayout& matrix = profile.layout().matrix(0);
  EXPECT_EQ(matrix.staticMask, (Mask{1, 1, 0, 1, 1, 1}));
  EXPECT_EQ(matrix.dynamicMask, (Mask{1, 1, 1, 0, 0, 1}));
  // Value 100 stands at row 0, column 2, where there is no taxel.
  EXPECT_EQ(profile.frame(1).values, (std::vector<float>{0, 0, 0, 0, 1000, 0}));
  EXPECT_EQ(profile.info().warnings.size(), 1u);
}

TEST(DsaReader, stampsAreMadeStrictlyIncreasing) {
  const std::string frames =
      "<frame index=\"2\"><time_stamp>1400000000032</time_stamp><frame_data>C0C00000</frame_data>"
      "</frame><frame index=\"3\"><time_stamp>1300000000000</time_stamp><frame_data>C0C00000"
      "</frame_data></frame><frame index=\"4\"><time_stamp>1400000000064</time_stamp><frame_data>"
      "C0C00000</frame_data></frame></data>";
  const Profile profile = readText(
      replaced(replaced(exampleXml(), "<frame_count>2", "<frame_count>5"), "</data>", frames));
  ASSERT_EQ(profile.numFrames(), 5u);
  EXPECT_EQ(profile.frameTimeUs(2), 1'400'000'000'033'000);
  EXPECT_EQ(profile.frameTimeUs(3), 1'400'000'000'034'000);
  EXPECT_EQ(profile.frameTimeUs(4), 1'400'000'000'064'000);
  ASSERT_EQ(profile.info().warnings.size(), 1u);
  EXPECT_EQ(profile.info().warnings[0].substr(0, 24), "2 time stamps of \"frame\"");
}

TEST(DsaReader, theErrorSaysFrameAndByte) {
  const std::string text = replaced(exampleXml(), "C0C00000", "C9742400");
  try {
    readText(compressed(text));
    FAIL();
  } catch (const FormatError& error) {
    const std::size_t place = text.find("C9742400");
    ASSERT_TRUE(error.offset());
    EXPECT_GE(*error.offset(), place);
    EXPECT_LE(*error.offset(), place + 8);
    EXPECT_EQ(std::string(error.what()),
              "test.dsa: frame 0: a run of 1000000 zeros does not fit (0 of 6 values so far) (at "
              "byte " +
                  std::to_string(*error.offset()) + ")");
  }
}

TEST(DsaReader, damagedDataIsBlamedRatherThanTheNonsenseItMakes) {
  // Wrong values come out before the block's checksum: the message names the damage all the same.
  std::string packed = compressed(testing::longXml(20, 0, 3));
  packed[packed.size() / 2] = static_cast<char>(packed[packed.size() / 2] ^ 0x40);
  try {
    readText(packed);
    FAIL();
  } catch (const FormatError& error) {
    EXPECT_NE(std::string(error.what()).find("bzip2 data is damaged"), std::string::npos)
        << error.what();
  }
}

TEST(DsaReader, reportsProgressAndStopsWhenAsked) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "long.dsa", compressed(testing::longXml(800, 0, 1)));  // 3 MB of XML
  std::vector<double> fractions;
  readDsa(folder / "long.dsa", [&](double fraction) {
    fractions.push_back(fraction);
    return true;
  });
  EXPECT_GE(fractions.size(), 4u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1.0);
  int calls = 0;
  EXPECT_THROW(readDsa(folder / "long.dsa", [&](double) { return ++calls < 3; }), Cancelled);
  EXPECT_EQ(calls, 3);
}

TEST(DsaReader, boundsAreOptions) {
  const std::string packed = compressed(testing::longXml(300, 0, 1));
  DsaReadOptions options;
  options.freeBytes = 100'000;
  options.maxRatio = 1.0;
  EXPECT_THROW(readText(packed, options), FormatError);
  options.maxRatio = 100.0;
  EXPECT_EQ(readText(packed, options).numFrames(), 300u);
  options = {};
  options.maxPlaces = 5;
  EXPECT_THROW(readText(exampleXml(), options), FormatError);
}

}  // namespace
}  // namespace palpate::dsa_reader_test
