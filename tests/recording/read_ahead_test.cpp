// Recordings read several at a time: results, failures and cancellation in order, as if they were
// read one after the other.
#include "palpate/recording/read_ahead.h"

#include <atomic>
#include <string>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/recording/recording.h"

#include "recording/dsa_corpus.h"
#include "testing/process_facts.h"
#include "testing/testing.h"

namespace palpate::read_ahead_test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> makeFiles(const testing::TemporaryFolder& folder, std::size_t count) {
  const std::string small = testing::compressed(testing::exampleXml());
  std::vector<fs::path> files;
  for (std::size_t i = 0; i < count; ++i) {
    files.push_back(folder / (std::to_string(i) + ".dsa"));
    testing::writeFile(files.back(), small);
  }
  return files;
}

std::string nameOf(const fs::path& file, const Progress&, std::size_t) {
  return file.filename().string();
}

TEST(ReadAhead, handsOutInOrderWithAnyNumberOfThreads) {
  const testing::TemporaryFolder folder;
  const std::vector<fs::path> files = makeFiles(folder, 50);
  for (const std::size_t threads : {0u, 1u, 2u, 64u}) {
    ReadAhead<std::string> names(files, &nameOf, threads);
    for (const fs::path& file : files) EXPECT_EQ(names.take({}), file.filename().string());
  }
}

TEST(ReadAhead, leavesLargeAndNativeRecordingsForTheirTurn) {
  const testing::TemporaryFolder folder;
  std::vector<fs::path> files = makeFiles(folder, 6);
  testing::writeFile(files[2], std::string(kReadAheadBytes + 1, 'x'));
  files[4].replace_extension(".palpate");
  testing::writeFile(files[4], "x");
  const auto numThreads = [](const fs::path&, const Progress&, std::size_t threads) {
    return threads;
  };
  ReadAhead<std::size_t> read(files, numThreads, 3);
  std::vector<std::size_t> threads;
  for (std::size_t i = 0; i < files.size(); ++i) threads.push_back(read.take({}));
  EXPECT_EQ(threads, (std::vector<std::size_t>{1, 1, 0, 1, 0, 1}));
}

TEST(ReadAhead, aFailureBelongsToItsFile) {
  const testing::TemporaryFolder folder;
  const std::vector<fs::path> files = makeFiles(folder, 5);
  testing::writeFile(files[1], "no recording");
  fs::remove(files[3]);
  ReadAhead<Profile> profiles(files, &openRecording, 2);
  EXPECT_EQ(profiles.take({}).numFrames(), 2u);
  EXPECT_THROW(profiles.take({}), FormatError);
  EXPECT_EQ(profiles.take({}).numFrames(), 2u);
  EXPECT_THROW(profiles.take({}), FileError);
  EXPECT_EQ(profiles.take({}).numFrames(), 2u);
}

TEST(ReadAhead, readsABoundedNumberAhead) {
  const testing::TemporaryFolder folder;
  const std::vector<fs::path> files = makeFiles(folder, 100);
  std::atomic<std::size_t> begun = 0;
  const auto count = [&](const fs::path&, const Progress&, std::size_t) { return ++begun; };
  ReadAhead<std::size_t> read(files, count, 2);
  for (std::size_t taken = 1; taken <= 20; ++taken) {
    read.take({});
    EXPECT_LE(begun.load(), taken + 8);
  }
}

TEST(ReadAhead, isCancelledByProgressAndEndsItsThreads) {
  const testing::TemporaryFolder folder;
  const std::vector<fs::path> files = makeFiles(folder, 40);
  const std::size_t before = testing::leastProcessFacts().threads;
  {
    ReadAhead<Profile> profiles(files, &openRecording, 4);
    EXPECT_EQ(profiles.take({}).numFrames(), 2u);
    EXPECT_THROW(profiles.take([](double) { return false; }), Cancelled);
  }
  EXPECT_EQ(testing::leastProcessFacts().threads, before);
}

TEST(ReadAhead, whatIsBeingReadIsCancelledAtTheEnd) {
  const testing::TemporaryFolder folder;
  const std::vector<fs::path> files = makeFiles(folder, 4);
  const auto waitForEnd = [](const fs::path&, const Progress& progress, std::size_t threads) {
    while (threads == 1 && progress(0.5)) std::this_thread::yield();
    return 0;
  };
  const ReadAhead<int> read(files, waitForEnd, 2);  // its destructor returns
}

}  // namespace
}  // namespace palpate::read_ahead_test
