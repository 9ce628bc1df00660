#include "commands/command_line.h"

#include <array>
#include <cstdint>
#include <optional>
#include <sstream>

#include "commands/commands.h"
#include "commands/palpate_program.h"

namespace palpate::commands::command_line_test {
namespace {

using palpate::testing::expectOneLineError;
using palpate::testing::palpate;
using palpate::testing::startedPalpate;

const CommandSpec kSpec{.synopsis = "palpate try FILE",
                        .purpose = "A command for this test.",
                        .options = {{"frame,f", "N", "a frame"},
                                    {"filter", "SPEC", "may be repeated"},
                                    {"force", "", "a flag"}},
                        .example = "palpate try a.dsa",
                        .minArguments = 1,
                        .maxArguments = 2};

TEST(CommandLine, SortsOptionsFromWords) {
  const CommandLine given(kSpec,
                          {"a.dsa", "-f", "3", "--filter", "x", "--force", "--filter=y", "b"});
  EXPECT_EQ(given.words(), (std::vector<std::string>{"a.dsa", "b"}));
  EXPECT_EQ(given.integer("frame", 0, 10), 3);
  EXPECT_EQ(given.texts("filter"), (std::vector<std::string>{"x", "y"}));
  EXPECT_TRUE(given.has("force"));
  EXPECT_FALSE(given.quiet());
}

TEST(CommandLine, SaysALineOnStandardError) {
  ::testing::internal::CaptureStderr();
  sayLine("a\nb");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "palpate: a\\nb\n");
}

TEST(CommandLine, RefusesWhatItDoesNotKnow) {
  EXPECT_THROW(CommandLine(kSpec, {}), UsageError);
  EXPECT_THROW(CommandLine(kSpec, {"a", "b", "c"}), UsageError);
  EXPECT_THROW(CommandLine(kSpec, {"a", "--unknown"}), UsageError);
  EXPECT_THROW(CommandLine(kSpec, {"a", "--fra", "3"}), UsageError);  // no abbreviations
  EXPECT_THROW(CommandLine(kSpec, {"a", "--frame"}), UsageError);
  const CommandLine given(kSpec, {"a", "--frame", "x", "--filter", "y"});
  EXPECT_THROW(given.integer("frame", 0, 10), UsageError);
  EXPECT_THROW(given.number("frame", 0, 10), UsageError);
  EXPECT_THROW(given.choice("filter", {"a", "b"}), UsageError);
}

TEST(CommandLine, ChecksRangesAndChoices) {
  const CommandLine given(kSpec, {"a", "--frame", "11", "--filter", "b"});
  EXPECT_THROW(given.integer("frame", 0, 10), UsageError);
  EXPECT_THROW(given.number("frame", 0, 10.9), UsageError);
  EXPECT_EQ(given.number("frame", 0, 11.0), 11.0);
  EXPECT_EQ(given.choice("filter", {"a", "b"}), "b");
  EXPECT_EQ(given.integer("missing", 0, 1), std::nullopt);
}

enum class Form { kRound, kFlat };
constexpr std::array<OptionWord<Form>, 2> kFormWords{
    {{"round", Form::kRound}, {"flat", Form::kFlat}}};

// The fields that options of a command are bound to, and the command line that sets them.
struct Bound {
  double widthMm = 2.5;
  std::optional<std::size_t> count = {};
  std::uint64_t seed = 7;
  Form form = Form::kFlat;
  bool dry = false;
  std::optional<std::string> text = {};

  std::vector<OptionSpec> options() {
    return {bound("width,w", "MM", "width", widthMm, {0.5, 10.0, "mm"}),
            bound("count", "N", "how many", count, {1, 100}),
            bound("seed", "N", "seed", seed, kSeedOption, "as before"),
            boundChoice("form", "FORM", "outline", form, kFormWords),
            bound("dry", "no water", dry),
            bound("text", "TEXT", "a text", text)};
  }
  void take(const std::vector<std::string>& words) {
    CommandLine(
        {.synopsis = "palpate try", .purpose = "", .options = options(), .example = "palpate try"},
        words);
  }
  std::string helpOf(std::size_t option) { return options()[option].help; }
};

TEST(BoundOptions, SetTheirFields) {
  Bound fields;
  fields.take({});
  EXPECT_EQ(fields.widthMm, 2.5);
  EXPECT_EQ(fields.count, std::nullopt);
  EXPECT_EQ(fields.form, Form::kFlat);
  EXPECT_FALSE(fields.dry);
  fields.take({"-w",
               "0.5",
               "--count",
               "100",
               "--seed",
               "4294967295",
               "--form",
               "round",
               "--dry",
               "--text=x"});
  EXPECT_EQ(fields.widthMm, 0.5);
  EXPECT_EQ(fields.count, 100u);
  EXPECT_EQ(fields.seed, 4294967295u);
  EXPECT_EQ(fields.form, Form::kRound);
  EXPECT_TRUE(fields.dry);
  EXPECT_EQ(fields.text, "x");
}

TEST(BoundOptions, RefuseWhatIsOutsideAndLeaveTheField) {
  Bound fields;
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"--width", "0.49"},
                                             {"--width", "10.1"},
                                             {"--width", "nan"},
                                             {"--count", "0"},
                                             {"--count", "101"},
                                             {"--count", "1.5"},
                                             {"--seed", "-1"},
                                             {"--seed", "4294967296"},
                                             {"--form", "square"}})
    EXPECT_THROW(fields.take(words), UsageError) << words[0] << " " << words[1];
  EXPECT_EQ(fields.widthMm, 2.5);
  EXPECT_EQ(fields.count, std::nullopt);
  EXPECT_EQ(fields.form, Form::kFlat);
}

