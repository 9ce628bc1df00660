// Folders are gone through beside the window: in portions, to be given up at any moment, whatever
// hangs.
#include "gui/library/library_scanner.h"

#include <QSignalSpy>
#include <QTest>
#include <atomic>
#include <condition_variable>
#include <mutex>

#include <palpate/core/error.h>

#include "testing/testing.h"

namespace palpate::gui::library_scanner_test {
namespace {

// A folder that hangs until it is let go.
class Gate {
 public:
  void pass() {
    std::unique_lock lock(mutex_);
    ++waiting_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return open_; });
    ++passed_;
    changed_.notify_all();
  }
  // Until so many have come here so far.
  void waitFor(int count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return waiting_ >= count; });
  }
  void open() {
    std::unique_lock lock(mutex_);
    open_ = true;
    changed_.notify_all();
    changed_.wait(lock, [this] { return passed_ == waiting_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool open_ = false;
  int waiting_ = 0;
  int passed_ = 0;
};

RecordingDetails details(int number) {
  RecordingDetails made;
  made.path = "/folder/f" + std::to_string(number) + ".dsa";
  return made;
}

LibraryScanner::Catalog catalogOf(int count) {
  return [count](const auto&, const auto&, const CatalogSink& sink, const Progress& progress) {
    CatalogReport report;
    report.numFiles = static_cast<std::size_t>(count);
    sink.listed(report.numFiles);
    for (int i = 0; i < count; ++i) {
      if (!progress(static_cast<double>(i) / count)) throw Cancelled();
      sink.take(details(i));
    }
    return report;
  };
}

class LibraryScannerTest : public ::testing::Test {
 protected:
  void hear(LibraryScanner& scanner) {
    QObject::connect(&scanner, &LibraryScanner::found, [this](const auto& entries) {
      largest_ = std::max(largest_, entries.size());
      for (const LibraryEntry& entry : entries) paths_.push_back(entry.details.path.string());
    });
    QObject::connect(&scanner, &LibraryScanner::finished, [this] { ++finished_; });
    QObject::connect(&scanner, &LibraryScanner::cancelled, [this] { ++cancelled_; });
    QObject::connect(
        &scanner, &LibraryScanner::failed, [this](const QString& message) { failure_ = message; });
  }
  std::vector<std::string> paths_;
  std::size_t largest_ = 0;
  int finished_ = 0, cancelled_ = 0;
  QString failure_;
};

TEST_F(LibraryScannerTest, EverythingComesInOrderAndInPortions) {
  LibraryScanner scanner("", catalogOf(5000));
  hear(scanner);
  scanner.scan("/folder");
  EXPECT_TRUE(scanner.busy());
  ASSERT_TRUE(QTest::qWaitFor([&] { return finished_ > 0; }, 10000));
  EXPECT_FALSE(scanner.busy());
  ASSERT_EQ(paths_.size(), 5000u);
  for (int i = 0; i < 5000; ++i)
    ASSERT_EQ(paths_[static_cast<std::size_t>(i)], details(i).path.string());
  EXPECT_LE(largest_, 200u) << "more would stop the window";
}

TEST(CaseFolding, IsThatOfUnicode) {
  EXPECT_EQ(caseFolded("AbZ 09_[`"), "abz 09_[`");
  // ÀÞ× ŁŹ ΑΩ АЯЁ (Unicode CaseFolding.txt)
  EXPECT_EQ(caseFolded("\xC3\x80\xC3\x9E\xC3\x97 \xC5\x81\xC5\xB9 \xCE\x91\xCE\xA9 "
                       "\xD0\x90\xD0\xAF\xD0\x81"),
            "\xC3\xA0\xC3\xBE\xC3\x97 \xC5\x82\xC5\xBA \xCE\xB1\xCF\x89 "
            "\xD0\xB0\xD1\x8F\xD1\x91");
  EXPECT_EQ(caseFolded("\xE2\x82\xAC \xF0\x9F\x98\x80"), "\xE2\x82\xAC \xF0\x9F\x98\x80");
  EXPECT_EQ(caseFolded("\xD4\xB1"), "\xD5\xA1");    // Armenian: beyond the usual scripts too
  EXPECT_EQ(caseFolded("a\xFF"), "a\xEF\xBF\xBD");  // no UTF-8
  RecordingDetails recording;
  recording.operatorName = "J\xC3\x96RG";  // JÖRG
  EXPECT_TRUE(RecordingSearch("operator:j\xC3\xB6rg", caseFolded)
                  .matches(searchableText(recording, "/data", caseFolded)));
}

TEST_F(LibraryScannerTest, WhatIsSearchedInIsMadeBesideTheWindow) {
  LibraryScanner scanner("", catalogOf(1));
  SearchableText text;
  QObject::connect(
      &scanner, &LibraryScanner::found, [&](const auto& entries) { text = entries.front().text; });
  hear(scanner);
  scanner.scan("/folder");
  ASSERT_TRUE(QTest::qWaitFor([&] { return finished_ > 0; }, 10000));
  EXPECT_TRUE(RecordingSearch("NAME:F0.dsa", caseFolded).matches(text));
}

TEST_F(LibraryScannerTest, CancelledOnceAndNothingMoreIsHeard) {
  Gate gate;
  std::atomic<bool> sawCancel = false;
  {
    LibraryScanner scanner("",
                           [&](const auto&, const auto&, const auto& sink, const auto& progress) {
                             sink.take(details(1));
                             gate.pass();
                             sawCancel = !progress(0.5);
                             sink.take(details(2));
                             throw Cancelled();
                             return CatalogReport{};
                           });
    hear(scanner);
    scanner.scan("/folder");
    gate.waitFor(1);
    scanner.cancel();
    EXPECT_FALSE(scanner.busy());
    EXPECT_EQ(cancelled_, 1);
    scanner.cancel();
    EXPECT_EQ(cancelled_, 1);
    gate.open();
    QTest::qWait(20);
    EXPECT_TRUE(paths_.empty());
    EXPECT_EQ(finished_, 0);
  }
  EXPECT_TRUE(QTest::qWaitFor([&] { return sawCancel.load(); }, 5000));
}

TEST_F(LibraryScannerTest, AFolderThatHangsHoldsUpNoOtherAndNoEnd) {
  Gate gate;
  {
    LibraryScanner scanner(
        "", [&](const auto& folder, const auto& cache, const auto& sink, const auto& progress) {
          if (folder == "/hangs") gate.pass();
          return catalogOf(3)(folder, cache, sink, progress);
        });
    hear(scanner);
    scanner.scan("/hangs");
    gate.waitFor(1);
    scanner.scan("/folder");
    ASSERT_TRUE(QTest::qWaitFor([&] { return finished_ > 0; }, 10000));
    EXPECT_EQ(paths_.size(), 3u);
    scanner.scan("/hangs");
    gate.waitFor(2);
  }  // after a moment it is given up
  gate.open();
  EXPECT_EQ(finished_, 1);
}

TEST_F(LibraryScannerTest, AFailureIsSaid) {
  LibraryScanner scanner("",
                         [](const auto&, const auto&, const auto&, const auto&) -> CatalogReport {
                           throw Error("the disk is on fire");
                         });
  hear(scanner);
  scanner.scan("/folder");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !failure_.isEmpty(); }, 10000));
  EXPECT_EQ(failure_, "the disk is on fire");
  EXPECT_FALSE(scanner.busy());
}

}  // namespace
}  // namespace palpate::gui::library_scanner_test
