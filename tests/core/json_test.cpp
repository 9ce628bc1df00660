#include "palpate/core/json.h"

#include <cmath>

#include "palpate/core/error.h"

#include "testing/testing.h"

namespace palpate::json_test {
namespace {

TEST(Json, KeepsTheOrderOfKeysAndWritesShortNumbers) {
  Json json = Json::object();
  json.set("zebra", 1).set("ape", 0.1).set("list", Json::array().push("x").push(true).push(Json()));
  EXPECT_EQ(json.text(-1), R"({"zebra":1,"ape":0.1,"list":["x",true,null]})");
  EXPECT_EQ(json.keys(), (std::vector<std::string>{"zebra", "ape", "list"}));
}

TEST(Json, ReadsBackWhatItWrote) {
  const Json json = Json::parse(R"({"a": [1, 2.5, "drei"], "big": 9007199254740993, "t": true})");
  EXPECT_EQ(json.at("a").size(), 3u);
  EXPECT_EQ(json.at("a").at(0).asInteger(), 1);
  EXPECT_EQ(json.at("a").at(1).asDouble(), 2.5);
  EXPECT_EQ(json.at("a").at(2).asString(), "drei");
  EXPECT_EQ(json.at("big").asInteger(), 9007199254740993);  // beyond a double's 53 bits
  EXPECT_TRUE(json.at("t").asBool());
  EXPECT_TRUE(json.at("missing").isNull());
  EXPECT_THROW(json.at("a").at(3), std::out_of_range);
}

TEST(Json, WrongKindsAndBadTextAreErrorsWithAPlace) {
  EXPECT_THROW(Json("text").asDouble(), Error);
  EXPECT_THROW(Json(1.5).asInteger(), Error);
  EXPECT_THROW(Json::parse("18446744073709551615").asInteger(), Error);
  EXPECT_THROW(Json("text").set("key", 1), Error);
  try {
    Json::parse("{\n  \"a\": ,\n}");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("line 2"), std::string::npos) << error.what();
  }
}

TEST(Json, NestingIsBounded) {
  const std::string deep(100'000, '[');
  EXPECT_THROW(Json::parse(deep), Error);
  std::string fine(300, '[');
  fine.append(300, ']');
  EXPECT_TRUE(Json::parse(fine).isArray());
}

TEST(Json, NoNumberBecomesNullAndBadUtf8IsReplaced) {
  EXPECT_EQ(Json(std::nan("")).text(), "null");
  EXPECT_EQ(Json(std::string("a\xFF")).text(), "\"a\xEF\xBF\xBD\"");
}

}  // namespace
}  // namespace palpate::json_test