TEST(BoundOptions, AreExplainedByTheirFields) {
  Bound fields;
  EXPECT_EQ(fields.helpOf(0), "width [mm]; 0.5..10, default 2.5");
  EXPECT_EQ(fields.helpOf(1), "how many; 1..100");
  EXPECT_EQ(fields.helpOf(2), "seed; from 0, default as before");
  EXPECT_EQ(fields.helpOf(3), "round, flat (default); outline");
  fields.form = Form::kRound;
  EXPECT_EQ(fields.helpOf(3), "round (default), flat; outline");
  EXPECT_EQ(boundChoice("form", "FORM", "", fields.form, kFormWords, "that of the hand").help,
            "round, flat (default that of the hand)");
}

// Options that a command asks for later are checked with the same range and words.
TEST(BoundOptions, OthersAreCheckedAndExplained) {
  const CommandSpec spec{.synopsis = "palpate try",
                         .purpose = "A command for this test.",
                         .options = {ranged("length", "S", "length", {0.1, 60.0, "s"}, "1"),
                                     rangedWhole("frame", "N", "frame", kFrameOption),
                                     worded("form", "FORM", "", kFormWords, "flat")},
                         .example = "palpate try"};
  EXPECT_EQ(spec.options[0].help, "length [s]; 0.1..60, default 1");
  EXPECT_EQ(spec.options[1].help, "frame; from 0");
  EXPECT_EQ(spec.options[2].help, "round, flat (default)");
  const CommandLine given(spec, {"--length=0.1", "--frame=9223372036854775807", "--form=round"});
  EXPECT_EQ(given.number("length", {0.1, 60.0}), 0.1);
  EXPECT_EQ(given.integer("frame", kFrameOption), INT64_MAX);
  EXPECT_EQ(given.chosen("form", kFormWords), Form::kRound);
  EXPECT_EQ(CommandLine(spec, {}).chosen("form", kFormWords), std::nullopt);
  for (const char* word : {"--length=0", "--frame=-1", "--form=square"})
    EXPECT_THROW(CommandLine(spec, {word}), UsageError) << word;
}

TEST(BoundOptions, WordsAreTheNamesOfAList) {
  const auto words = wordsOf(std::array{1, 2}, [](int each) { return "n" + std::to_string(each); });
  EXPECT_EQ(words, (std::vector<std::pair<std::string, int>>{{"n1", 1}, {"n2", 2}}));
}

TEST(Program, EveryCommandExplainsItselfWithAnExample) {
  for (const Command& command : allCommands()) {
    const auto result = startedPalpate({command.name, "--help"});
    EXPECT_EQ(result.exitCode, 0) << command.name;
    EXPECT_NE(result.out.find("Usage: palpate " + std::string(command.name)), std::string::npos);
    EXPECT_NE(result.out.find("Example:\n  palpate " + std::string(command.name)),
              std::string::npos);
    EXPECT_NE(result.out.find("--quiet"), std::string::npos) << command.name;
    EXPECT_EQ(result.err, "");
  }
}

// The other tests call the commands without starting the program.
TEST(Program, StartedItDoesWhatItsCommandsDo) {
  const testing::TemporaryFolder folder;
  const std::string file = folder / "a.dsa";
  ASSERT_EQ(startedPalpate({"synthesize", "-o", file, "--seed", "1"}).exitCode, 0);
  for (const char* command : {"compare",
                              "contact",
                              "features",
                              "filter",
                              "grasps",
                              "info",
                              "kinematics",
                              "signals",
                              "slip",
                              "verify"}) {
    Arguments words = {command, file};
    if (words[0] == "compare") words.push_back(file);
    if (words[0] == "filter")
      words.insert(words.end(), {"-o", folder / "b.dsa", "--filter", "median"});
    const auto started = startedPalpate(words), called = palpate(words);
    EXPECT_EQ(started.exitCode, called.exitCode) << command << started.err;
    EXPECT_EQ(started.out, called.out) << command;
    EXPECT_EQ(started.err, called.err) << command;
  }
}

