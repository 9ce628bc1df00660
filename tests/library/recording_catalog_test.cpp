// A folder of recordings, gone through again and again: what is read anew, what comes from the
// cache.
#include "palpate/library/recording_catalog.h"

#include <algorithm>
#include <set>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/recording/event_store.h"
#include "palpate/recording/recording.h"

#include "recording/palpate_samples.h"
#include "testing/testing.h"

namespace palpate::recording_catalog_test {
namespace {
namespace fs = std::filesystem;
using namespace testing;

struct Scan {
  CatalogReport report;
  std::vector<RecordingDetails> details;
  std::size_t listed = 0;
};

Scan scan(const fs::path& folder, const fs::path& cache, const Progress& progress = {}) {
  Scan scan;
  CatalogSink sink;
  sink.listed = [&](std::size_t numFiles) { scan.listed = numFiles; };
  sink.take = [&](RecordingDetails&& details) { scan.details.push_back(std::move(details)); };
  scan.report = catalogRecordings(folder, cache, sink, progress);
  return scan;
}

class RecordingCatalog : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(recordings / "sub");
    writeSamples(recordings / "a.palpate", 20);
    const Profile profile = openRecording(recordings / "a.palpate");
    saveRecording(profile, {}, recordings / "b.dsa");
    saveRecording(profile, {}, recordings / "sub/c.dsa");
    writeFile(recordings / "sub/bad.dsa", "nonsense");
  }
  Scan scanAll(const Progress& progress = {}) { return scan(recordings, cache, progress); }

  TemporaryFolder folder;
  const fs::path recordings = folder / "recordings";
  const fs::path cache = folder / "state/cache";
};

bool sameContent(std::vector<RecordingDetails> a, std::vector<RecordingDetails> b) {
  const auto byPath = [](const auto& x, const auto& y) { return x.path < y.path; };
  std::sort(a.begin(), a.end(), byPath);
  std::sort(b.begin(), b.end(), byPath);
  return a == b;
}

TEST_F(RecordingCatalog, theSecondTimeNothingIsReadAndNothingIsDifferent) {
  const Scan first = scanAll();
  EXPECT_EQ(first.listed, 4u);
  EXPECT_EQ(first.report.numRead, 4u);
  EXPECT_EQ(first.report.folders.size(), 2u);
  EXPECT_EQ(first.report.cacheProblem, "");
  ASSERT_EQ(first.details.size(), 4u);
  for (const RecordingDetails& details : first.details) {
    const RecordingDetails alone = readDetails(details.path);
    EXPECT_TRUE(details == alone) << details.path;
  }
  const Scan second = scanAll();
  EXPECT_EQ(second.report.numRead, 0u);
  EXPECT_TRUE(sameContent(first.details, second.details));
  // By another way to the same folder the same cache is found.
  fs::create_directory_symlink(recordings, folder / "link");
  const Scan linked = scan(folder / "link", cache);
  EXPECT_EQ(linked.report.numRead, 0u);
  EXPECT_EQ(linked.details.size(), 4u);
  EXPECT_TRUE(linked.details[0].path.native().starts_with((folder / "link").native()));
}

TEST_F(RecordingCatalog, onlyWhatChangedIsReadAgain) {
  scanAll();
  saveEvents(recordings / "b.dsa", {}, std::vector{Event{5, 5, "label", {}, "new", ""}});
  Scan now = scanAll();
  EXPECT_EQ(now.report.numRead, 1u);
  EXPECT_EQ(now.details.back().labels, std::vector<std::string>{"new"});

  const EventsReport asRead = readEvents(recordings / "a.palpate");
  std::vector<Event> events = asRead.events;
  events.push_back({6, 6, "label", {}, "newer", ""});
  saveEvents(recordings / "a.palpate", asRead, events);
  now = scanAll();
  EXPECT_EQ(now.report.numRead, 1u);
  EXPECT_EQ(now.details.back().labels, (std::vector<std::string>{"newer", "f\xC3\xBCr"}));

  fs::remove(recordings / "sub/bad.dsa");
  fs::copy_file(recordings / "b.dsa", recordings / "sub/d.dsa");
  now = scanAll();
  EXPECT_EQ(now.report.numRead, 1u);
  EXPECT_EQ(now.details.size(), 4u);
  EXPECT_EQ(scanAll().report.numRead, 0u);
}

TEST_F(RecordingCatalog, aRecordingInProgressIsLookedAtEveryTime) {
  PalpateWriter writer(recordings / "now.palpate", sdh2().layout);
  addSamples(writer, 0, 10);
  writer.commit();
  for (int round = 0; round < 2; ++round) {
    scanAll();
    EXPECT_EQ(scanAll().report.numRead, 1u);
  }
  writer.finish();
  EXPECT_EQ(scanAll().details.back().state, RecordingDetails::State::kFinished);
  EXPECT_EQ(scanAll().report.numRead, 0u);
}

