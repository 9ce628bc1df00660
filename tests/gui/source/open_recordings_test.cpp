// What files were asked for travels with them, however requests overlap.
#include "gui/source/open_recordings.h"

#include <QSignalSpy>
#include <string>
#include <utility>

#include <palpate/core/error.h>

#include "gui/testing/sample_profiles.h"
#include "testing/testing.h"

namespace palpate::gui::open_recordings_test {
namespace {

using Then = OpenRequest::Then;

class OpenRecordingsTest : public ::testing::Test {
 protected:
  OpenRecordingsTest() {
    QObject::connect(&open_,
                     &OpenRecordings::arrived,
                     &open_,
                     [this](const OpenedRecordingPtr& recording, const OpenArrival& arrival) {
                       heard_.push_back({recording->path.string(), arrival});
                       if (atArrival_) std::exchange(atArrival_, {})();
                     });
  }
  void wait() {
    QSignalSpy finished(&opener_, &RecordingOpener::finished);
    while (opener_.busy()) ASSERT_TRUE(finished.wait(10'000));
  }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& recording : open_.all()) names.push_back(recording->path.string());
    return names;
  }
  struct Heard {
    std::string name;
    OpenArrival arrival;
  };

  RecordingOpener opener_{[](const std::filesystem::path& path, const Progress&) {
    if (path.string().starts_with("bad")) throw FormatError(path, "is none", 0);
    return Recording{twentyFrames()};
  }};
  OpenRecordings open_{opener_};
  std::vector<Heard> heard_;
  std::function<void()> atArrival_;  // once
};

TEST_F(OpenRecordingsTest, TheFirstOfARequestIsTheFirstThatCanBeOpened) {
  open_.open({{"bad", "a", "b"}, Then::kPlayInLoop});
  wait();
  ASSERT_EQ(heard_.size(), 2u);
  EXPECT_EQ(heard_[0].name, "a");
  EXPECT_EQ(heard_[0].arrival.place, 0u);
  EXPECT_EQ(heard_[1].name, "b");
  EXPECT_EQ(heard_[1].arrival.place, 1u);
  EXPECT_EQ(heard_[1].arrival.then, Then::kPlayInLoop);
  EXPECT_EQ(names(), (std::vector<std::string>{"a", "b"}));
}

TEST_F(OpenRecordingsTest, ARequestWhileAnotherRunsIsItsOwn) {
  atArrival_ = [this] {
    open_.open({{"c"}, Then::kCompare});
    open_.open({{"d"}, Then::kList});
  };
  open_.open({{"a", "b"}, Then::kShowFirst});
  wait();
  ASSERT_EQ(heard_.size(), 4u);
  const std::vector<std::pair<Then, std::size_t>> expected{
      {Then::kShowFirst, 0}, {Then::kShowFirst, 1}, {Then::kCompare, 0}, {Then::kList, 0}};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(std::pair(heard_[i].arrival.then, heard_[i].arrival.place), expected[i])
        << heard_[i].name;
}

TEST_F(OpenRecordingsTest, OneThatWasGivenUpTakesNoOthersRequest) {
  atArrival_ = [this] {
    opener_.cancel();
    open_.open({{"c"}, Then::kCompare});
  };
  open_.open({{"a", "b"}, Then::kShowFirst});
  wait();
  ASSERT_EQ(heard_.size(), 2u);
  EXPECT_EQ(heard_[1].name, "c");
  EXPECT_EQ(heard_[1].arrival.then, Then::kCompare);
  EXPECT_EQ(heard_[1].arrival.place, 0u);
}

TEST_F(OpenRecordingsTest, AFileThatIsOpenIsReplacedInItsPlace) {
  open_.open({{"a", "b"}});
  wait();
  const OpenedRecordingPtr before = open_.at("a");
  open_.open({{"a"}});
  wait();
  EXPECT_EQ(names(), (std::vector<std::string>{"a", "b"}));
  EXPECT_NE(open_.at("a"), before);
  EXPECT_EQ(heard_.back().arrival.replaced, before);
}

TEST_F(OpenRecordingsTest, WhatMayNotBeReadAnewArrivesAsItIs) {
  open_.open({{"a"}});
  wait();
  const OpenedRecordingPtr before = open_.at("a");
  open_.mayReadAnew = [](const OpenedRecordingPtr&) { return false; };
  open_.open({{"a", "b"}});
  EXPECT_EQ(heard_.back().name, "a") << "at once";
  EXPECT_EQ(heard_.back().arrival.replaced, nullptr);
  wait();
  EXPECT_EQ(heard_.back().name, "b");
  EXPECT_EQ(heard_.back().arrival.place, 1u);
  EXPECT_EQ(open_.at("a"), before);
}

TEST_F(OpenRecordingsTest, WhatMayNotBeReplacedWhenItWasReadStaysAsItIs) {
  open_.open({{"a"}});
  wait();
  const OpenedRecordingPtr before = open_.at("a");
  open_.mayReplace = [](const OpenedRecordingPtr&) { return false; };
  open_.open({{"a"}});
  wait();
  EXPECT_EQ(open_.at("a"), before);
  EXPECT_EQ(heard_.size(), 2u);
  EXPECT_EQ(heard_.back().arrival.replaced, nullptr);
}

TEST_F(OpenRecordingsTest, WhatIsOpenArrivesAsItIsWhenTheRequestSaysSo) {
  open_.open({{"a"}});
  wait();
  const OpenedRecordingPtr before = open_.at("a");
  open_.mayReadAnew = [](const OpenedRecordingPtr&) {
    ADD_FAILURE() << "nothing is to be read, so nobody is asked";
    return true;
  };
  open_.open({.files = {"a", "b"}, .readAnew = false});
  EXPECT_EQ(heard_.back().name, "a") << "at once";
  wait();
  EXPECT_EQ(heard_.back().name, "b");
  EXPECT_EQ(open_.at("a"), before);
}

TEST_F(OpenRecordingsTest, ARequestMadeTwiceIsReadOnce) {
  open_.open({{"a", "b"}});
  open_.open({{"a", "b"}});
  EXPECT_EQ(opener_.numWaiting(), 1u);
  open_.open({{"b"}});
  EXPECT_EQ(opener_.numWaiting(), 2u) << "another request, which shows b";
  wait();
  EXPECT_EQ(heard_.size(), 3u);
  open_.open({{"a", "b"}});
  wait();
  EXPECT_EQ(heard_.size(), 5u) << "once it has been read, it is read again";
}

TEST_F(OpenRecordingsTest, ACancelledRequestCanBeMadeAgain) {
  open_.open({{"a"}});
  opener_.cancel();
  open_.open({{"a"}});
  wait();
  EXPECT_EQ(names(), (std::vector<std::string>{"a"}));
}

TEST_F(OpenRecordingsTest, NeighboursGoAroundAndClosingGoesToTheNext) {
  open_.open({{"a", "b", "c"}});
  wait();
  const auto all = open_.all();
  EXPECT_EQ(open_.neighbour(all[2], 1), all[0]);
  EXPECT_EQ(open_.neighbour(all[0], -1), all[2]);
  EXPECT_EQ(open_.neighbour(nullptr, 1), nullptr);
  EXPECT_EQ(open_.close(all[1]), all[2]);
  EXPECT_EQ(open_.close(all[2]), all[0]);
  EXPECT_EQ(open_.close(all[0]), nullptr);
  EXPECT_TRUE(open_.all().empty());
}

}  // namespace
}  // namespace palpate::gui::open_recordings_test