// What a command does is explained in lines that an ordinary terminal doesn't break.
TEST(Program, HelpFitsIntoEightyColumns) {
  for (const Command& command : allCommands()) {
    const std::string help = palpate({command.name, "--help"}).out;
    const std::size_t begin = help.find("\n\n"), end = help.find("\nExample:");
    ASSERT_LT(begin, end) << command.name;
    std::istringstream lines(help.substr(begin, end - begin));
    for (std::string line; std::getline(lines, line);)
      EXPECT_LE(line.size(), 80u) << command.name << ": " << line;
  }
  std::istringstream lines(palpate({"--help"}).out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 90u) << line;
}

TEST(Program, HelpOfACommandIsTheCommandsHelp) {
  const auto result = palpate({"help", "info"});
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_EQ(result.out, palpate({"info", "--help"}).out);
  EXPECT_EQ(palpate({"help", "calibrate", "noise"}).out,
            palpate({"calibrate", "noise", "--help"}).out);
}

TEST(Program, AUsageOfSeveralLinesIsAnErrorOfOneLine) {
  const auto result = palpate({"evaluate"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_EQ(result.err.find("\\n"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find(" | palpate evaluate --model"), std::string::npos) << result.err;
}

TEST(Program, ListsItsCommandsAndItsVersion) {
  const auto help = palpate({"--help"});
  EXPECT_EQ(help.exitCode, 0);
  for (const Command& command : allCommands())
    EXPECT_NE(help.out.find("\n  " + std::string(command.name) + " "), std::string::npos);
  std::size_t at = 0;
  for (const char* heading : {"Look", "Compute", "Export", "Recognise", "Hand", "Laboratory"}) {
    at = help.out.find("\n\n" + std::string(heading) + ":\n  ", at);
    EXPECT_NE(at, std::string::npos) << heading;
  }
  EXPECT_EQ(palpate({"--version"}).out.rfind("palpate ", 0), 0u);
}

TEST(Program, WrongUsageIsExitCodeTwoInOneLine) {
  expectOneLineError(palpate({"inof", "x"}), 2, {"inof", "did you mean 'info'"});
  expectOneLineError(palpate({"xyzzyxyzzy"}), 2, {"xyzzyxyzzy", "--help"});
  expectOneLineError(palpate({"info"}), 2, {"usage: palpate info PATH"});
  expectOneLineError(palpate({"info", "--jsn", "x"}), 2, {"--jsn", "'palpate info --help'"});
  expectOneLineError(palpate({"help", "inof"}), 2, {"no command is called", "'info'"});
  expectOneLineError(palpate({"info", "a", "--jsom"}), 2, {"--jsom"});
  expectOneLineError(palpate({"signals", "a", "--matrix", "-1"}), 2, {"--matrix", "'-1'"});
  expectOneLineError(palpate({"--unknown"}), 2, {"--unknown"});
}

TEST(Program, StreamsAndEmptyNamesAreNoFiles) {
  expectOneLineError(palpate({"info", "-"}), 2, {"'-'"});
  expectOneLineError(palpate({"verify", ""}), 2, {"empty"});
}

TEST(Program, ErrorsStayOneLineWhateverTheFileIsCalled) {
  expectOneLineError(palpate({"info", "/tmp/no\nsuch\033[31mfile.dsa"}), 1, {"no\\nsuch\\x1B"});
  expectOneLineError(palpate({"fo\no"}), 2, {"fo\\no"});
}

TEST(Program, WhatIsPrintedAndNotWrittenIsAFailure) {
  const std::string program = "\"" + std::string(PALPATE_PROGRAM) + "\" ";
  const std::string demo = "\"" + (testing::dataFolder() / "demo_grasps.dsa").string() + "\"";
  for (const std::string& command : {"verify " + demo + " > /dev/full",
                                     "verify " + demo + " >&-",
                                     std::string("--help > /dev/full"),
                                     std::string("info --help >&-"),
                                     std::string("--version > /dev/full")})
    expectOneLineError(
        testing::runProgram("/bin/sh", {"-c", program + command}), 1, {"standard output"});
}

TEST(Program, FullStandardOutputIsAFailure) {
  const testing::TemporaryFolder folder;
  ASSERT_EQ(palpate({"synthesize", "-o", folder / "a.dsa", "--duration", "2"}).exitCode, 0);
  const auto result = testing::runProgram(
      "/bin/sh",
      {"-c", "exec \"$0\" signals \"$1\" > /dev/full", PALPATE_PROGRAM, folder / "a.dsa"});
  expectOneLineError(result, 1, {"standard output"});
}

}  // namespace
}  // namespace palpate::commands::command_line_test
