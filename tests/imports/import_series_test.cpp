#include <cmath>

#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/table_export.h"

#include "imports/import_samples.h"

namespace palpate::import_series_test {
namespace {

using testing::Imported;
using testing::importText;
using testing::pad;
using testing::TemporaryFolder;

constexpr const char* kPad = "time_ms,p0,p1\n0,1,2\n10,3,4\n20,5,6\n30,7,8\n";
constexpr const char* kDatedPad =
    "time_ms,p0,p1\n1700000000000,1,2\n1700000000010,3,4\n1700000000020,5,6\n";

// A pad's table with others beside it.
Imported importWith(const TemporaryFolder& folder,
                    const std::string& text,
                    const std::vector<std::pair<std::string, std::string>>& files,
                    std::optional<double> rateHz = std::nullopt,
                    const ImportMapping& mapping = {}) {
  ImportOptions options{.overwrite = Overwrite::kReplace};
  for (const auto& [name, table] : files) {
    testing::writeFile(folder / (name + ".csv"), table);
    options.series.push_back({name, folder / (name + ".csv"), rateHz});
  }
  return importText(folder, text, pad(1, 2), mapping, options);
}

// "0: 1 nan; 10000: 2 3".
std::string samplesText(const Profile& profile, std::size_t series = kHandSeries) {
  std::string text;
  for (std::size_t i = 0; i < profile.numSamples(series); ++i) {
    text += (i > 0 ? "; " : "") + std::to_string(profile.sampleTimeUs(series, i)) + ":";
    for (const double value : profile.sample(series, i).values)
      text += std::isnan(value) ? " nan" : " " + std::to_string(std::lround(value));
  }
  return text;
}

bool hasText(const std::vector<std::string>& texts, const std::string& words) {
  return std::any_of(texts.begin(), texts.end(), [&](const std::string& text) {
    return text.find(words) != std::string::npos;
  });
}

TEST(ImportSeries, WhatIsNoNumberIsMissingAndARowWithoutAnyHasNoSample) {
  const TemporaryFolder folder;
  const std::string text =
      "time_ms,p0,p1,fx [N],fz [N],note\n0,1,2,10,20,a\n10,1,2,,21,b\n20,1,2,oops,nan,c\n"
      "30,1,2,inf,24,d\n40,1,2,15,25,e\n";
  const Imported made = importText(folder, text, pad(1, 2));
  ASSERT_EQ(made.report.series.size(), 1u);
  EXPECT_EQ(made.report.series[0].text(),
            "series wrench: 2 columns (fx [N], fz [N]), 4 samples, 75.0 Hz");
  EXPECT_EQ(made.profile.numFrames(), 5u);
  EXPECT_EQ(made.report.refused.total(), 0u);
  EXPECT_EQ(made.profile.series().back().source, "import table.csv");
  EXPECT_EQ(samplesText(made.profile), "0: 10 20; 10000: nan 21; 30000: nan 24; 40000: 15 25");
  EXPECT_EQ(made.report.notNumbers.count, 2u);
  EXPECT_TRUE(made.report.isPartial());
  EXPECT_NE(made.report.lossText().find("2 cells of series are not numbers; the first: line 4"),
            std::string::npos)
      << made.report.lossText();
  EXPECT_NE(testing::errorOf([&] {
              importText(
                  folder, text, pad(1, 2), {}, {.strict = true, .overwrite = Overwrite::kReplace});
            }).find("is not a number"),
            std::string::npos);
}

TEST(ImportSeries, AColumnWithoutANumberStaysOut) {
  const TemporaryFolder folder;
  const Imported made =
      importText(folder, "time_ms,p0,p1,load,empty\n0,1,2,,\n10,1,2,7,\n20,1,2,8,\n", pad(1, 2));
  EXPECT_EQ(samplesText(made.profile), "10000: 7; 20000: 8");
  EXPECT_TRUE(hasText(made.report.notes, "not used: empty"));
  EXPECT_FALSE(made.report.isPartial());
}

TEST(ImportSeries, OtherTablesHaveTimesOfTheirOwn) {
  const TemporaryFolder folder;
  const Imported made = importWith(
      folder,
      kPad,
      {{"wrench", "t_ms,fx,fz\n5,1,2\n6,3,4\n7,5,6\n"}, {"trigger", "t_s,on\n0.02,1\n"}});
  EXPECT_EQ(made.profile.numFrames(), 4u);
  EXPECT_EQ(samplesText(made.profile), "5000: 1 2; 6000: 3 4; 7000: 5 6");
  EXPECT_EQ(samplesText(made.profile, kHandSeries + 1), "20000: 1");
  EXPECT_EQ(made.profile.series()[kHandSeries].source, "import wrench.csv");
  EXPECT_TRUE(hasText(made.report.notes, "series wrench: its times are taken to count from the"));
  EXPECT_FALSE(made.report.isPartial()) << made.report.lossText();
  // A first column that counts is none of the times where there is one.
  const Imported counting = importWith(folder, kPad, {{"load", "t_ms,n\n0,0\n5,1\n10,2\n"}});
  EXPECT_EQ(samplesText(counting.profile), "0: 0; 5000: 1; 10000: 2");
  // Without names, as a probe writes it.
  const Imported bare =
      importWith(folder, kDatedPad, {{"probe", "1700000000.005,1,9\n1700000000.006,1,8\n"}});
  EXPECT_EQ(samplesText(bare.profile), "1700000000005000: 1 9; 1700000000006000: 1 8");
  EXPECT_TRUE(hasText(bare.report.notes, "series probe: its times are dates, as those of"));
}

TEST(ImportSeries, RowsAreSortedAndOfOneTimeTheFirstIsKept) {
  const TemporaryFolder folder;
  const Imported made = importWith(folder, kPad, {{"force", "t_ms,fx\n20,3\n10,1\n10,2\n30,4\n"}});
  EXPECT_EQ(samplesText(made.profile), "10000: 1; 20000: 3; 30000: 4");
  EXPECT_TRUE(hasText(made.report.notes, "series force: the rows are not in order of time"));
  EXPECT_EQ(made.report.refused.notLater, 1u);
  EXPECT_NE(made.report.refused.first.find("force.csv, line 4"), std::string::npos)
      << made.report.refused.first;
}

TEST(ImportSeries, TimesOfAnotherKindAreSaid) {
  const TemporaryFolder folder;
  const Imported mixed = importWith(folder, kDatedPad, {{"force", "t_ms,fx\n100,1\n110,2\n"}});
  EXPECT_EQ(samplesText(mixed.profile), "1700000000000000: 1; 1700000000010000: 2");
  EXPECT_TRUE(hasText(mixed.report.doubts, "its first row is taken to be at the first frame"));
  const Imported apart = importWith(folder, kPad, {{"force", "t_ms,fx\n5000,1\n5010,2\n"}});
  EXPECT_TRUE(hasText(apart.report.doubts, "all of it is 4.970 s after the last frame"));
  // The date of the first row counts for both.
  ImportMapping mapping;
  mapping.time.startUs = 1'700'000'000'000'000;
  const Imported dated =
      importWith(folder, kPad, {{"force", "t_ms,fx\n5,1\n15,2\n"}}, std::nullopt, mapping);
  EXPECT_EQ(samplesText(dated.profile), "1700000000005000: 1; 1700000000015000: 2");
  EXPECT_FALSE(dated.report.isPartial()) << dated.report.lossText();
}

TEST(ImportSeries, ATableWithoutTimesNeedsARate) {
  const TemporaryFolder folder;
  const std::string table = "fx,fz\n5,1\n4,1\n6,2\n";
  EXPECT_NE(testing::errorOf([&] {
              importWith(folder, kPad, {{"force", table}});
            }).find("give the rate of its rows (--series-rate force=HZ)"),
            std::string::npos);
  EXPECT_NE(testing::errorOf([&] {
              importWith(folder, kPad, {{"force", "t,fx\n0,5\n1,4\n2,6\n"}});
            }).find("give the rate of the rows (--series-rate force=HZ)"),
            std::string::npos);
  const Imported made = importWith(folder, kDatedPad, {{"force", table}}, 200.0);
  EXPECT_EQ(samplesText(made.profile),
            "1700000000000000: 5 1; 1700000000005000: 4 1; 1700000000010000: 6 2");
  EXPECT_FALSE(made.report.isPartial());
}

TEST(ImportSeries, NamesThatCannotBeAreRefused) {
  const TemporaryFolder folder;
  const std::string table = "t_ms,fx\n5,1\n6,2\n";
  for (const auto& [name, words] : std::vector<std::pair<std::string, std::string>>{
           {"Wrist", "\"wrist\" would be one"}, {"angles", "the name is taken"}})
    EXPECT_NE(testing::errorOf([&, &name = name] {
                importWith(folder, kPad, {{name, table}});
              }).find(words),
              std::string::npos)
        << name;
  EXPECT_NE(testing::errorOf([&] {
              importWith(folder, kPad, {{"a", table}, {"a", table}});
            }).find("the name is taken"),
            std::string::npos);
  // A series of the table makes room for it.
  const Imported made = importWith(
      folder, "time_ms,p0,p1,fx,fz\n0,1,2,3,4\n10,1,2,3,4\n", {{"wrench", "t_ms,a\n5,1\n6,2\n"}});
  EXPECT_EQ(made.profile.series()[kHandSeries].name, "wrench_2");
  EXPECT_EQ(made.profile.series()[kHandSeries + 1].name, "wrench");
}

TEST(ImportSeries, ArraysOfAFileAreOneSeries) {
  const TemporaryFolder folder;
  testing::runPython(folder, R"(
import sys, numpy as np
folder = sys.argv[1] + '/'
time = np.arange(6) * 0.005
np.savez(folder + 'ft.npz', time_s=time, force=np.arange(18).reshape(6, 3), note=np.zeros(2))
np.save(folder + 'ft.npy', np.column_stack([1700000000 + time, np.arange(6), np.arange(6)]))
)");
  testing::writeFile(folder / "pad.csv", kPad);
  const auto import = [&](const char* file) {
    ImportOptions options{.overwrite = Overwrite::kReplace};
    options.series = {{"ft", folder / file, std::nullopt}};
    importRecording(folder / "pad.csv", pad(1, 2), {}, folder / "o.palpate", options);
    return openRecording(folder / "o.palpate");
  };
  const Profile arrays = import("ft.npz");
  EXPECT_EQ(arrays.series().back().columns, (std::vector<Column>{{"0", ""}, {"1", ""}, {"2", ""}}));
  EXPECT_EQ(arrays.sampleTimeUs(kHandSeries, 5), 25'000);
  EXPECT_EQ(arrays.sample(kHandSeries, 1).values, (std::vector<double>{3, 4, 5}));
  const Profile within = import("ft.npy");
  EXPECT_EQ(within.numSamples(kHandSeries), 6u);
  EXPECT_EQ(within.sample(kHandSeries, 2).values, (std::vector<double>{2, 2}));
}

// A magnetic skin, and the load of the probe that pressed it in another file.
TEST(ImportSeries, TheProbeOfEfleshComesAlong) {
  const auto arrays = testing::arraysFolder();
  if (!arrays) GTEST_SKIP() << "no files of other makers: set PALPATE_ARRAYS";
  const std::filesystem::path eflesh = *arrays / "eflesh";
  const TemporaryFolder folder;
  ImportOptions options;
  options.series = {{"probe", eflesh / "normal_force_states.csv", std::nullopt}};
  const ImportReport report = importRecording(eflesh / "normal_force_sensor.csv",
                                              readHandFolder(eflesh / "hand"),
                                              {},
                                              folder / "o.palpate",
                                              options);
  const Profile profile = openRecording(folder / "o.palpate");
  EXPECT_EQ(profile.numFrames(), 3600u);
  ASSERT_EQ(profile.series().size(), kHandSeries + 1);
  EXPECT_EQ(profile.series().back().columns.size(), 4u);
  EXPECT_EQ(report.series[0].samples, profile.numSamples(kHandSeries));
  EXPECT_EQ(profile.sample(kHandSeries, 0).values, (std::vector<double>{315, -100, 288, 4.36}));
}

// What `palpate convert` writes to .csv comes back with its series, times and units.
TEST(ImportSeries, AnExportedListFindsItsSeries) {
  const TemporaryFolder folder;
  const HandDescription hand = pad(1, 2);
  ProfileBuilder builder(hand);
  const std::size_t wrist =
      builder.addSeries({"wrist", "", {{"fx", "N"}, {"mode", ""}}, "tcp:somewhere"});
  TactileFrame frame(hand.layout);
  for (int i = 0; i < 3; ++i) {
    frame.hostUs = 1'700'000'000'000'123 + i * 10'000;
    frame.values = {1.0F + static_cast<float>(i), 2.0F};
    builder.addFrame(frame);
    for (int k = 0; k < 2; ++k)
      builder.addSample(wrist,
                        frame.hostUs + k * 4'001,
                        std::vector<double>{k == 1 ? std::nan("") : -1.5 * i, 7.0});
  }
  const Profile exported = builder.finish({});
  writeCsv(exported, folder / "X.csv");
  testing::writeFile(folder / "X.csv.notes.csv", "a,b\n1,2\n");  // something else
  testing::writeFile(folder / "X.csv.Bad.csv", "sample,time_ms,fx_N,time_us\n0,1,2,1000\n");
  const auto imported = [&](const std::vector<SeriesFile>& series) {
    importRecording(folder / "X.csv",
                    hand,
                    {},
                    folder / "out.palpate",
                    {.series = series, .overwrite = Overwrite::kReplace});
    return openRecording(folder / "out.palpate");
  };
  const Profile back = imported({});
  ASSERT_EQ(back.series().size(), kHandSeries + 1);
  EXPECT_EQ(back.series().back().name, "wrist");
  EXPECT_EQ(back.series().back().columns, (std::vector<Column>{{"fx", "N"}, {"mode", ""}}));
  ASSERT_EQ(back.numSamples(kHandSeries), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const Sample before = exported.sample(wrist, i), now = back.sample(kHandSeries, i);
    EXPECT_EQ(now.hostUs, before.hostUs);
    EXPECT_EQ(std::isnan(now.values[0]), std::isnan(before.values[0]));
    if (!std::isnan(now.values[0])) {
      EXPECT_EQ(now.values[0], before.values[0]);
    }
    EXPECT_EQ(now.values[1], 7.0);
  }
  // A file that is named goes before.
  testing::writeFile(folder / "other.csv", "time_us,f_N\n1700000000000123,1\n1700000000010123,2\n");
  const Profile named = imported({{"wrist", folder / "other.csv", std::nullopt}});
  ASSERT_EQ(named.series().size(), kHandSeries + 1);
  EXPECT_EQ(named.numSamples(kHandSeries), 2u);
}

}  // namespace
}  // namespace palpate::import_series_test
