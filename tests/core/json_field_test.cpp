#include "palpate/core/json_field.h"

#include <functional>

#include <gtest/gtest.h>

#include "palpate/core/error.h"

namespace palpate::json_field_test {
namespace {

std::string faultOf(const std::function<void(const JsonField&)>& read, const std::string& text) {
  try {
    read(JsonField::parse(text, "x.json", "the thing"));
  } catch (const FormatError& error) {
    return error.what();
  }
  return "no fault";
}

TEST(JsonField, ReadsValues) {
  const JsonField root = JsonField::parse(
      R"({"n": 2.5, "i": 3, "t": "text", "f": true, "list": [1, 2, 3]})", "x.json", "the thing");
  EXPECT_EQ(root.at("n").number(0.0, 3.0), 2.5);
  EXPECT_EQ(root.number("absent", 7.0, 0.0, 1.0), 7.0);
  EXPECT_EQ(root.required("i").integer(0, 3), 3);
  EXPECT_EQ(root.at("i").index(4), 3u);
  EXPECT_EQ(root.at("t").text(), "text");
  EXPECT_TRUE(root.at("f").flag());
  EXPECT_EQ(root.at("list").numbers(3, 0.0, 10.0), (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(root.at("list").items(3).size(), 3u);
}

// Each fault names the file, the place and what is wrong.
TEST(JsonField, NamesThePlaceOfAFault) {
  EXPECT_EQ(faultOf([](const JsonField& root) { root.items(1); }, "{}"),
            "x.json: the thing isn't a JSON array");
  EXPECT_EQ(faultOf([](const JsonField& root) { root.at("a").items(2)[1].at("b").number(0, 1); },
                    R"({"a": [{}, {"b": 2}]})"),
            "x.json: a[1].b is 2, not in 0..1");
  EXPECT_EQ(faultOf(
                [](const JsonField& root) {
                  root.only({"a", "b"});
                },
                R"({"c": 1})"),
            "x.json: the thing has an unknown key 'c' (known: a, b)");
  EXPECT_EQ(faultOf([](const JsonField& root) { root.only({"a"}); },
                    "{\"" + std::string(20'000, 'c') + "\": 1}"),
            "x.json: the thing has an unknown key '" + std::string(100, 'c') + "..' (known: a)");
  EXPECT_EQ(faultOf([](const JsonField& root) { root.required("a"); }, "{}"),
            "x.json: the thing has no \"a\"");
  EXPECT_EQ(faultOf([](const JsonField& root) { root.at("a").integer(0, 9); }, R"({"a": 1.5})"),
            "x.json: a isn't a whole number");
  EXPECT_EQ(faultOf([](const JsonField& root) { root.at("a").index(2); }, R"({"a": 2})"),
            "x.json: a is 2, not in 0..1");
  EXPECT_EQ(faultOf([](const JsonField& root) { root.at("a").numbers(3, 0, 9); }, R"({"a": [1]})"),
            "x.json: a is not three numbers");
  EXPECT_EQ(faultOf([](const JsonField& root) { root.at("a").items(1); }, R"({"a": [1, 2]})"),
            "x.json: a has more than 1 items");
  EXPECT_EQ(faultOf([](const JsonField& root) { root.at("a").text(); }, R"({"a": 1})"),
            "x.json: a isn't a text");
  EXPECT_EQ(faultOf([](const JsonField& root) { root.at("a").flag(); }, R"({"a": 1})"),
            "x.json: a is neither true nor false");
  const std::string noJson = faultOf([](const JsonField&) {}, "{");
  EXPECT_TRUE(noJson.starts_with("x.json: ")) << noJson;
}

}  // namespace
}  // namespace palpate::json_field_test
