#include "interop/foxglove_subscriber.h"

#include <gtest/gtest.h>

#include "palpate/core/json.h"

namespace palpate::foxglove_subscriber_test {
namespace {

class FoxgloveSubscriberTest : public ::testing::Test {
 protected:
  void subscribe(std::uint32_t id, std::size_t channel) {
    client_->take(true,
                  R"({"op":"subscribe","subscriptions":[{"id":)" + std::to_string(id) +
                      R"(,"channelId":)" + std::to_string(channel) + "}]}",
                  latest_);
  }
  void unsubscribe(std::uint32_t id) {
    client_->take(
        true, R"({"op":"unsubscribe","subscriptionIds":[)" + std::to_string(id) + "]}", latest_);
  }
  void publish(std::size_t channel, const std::string& payload) {
    client_->publish({channel, 1, std::make_shared<const std::string>(payload)});
  }
  // What waits, in order; of a status its message.
  std::vector<std::string> waiting() {
    std::vector<std::string> all;
    while (const auto out = client_->waiting().pop())
      all.push_back(out->binary ? *out->content
                                : Json::parse(*out->content).at("message").asString());
    return all;
  }

  std::vector<FoxgloveMessage> latest_ = std::vector<FoxgloveMessage>(2);
  std::vector<int> subscribers_ = std::vector<int>(2);
  std::optional<FoxgloveSubscriber> client_{
      std::in_place, 2U, 100U, [this](std::size_t channel, int change) {
        subscribers_.at(channel) += change;
      }};
};

TEST_F(FoxgloveSubscriberTest, AChannelHasOneSubscription) {
  subscribe(7, 0);
  subscribe(8, 0);
  EXPECT_EQ(waiting(), std::vector<std::string>{"channel 0 has the subscription 7 already"});
  subscribe(7, 1);
  EXPECT_EQ(waiting(), std::vector<std::string>{"subscription 7 exists already"});
  EXPECT_EQ(subscribers_, (std::vector<int>{1, 0}));
  publish(0, "a");
  publish(1, "b");
  EXPECT_EQ(waiting(), std::vector<std::string>{"a"});
  unsubscribe(7);
  subscribe(7, 1);
  EXPECT_EQ(subscribers_, (std::vector<int>{0, 1}));
  client_.reset();
  EXPECT_EQ(subscribers_, (std::vector<int>{0, 0}));
}

// 5000 subscriptions that are refused in one message make one status.
TEST_F(FoxgloveSubscriberTest, AMessageIsAnsweredOnce) {
  std::string list;
  for (int id = 0; id < 5000; ++id)
    list += (id > 0 ? "," : "") + ("{\"id\":" + std::to_string(id)) + ",\"channelId\":0}";
  client_->take(true, R"({"op":"subscribe","subscriptions":[)" + list + "]}", latest_);
  EXPECT_EQ(waiting(), std::vector<std::string>{"channel 0 has the subscription 0 already"});
  client_->take(false, "\x01", latest_);
  EXPECT_EQ(waiting().size(), 1u);
}

// 13 bytes of the head and 17 of the payload: of a hundred bytes there is room for three.
TEST_F(FoxgloveSubscriberTest, DropsTheOldestMessagesAndKeepsWhatIsBeingSent) {
  subscribe(1, 0);
  const auto payload = [](int n) { return std::to_string(n) + std::string(15, '.'); };
  for (int n = 10; n < 13; ++n) publish(0, payload(n));
  const auto sending = client_->waiting().pop();
  for (int n = 13; n < 99; ++n) publish(0, payload(n));
  ASSERT_TRUE(sending);
  EXPECT_EQ(*sending->content, payload(10));
  EXPECT_EQ(client_->waiting().bytes(), 90u);
  EXPECT_EQ(client_->waiting().takeDropped(), 85u);
  EXPECT_EQ(client_->waiting().takeDropped(), 0u);
  EXPECT_EQ(waiting(), (std::vector<std::string>{payload(96), payload(97), payload(98)}));
  EXPECT_EQ(client_->waiting().bytes(), 0u);
}

TEST_F(FoxgloveSubscriberTest, WhatANewSubscriberReceivesIsNotDropped) {
  latest_[0] = {0, 5, std::make_shared<const std::string>("scene")};
  subscribe(1, 1);
  subscribe(2, 0);
  for (int n = 0; n < 50; ++n) publish(1, "........................");
  EXPECT_EQ(waiting().front(), "scene");
  for (int n = 0; n < 64; ++n) {
    unsubscribe(2);
    subscribe(2, 0);
  }
  EXPECT_FALSE(client_->waiting().isOverrun());
  unsubscribe(2);
  subscribe(2, 0);
  EXPECT_TRUE(client_->waiting().isOverrun());
}

}  // namespace
}  // namespace palpate::foxglove_subscriber_test
