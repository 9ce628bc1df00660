#include "palpate/interop/remote_protocol.h"

#include <random>

#include "testing/testing.h"

namespace palpate::remote_protocol_test {
namespace {
using Verb = RemoteRequest::Verb;

std::string refusal(std::string_view line) {
  const ReadRequest read = readRequest(line);
  EXPECT_FALSE(read.request) << line;
  EXPECT_FALSE(read.refusal.message.empty());
  return read.refusal.error;
}

TEST(ReadRequest, AVerbAndItsText) {
  const auto start = readRequest("start run 7.palpate").request;
  ASSERT_TRUE(start);
  EXPECT_EQ(start->verb, Verb::kStart);
  EXPECT_EQ(start->text, "run 7.palpate");
  EXPECT_EQ(readRequest("start").request->text, "");
  EXPECT_EQ(readRequest("  label \t grüß  Gott \t").request->text, "grüß  Gott");
  EXPECT_EQ(readRequest("status").request->verb, Verb::kStatus);
  EXPECT_EQ(readRequest("set object foam ball").request->text, "object foam ball");
  for (const Verb verb : allRemoteVerbs()) {
    const std::string text = verb == Verb::kLabel ? " x" : verb == Verb::kSet ? " notes x" : "";
    EXPECT_EQ(readRequest(std::string(nameOf(verb)) + text).request->verb, verb);
  }
}

TEST(ReadRequest, WhatIsNoRequestIsSaid) {
  EXPECT_EQ(refusal(""), "malformed");
  EXPECT_EQ(refusal("   "), "malformed");
  EXPECT_EQ(refusal("reboot now"), "unknown");
  EXPECT_EQ(refusal("Start"), "unknown");
  EXPECT_EQ(refusal("label"), "malformed");
  EXPECT_EQ(refusal("stop it"), "malformed");
  EXPECT_EQ(refusal("set colour red"), "malformed");
  EXPECT_EQ(refusal("label a\x1b[31mb"), "malformed");
  EXPECT_EQ(refusal(std::string_view("label a\0b", 9)), "malformed");
  EXPECT_EQ(refusal("label \xff\xfe"), "malformed");
  EXPECT_EQ(refusal(std::string(kMaxRequestBytes + 1, 'a')), "too_long");
  // An invalid request is quoted in shortened form.
  EXPECT_LT(readRequest(std::string(4000, 'y')).refusal.message.size(), 200u);
}

TEST(RequestLines, CutsWhateverTheReadsAre) {
  const std::string text = "status\r\nlabel a\n\nstop\n";
  for (std::size_t size = 1; size <= text.size(); ++size) {
    RequestLines lines;
    std::vector<std::string> found;
    for (std::size_t at = 0; at < text.size(); at += size) {
      lines.push(std::string_view(text).substr(at, size));
      while (const auto line = lines.next()) found.push_back(line->text);
    }
    EXPECT_EQ(found, (std::vector<std::string>{"status", "label a", "", "stop"})) << size;
  }
}

TEST(RequestLines, AFarTooLongLineCostsNoMemoryAndHidesNoOther) {
  RequestLines lines;
  const std::string piece(4096, 'x');
  std::size_t most = 0;
  for (int i = 0; i < 10'000; ++i) {  // 41 MB without an end
    lines.push(piece);
    EXPECT_FALSE(lines.next());
    most = std::max(most, lines.pendingBytes());
  }
  EXPECT_LE(most, kMaxRequestBytes + 4096);
  lines.push("tail\nstatus\n");
  const auto first = lines.next();
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->tooLong);
  EXPECT_EQ(lines.next()->text, "status");
  EXPECT_FALSE(lines.next());
}

TEST(RequestLines, TheLongestLineThatIsAllowed) {
  for (const char* end : {"\n", "\r\n"}) {
    RequestLines lines;
    const std::string longest(kMaxRequestBytes, 'x');
    for (const char c : longest + end) lines.push(std::string_view(&c, 1));
    const auto line = lines.next();
    ASSERT_TRUE(line);
    EXPECT_FALSE(line->tooLong);
    EXPECT_EQ(line->text, longest);
  }
  RequestLines lines;
  lines.push(std::string(kMaxRequestBytes + 1, 'x') + "\n");
  EXPECT_TRUE(lines.next()->tooLong);
}

// No text received over the socket may cause more than a refusal.
TEST(ReadRequest, NoiseNeverThrows) {
  std::mt19937 random(7);
  RequestLines lines;
  std::size_t cut = 0;
  for (int i = 0; i < 200'000; ++i) {
    const char c = static_cast<char>(random() % 256);
    lines.push(std::string_view(&c, 1));
    while (const auto line = lines.next()) {
      ++cut;
      const ReadRequest read = readRequest(line->text);
      const std::string answer = answerLine(read.refusal, "");
      EXPECT_EQ(answer.find('\n'), std::string::npos);
      EXPECT_TRUE(Json::parse(answer).isObject());
    }
  }
  EXPECT_GT(cut, 500u);
}

TEST(AnswerLine, IsOneLineOfJson) {
  RemoteAnswer answer;
  answer.message = "two\nlines \"quoted\"";
  answer.fields.set("file", "/tmp/a\\b.palpate").set("frames", 3);
  const std::string line = answerLine(answer, "start");
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const Json json = Json::parse(line);
  EXPECT_EQ(json.keys(), (std::vector<std::string>{"ok", "command", "message", "file", "frames"}));
  EXPECT_TRUE(json.at("ok").asBool());
  EXPECT_EQ(json.at("file").asString(), "/tmp/a\\b.palpate");
  const Json refused = Json::parse(answerLine(RemoteAnswer::refused("no_hand", "why"), "start"));
  EXPECT_FALSE(refused.at("ok").asBool());
  EXPECT_EQ(refused.at("error").asString(), "no_hand");
  EXPECT_EQ(refused.at("message").asString(), "why");
  EXPECT_FALSE(Json::parse(answerLine(answer, "")).contains("command"));
}

TEST(SettingFrom, KeyAndValue) {
  EXPECT_EQ(settingFrom("object  foam ball")->value, "foam ball");
  EXPECT_EQ(settingFrom("operator")->value, "");
  EXPECT_FALSE(settingFrom("serial 7"));
  EXPECT_FALSE(settingFrom(""));
}

}  // namespace
}  // namespace palpate::remote_protocol_test
