#include "palpate/core/json.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "palpate/core/error.h"

#include "testing/counted_allocations.h"
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

// A file of 16 MB would take more than a gigabyte.
TEST(Json, TheNumberOfValuesIsBounded) {
  const auto list = [](std::size_t count, const std::string& value) {
    std::string text = "[";
    for (std::size_t i = 0; i < count; ++i) text += value + ",";
    return text + "0]";
  };
  EXPECT_EQ(Json::parse(list(1'000'000, "0")).size(), 1'000'001u);
  EXPECT_THROW(Json::parse(list(1'500'000, "0")), Error);
  EXPECT_THROW(Json::parse(list(1'500'000, "[]")), Error);
}

// Took minutes: the time grew with the square of the number of objects.
TEST(Json, ALongListOfObjectsIsRead) {
  std::string text = "[";
  for (int i = 0; i < 200'000; ++i) text += R"({"a":"[\"{"},)";
  const Json json = Json::parse(text + "{}]");
  EXPECT_EQ(json.size(), 200'001u);
  EXPECT_EQ(json.at(199'999).at("a").asString(), "[\"{");
}

TEST(Json, MessagesRepeatLittleOfTheText) {
  const auto messageOf = [](const std::string& text) {
    try {
      Json::parse(text);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string message = messageOf("{\"" + std::string(20'000, 'a') + "\": b}");
  EXPECT_NE(message.find("line 1, column 20006"), std::string::npos) << message;
  EXPECT_LT(message.size(), 300u) << message;
  EXPECT_LT(messageOf(std::string(20'000, '1') + "a").size(), 300u);
  EXPECT_LT(messageOf("\"" + std::string(20'000, 'a') + "\x01").size(), 300u);
  EXPECT_NE(messageOf("[1, x]").find("last read: '1, x'"), std::string::npos)
      << messageOf("[1, x]");
}

TEST(Json, NoNumberBecomesNullAndBadUtf8IsReplaced) {
  EXPECT_EQ(Json(std::nan("")).text(), "null");
  EXPECT_EQ(Json(std::string("a\xFF")).text(), "\"a\xEF\xBF\xBD\"");
}

// C-A14.
TEST(Json, WhatWasMovedFromIsNull) {
  Json from = Json::object().set("a", 1);
  const Json to = std::move(from);
  EXPECT_TRUE(from.isNull());  // NOLINT(bugprone-use-after-move)
  EXPECT_EQ(from.size(), 0u);
  EXPECT_EQ(from.text(), "null");
  EXPECT_EQ(Json(from).text(), "null");
  EXPECT_EQ(from.set("b", 2).text(-1), R"({"b":2})");
  EXPECT_EQ(to.text(-1), R"({"a":1})");
}

TEST(Json, AnErrorNamesTheKey) {
  const auto messageOf = [](auto read) {
    try {
      read();
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const Json json = Json::parse(R"({"mean": [1, "two"]})");
  EXPECT_EQ(messageOf([&] { json.at("mean").asDouble(); }),
            "JSON: 'mean': expected a number, found array");
  EXPECT_EQ(messageOf([&] { json.at("mean").at(1).asDouble(); }),
            "JSON: 'mean': expected a number, found string");
  EXPECT_EQ(messageOf([&] { json.at("scale").asDouble(); }),
            "JSON: 'scale': expected a number, found null");
}

TEST(Json, APartOutlivesItsWholeAndChangesAlone) {
  Json part;
  {
    Json whole = Json::parse(R"({"list": [1, [2]]})");
    part = whole.at("list");
    whole.set("list", 7);
    EXPECT_EQ(whole.text(-1), R"({"list":7})");
  }
  Json copy = part;
  part.push(3);
  EXPECT_EQ(part.text(-1), "[1,[2],3]");
  EXPECT_EQ(copy.text(-1), "[1,[2]]");
  const Json inner = part.at(1);
  part.push(inner);
  EXPECT_EQ(inner.text(-1), "[2]");
  EXPECT_EQ(part.text(-1), "[1,[2],3,[2]]");
}

TEST(Json, AListIsMadeOfWhateverHoldsItems) {
  const std::vector<std::string> texts = {"a", "b"};
  EXPECT_EQ(jsonList(texts).text(-1), R"(["a","b"])");
  EXPECT_EQ(jsonList(std::vector<int>{}).text(-1), "[]");
  const auto doubled = [](int number) { return 2 * number; };
  EXPECT_EQ(jsonList(std::set<int>{3, 1}, doubled).text(-1), "[2,6]");
}

// 2^53 + 1 is no double; JSON has no NaN and no infinity.
TEST(Json, AListOfNumbersIsWrittenAsTheNumbersOneByOne) {
  const std::vector<std::int64_t> whole = {1, -2, 9007199254740993};
  EXPECT_EQ(Json::array(whole).text(-1), "[1,-2,9007199254740993]");
  EXPECT_EQ(jsonList(whole).text(-1), "[1,-2,9007199254740993]");
  const std::vector<double> real = {0.1, 4.0, -std::numeric_limits<double>::infinity(), 1e300};
  EXPECT_EQ(Json::array(real).text(-1), "[0.1,4.0,null,1e+300]");
  EXPECT_EQ(jsonList(real, [](double value) { return -value; }).text(-1),
            "[-0.1,-4.0,null,-1e+300]");
  EXPECT_EQ(jsonList(std::vector<float>{0.5F, std::nanf("")}).text(-1), "[0.5,null]");
  EXPECT_EQ(jsonList(std::vector<bool>{true, false}).text(-1), "[true,false]");
  EXPECT_EQ(Json::array(std::span<const double>()).text(-1), "[]");
  EXPECT_EQ(Json::array(real).push("x").text(-1), R"([0.1,4.0,null,1e+300,"x"])");
}

TEST(Json, AListOfNumbersTakesNoAllocationPerNumber) {
  const std::vector<double> real(1000, 0.5);
  const std::vector<int> whole(1000, 7);
  testing::countAllocations();
  const Json one = jsonList(real), other = jsonList(whole);
  EXPECT_LE(testing::allocationsCounted(), 20);
  EXPECT_EQ(one.size() + other.size(), 2000u);
}

// A copy of the texts would take an allocation for each.
TEST(Json, AChainThatBeginsWithATemporaryIsNotCopied) {
  static_assert(std::is_same_v<decltype(Json().set("key", 1)), Json&&>);
  static_assert(std::is_same_v<decltype(Json().push(1)), Json&&>);
  Json texts = jsonList(std::vector<std::string>(1000, "longer than a short string is"));
  testing::countAllocations();
  const auto made = [&] { return Json::object().set("n", 1).set("texts", std::move(texts)); };
  const Json object = made();
  const Json list = Json::array().push(Json::object().set("object", made())).push(2);
  EXPECT_LE(testing::allocationsCounted(), 60);
  EXPECT_EQ(object.at("texts").size(), 1000u);
  EXPECT_EQ(list.text(-1), R"([{"object":{"n":1,"texts":null}},2])");
  Json named = Json::array().push(1);
  const Json taken = std::move(named).push(2);
  EXPECT_TRUE(named.isNull());  // NOLINT(bugprone-use-after-move)
  EXPECT_EQ(taken.text(-1), "[1,2]");
}

// Escapes as RFC 8259, section 7, has them: U+1D11E as a surrogate pair.
TEST(Json, ItsTextInAsciiHasEscapesForWhatLiesBeyond) {
  const Json json = Json::object().set("J\xC3\xB6rg", "\xF0\x9D\x84\x9E \"\n\xE2\x82\xAC\xFF");
  EXPECT_EQ(json.asciiText(), R"({"J\u00f6rg":"\ud834\udd1e \"\n\u20ac\ufffd"})");
  EXPECT_EQ(Json::parse(json.asciiText()).at("J\xC3\xB6rg").asString(),
            "\xF0\x9D\x84\x9E \"\n\xE2\x82\xAC\xEF\xBF\xBD");
}

// A matrix is read row by row and value by value: no part may cost as much as its whole.
TEST(Json, ReadingEveryItemOfALargeArrayIsLinear) {
  constexpr std::size_t kRows = 300;
  Json matrix = Json::array();
  for (std::size_t i = 0; i < kRows; ++i) {
    Json row = Json::array();
    for (std::size_t k = 0; k < kRows; ++k) row.push(k);
    matrix.push(std::move(row));
  }
  const Json whole = Json::object().set("matrix", std::move(matrix));
  double sum = 0.0;
  for (std::size_t i = 0; i < kRows; ++i)
    for (std::size_t k = 0; k < kRows; ++k) sum += whole.at("matrix").at(i).at(k).asDouble();
  EXPECT_EQ(sum, 300.0 * (299.0 * 300.0 / 2.0));
}

}  // namespace
}  // namespace palpate::json_test
