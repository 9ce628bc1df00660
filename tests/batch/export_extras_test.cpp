#include "palpate/batch/export_extras.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/core/hash.h"
#include "palpate/emulator/synthetic_profile.h"

#include "testing/testing.h"

namespace palpate::export_extras_test {
namespace {

Recipe median() {
  const std::vector<std::string> texts = {"median:size=3"};
  return parseRecipe(texts);
}

TEST(ExportExtras, SaysWhereAnExportComesFrom) {
  const testing::TemporaryFolder folder;
  const Profile profile = synthesize({.durationS = 2.0, .grasps = 1});
  const std::filesystem::path in = folder / "a.palpate";
  SaveExtras said;
  said.meta["operator"] = "A";
  saveRecording(profile, {}, in, Overwrite::kRefuse, {}, said);
  const SaveExtras all = exportExtras({}, in, "x.mat", profile, median());
  EXPECT_EQ(all.meta.at("operator"), "A");
  EXPECT_EQ(all.exported.provenance.sourceFile, "a.palpate");
  EXPECT_EQ(all.exported.provenance.sourceSha256, sha256OfFile(in));
  EXPECT_EQ(all.exported.provenance.filters, fullRecipeText(median()));
  EXPECT_EQ(all.exported.provenance.hand, profile.hand().name);
  ASSERT_EQ(all.exported.series.size(), 2u);
  EXPECT_EQ(all.exported.series[0]->name(), "signals");
  EXPECT_EQ(all.exported.series[1]->name(), "slip");
  const SaveExtras slip = exportExtras({.withSignals = false}, in, "x.h5", profile, {});
  ASSERT_EQ(slip.exported.series.size(), 1u);
  EXPECT_EQ(slip.exported.series[0]->name(), "slip");
  EXPECT_TRUE(exportExtras({}, in, "x.npz", profile, {}).exported.series.empty());
  EXPECT_TRUE(exportExtras({.unitsRow = true}, in, "x.csv", profile, {}).unitsRow);
}

// Core F6: 200 grasps of a recording hashed it 200 times.
TEST(ExportExtras, ASourceOfManyFilesIsReadOnce) {
  const testing::TemporaryFolder folder;
  const Profile profile = synthesize({.durationS = 1.0, .grasps = 0});
  const ExportSource source(folder / "a.palpate");
  SaveExtras said;
  said.meta["operator"] = "A";
  saveRecording(profile, {}, source.file(), Overwrite::kRefuse, {}, said);
  const SaveExtras first = exportExtras({}, source, "x.mcap", profile, {});
  std::filesystem::remove(source.file());
  const SaveExtras second = exportExtras({}, source, "y.mcap", profile, {});
  EXPECT_EQ(second.meta, first.meta);
  EXPECT_EQ(second.exported.provenance.sourceSha256, first.exported.provenance.sourceSha256);
  EXPECT_EQ(second.exported.provenance.sourceSha256.size(), 64u);
}

TEST(ExportExtras, RefusesWhatAFormCanNotHave) {
  EXPECT_NO_THROW(requirePossible({.unitsRow = true}, median(), "x.CSV"));
  EXPECT_THROW(requirePossible({.unitsRow = true}, {}, "x.npz"), std::invalid_argument);
  EXPECT_THROW(requirePossible({}, median(), "x.palpate"), std::invalid_argument);
  EXPECT_THROW(requirePossible({}, median(), "x.dsa"), std::invalid_argument);
  EXPECT_NO_THROW(requirePossible({}, {}, "x.dsa"));
  EXPECT_THROW(requirePossible({}, {}, "x.txt"), FileError);
}

}  // namespace
}  // namespace palpate::export_extras_test
