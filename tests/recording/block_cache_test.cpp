#include "recording/block_cache.h"

#include <string>

#include <gtest/gtest.h>

namespace palpate::block_cache_test {
namespace {

TEST(BlockCache, DropsWhatWasNotUsedForLongest) {
  BlockCache<std::string> cache(3);
  for (const int key : {1, 2, 3}) EXPECT_EQ(cache.add(key, 1, std::to_string(key)).size(), 1u);
  ASSERT_TRUE(cache.find(1));
  EXPECT_EQ(*cache.find(1), "1");
  cache.add(4, 1, "4");
  EXPECT_FALSE(cache.find(2));
  for (const int key : {1, 3, 4}) EXPECT_TRUE(cache.find(key)) << key;
  cache.clear();
  EXPECT_FALSE(cache.find(1));
}

TEST(BlockCache, KeepsOneThatIsLargerThanAllowedByItself) {
  BlockCache<std::string> cache(10);
  cache.add(1, 4, "a");
  cache.add(2, 100, "b");
  EXPECT_FALSE(cache.find(1));
  EXPECT_TRUE(cache.find(2));
  cache.makeRoom(1);
  EXPECT_FALSE(cache.find(2));
  cache.add(3, 10, "c");
  cache.makeRoom(0);
  EXPECT_TRUE(cache.find(3));
}

TEST(BlockCache, KeepsNoMoreBlocksThanAllowed) {
  BlockCache<std::string> cache(100, 2);
  for (const int key : {1, 2, 3}) cache.add(key, 0, "");
  EXPECT_FALSE(cache.find(1));
  EXPECT_TRUE(cache.find(2));
  EXPECT_TRUE(cache.find(3));
}

}  // namespace
}  // namespace palpate::block_cache_test