TEST_F(RecordingCatalog, aBadCacheIsMadeAnew) {
  const Scan first = scanAll();
  const fs::path file = catalogCachePath(recordings, cache);
  ASSERT_TRUE(fs::exists(file));
  const std::string good = readFile(file);
  std::string older = good;
  older.replace(older.find("\"version\":2"), 11, "\"version\":1");
  std::string absurd = good;
  absurd.replace(absurd.find("\"frames\":20"), 11, "\"frames\":{}");
  for (const std::string& bad : {std::string(),
                                 std::string("nonsense"),
                                 std::string("[]"),
                                 std::string("{\"recordings\":3}"),
                                 good.substr(0, good.size() / 2),
                                 older,
                                 absurd}) {
    writeFile(file, bad);
    const Scan again = scanAll();
    EXPECT_EQ(again.report.numRead, 4u) << bad.substr(0, 100);
    EXPECT_TRUE(sameContent(first.details, again.details));
    EXPECT_EQ(scanAll().report.numRead, 0u);
  }
}

TEST_F(RecordingCatalog, whereNothingCanBeKeptItIsSaidAndAllIsRead) {
  writeFile(folder / "file", "x");
  const Scan now = scan(recordings, folder / "file/cache");
  EXPECT_EQ(now.details.size(), 4u);
  EXPECT_NE(now.report.cacheProblem, "");
  const Scan without = scan(recordings, {});
  EXPECT_EQ(without.details.size(), 4u);
  EXPECT_EQ(without.report.cacheProblem, "");
}

TEST_F(RecordingCatalog, whatWasReadBeforeACancelIsKept) {
  std::set<fs::path> seen;
  CatalogSink sink;
  sink.take = [&](RecordingDetails&& details) { seen.insert(details.path); };
  EXPECT_THROW(catalogRecordings(recordings, cache, sink, [&](double) { return seen.size() < 2; }),
               Cancelled);
  EXPECT_EQ(seen.size(), 2u);
  EXPECT_EQ(scanAll().report.numRead, 2u);
}

TEST_F(RecordingCatalog, progressGoesUpToTheEnd) {
  std::vector<double> fractions;
  scanAll([&](double fraction) {
    fractions.push_back(fraction);
    return true;
  });
  ASSERT_FALSE(fractions.empty());
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0.0);
  EXPECT_LE(fractions.back(), 1.0);
  EXPECT_GT(fractions.back(), 0.5);
}

TEST_F(RecordingCatalog, foldersOfNothingAndFoldersThatArentThere) {
  fs::create_directory(folder / "empty");
  EXPECT_EQ(scan(folder / "empty", cache).details.size(), 0u);
  const Scan missing = scan(folder / "missing", cache);
  EXPECT_EQ(missing.details.size(), 0u);
  EXPECT_EQ(missing.report.problems.size(), 1u);
}

TEST_F(RecordingCatalog, thousandsOfFiles) {
  fs::create_directory(folder / "many");
  constexpr std::size_t kFiles = 5000;
  for (std::size_t i = 0; i < kFiles; ++i)
    writeFile(folder / "many" / fs::path("f" + std::to_string(i) + ".dsa"), "nonsense");
  EXPECT_EQ(scan(folder / "many", cache).details.size(), kFiles);
  const Scan again = scan(folder / "many", cache);
  EXPECT_EQ(again.details.size(), kFiles);
  EXPECT_EQ(again.report.numRead, 0u);
}

TEST(RecordingCatalogReal, everySharedRecordingIsListedAsItIs) {
  const auto recordings = recordingsFolder();
  PALPATE_NEED(recordings);
  const TemporaryFolder cache;
  std::size_t files = 0;  // counted by another way
  for (const auto& entry : fs::recursive_directory_iterator(*recordings))
    files += entry.path().extension() == ".dsa" ? 1u : 0u;
  const fs::path one = *recordings / "grasps_by_class";
  const Scan first = scan(one, cache.path());
  ASSERT_GT(first.details.size(), 100u);
  ASSERT_LT(first.details.size(), files);
  for (const RecordingDetails& details : first.details) {
    EXPECT_EQ(details.state, RecordingDetails::State::kFinished) << details.path;
    EXPECT_GT(details.numFrames.value_or(0), 0) << details.path;
    // Recorded between 2012 and 2016.
    EXPECT_GT(details.startUs.value_or(0), 1'325'376'000'000'000) << details.path;
    EXPECT_LT(details.startUs.value_or(0), 1'483'228'800'000'000) << details.path;
  }
  EXPECT_EQ(scan(one, cache.path()).report.numRead, 0u);
}

}  // namespace
}  // namespace palpate::recording_catalog_test
