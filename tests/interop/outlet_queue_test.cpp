#include "interop/outlet_queue.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palpate::outlet_queue_test {
namespace {

struct Text {
  std::string text;
  bool droppable = true;
  std::size_t size() const { return text.size(); }
};

std::vector<std::string> all(OutletQueue<Text>& queue) {
  std::vector<std::string> texts;
  while (auto item = queue.pop()) texts.push_back(std::move(item->text));
  return texts;
}

TEST(OutletQueue, GivesTheOldestFirst) {
  OutletQueue<Text> queue(100);
  EXPECT_FALSE(queue.pop());
  for (const char* text : {"a", "bb", "ccc"}) queue.push({text});
  EXPECT_EQ(queue.size(), 3u);
  EXPECT_EQ(queue.bytes(), 6u);
  EXPECT_EQ(all(queue), (std::vector<std::string>{"a", "bb", "ccc"}));
  EXPECT_EQ(queue.bytes(), 0u);
  EXPECT_EQ(queue.takeDropped(), 0u);
}

// Nobody reads: of 100,000 items of 5 bytes twenty fit into 100 bytes.
TEST(OutletQueue, DropsAndCountsTheOldestBeyondItsBytes) {
  OutletQueue<Text> queue(100);
  for (int n = 100'000; n < 200'000; ++n) {
    queue.push({std::to_string(n).substr(1)});
    ASSERT_LE(queue.bytes(), 100u);
  }
  EXPECT_EQ(queue.takeDropped(), 99'980u);
  EXPECT_EQ(queue.takeDropped(), 0u);
  const auto texts = all(queue);
  EXPECT_EQ(texts.front(), "99980");
  EXPECT_EQ(texts.back(), "99999");
}

TEST(OutletQueue, DropsBeyondItsNumberOfItems) {
  OutletQueue<Text> queue(100, 3);
  for (const char* text : {"a", "b", "c", "d", "e"}) queue.push({text});
  EXPECT_EQ(queue.takeDropped(), 2u);
  EXPECT_EQ(all(queue), (std::vector<std::string>{"c", "d", "e"}));
}

TEST(OutletQueue, AnItemLongerThanItsBytesIsDropped) {
  OutletQueue<Text> queue(3);
  queue.push({"abcd"});
  EXPECT_EQ(queue.takeDropped(), 1u);
  EXPECT_EQ(queue.size(), 0u);
  EXPECT_EQ(queue.bytes(), 0u);
}

TEST(OutletQueue, KeepsWhatMustNotBeDropped) {
  OutletQueue<Text> queue(4);
  queue.push({"keep", false});
  for (const char* text : {"a", "b"}) queue.push({text});
  EXPECT_EQ(queue.takeDropped(), 2u);
  EXPECT_EQ(all(queue), std::vector<std::string>{"keep"});
  for (int i = 0; i < 64; ++i) queue.push({"k", false});
  EXPECT_FALSE(queue.isOverrun());
  queue.push({"k", false});
  EXPECT_TRUE(queue.isOverrun());
  queue.pop();
  EXPECT_FALSE(queue.isOverrun());
}

}  // namespace
}  // namespace palpate::outlet_queue_test
