// Describes what a command accepts and parses what the user typed (by Boost.Program_options); also
// progress on stderr and buffered standard output for all commands.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <palpate/core/error.h>
#include <palpate/core/number_text.h>
#include <palpate/core/option_check.h>
#include <palpate/core/progress.h>

namespace palpate::commands {

// Prints one line on standard error.
void sayLine(std::string_view message);

// The command was used in a wrong way: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class CommandLine;

// One option of a command.
struct OptionSpec {
  // The long name, or the long name with a short form: "frame", "output,o".
  std::string name;
  // The name of its value in the help ("N"); empty for a flag.
  std::string value;
  std::string help;
  // Sets what the option is bound to; empty: the command asks for the value.
  std::function<void(const CommandLine&)> take = {};
};

// Options that are bound to a field: where the option is given, CommandLine checks it and sets the
// field, which must outlive it. The help names unit, range and default: `usual`, or by default the
// field's value as it is now (none of a std::optional); an empty `usual` names none.
template <typename T>
OptionSpec bound(const std::string& name,
                 std::string value,
                 std::string help,
                 T& field,
                 OptionRange range,
                 std::optional<std::string> usual = {});
// A flag.
OptionSpec bound(const std::string& name, std::string help, bool& field);
// A text.
OptionSpec bound(const std::string& name,
                 std::string value,
                 std::string help,
                 std::optional<std::string>& field);
// One of the words of a list of OptionWord (or of wordsOf()). The help begins with the words.
template <typename T, typename Words>
OptionSpec boundChoice(const std::string& name,
                       std::string value,
                       const std::string& help,
                       T& field,
                       const Words& words,
                       const std::optional<std::string>& usual = {});
// Options whose value the command asks for by CommandLine::number() or integer() with the same
// range, or by chosen() with the same words; CommandLine also checks them.
OptionSpec ranged(const std::string& name,
                  std::string value,
                  std::string help,
                  OptionRange range,
                  const std::optional<std::string>& usual = {});
OptionSpec rangedWhole(const std::string& name,
                       std::string value,
                       std::string help,
                       OptionRange range,
                       const std::optional<std::string>& usual = {});
template <typename Words>
OptionSpec worded(const std::string& name,
                  std::string value,
                  const std::string& help,
                  const Words& words,
                  const std::string& usual = {});

// The values of a list with their names, as OptionWords.
template <typename All, typename NameOf>
auto wordsOf(const All& all, NameOf nameOf) {
  std::vector<std::pair<std::string, std::remove_cvref_t<decltype(*std::begin(all))>>> words;
  for (const auto& each : all) words.emplace_back(nameOf(each), each);
  return words;
}

// What a number can be before the recording is known: of a matrix, of a frame; and a seed.
inline constexpr OptionRange kMatrixOption{0, INT32_MAX};
inline constexpr OptionRange kFrameOption{0, 0x1p63};
inline constexpr OptionRange kSeedOption{0, UINT32_MAX};

// --topic TOPIC, which may be repeated (CommandLine::texts).
OptionSpec topicOption();

// Everything that a command accepts, also for its help.
struct CommandSpec {
  // The usage line: "palpate info FILE [--json]".
  std::string synopsis;
  // What the command does, in one or two sentences.
  std::string purpose;
  // In addition to --help and --quiet, which every command has.
  std::vector<OptionSpec> options;
  // A complete, working command.
  std::string example;
  // The number of words without options.
  std::size_t minArguments = 0;
  std::size_t maxArguments = SIZE_MAX;
};

// The parsed options and words of a command.
class CommandLine {
 public:
  // Throws UsageError. With --help it prints the help; then helpShown() is true, and the other
  // values are not valid.
  CommandLine(const CommandSpec& spec, const std::vector<std::string>& words);

  bool helpShown() const noexcept { return helpShown_; }
  const std::vector<std::string>& words() const noexcept { return words_; }
  bool has(const std::string& option) const { return values_.contains(option); }
  bool quiet() const { return has("quiet"); }
  // The value of an option (the last one when it is repeated); nothing when it is missing.
  std::optional<std::string> text(const std::string& option) const;
  std::vector<std::string> texts(const std::string& option) const;
  // All options that are given, by name.
  const std::map<std::string, std::vector<std::string>>& options() const noexcept {
    return values_;
  }
  // The value as a number in a range; throw UsageError that names the option and the range.
  std::optional<std::int64_t> integer(const std::string& option,
                                      std::int64_t least,
                                      std::int64_t most) const;
  std::optional<double> number(const std::string& option, double least, double most) const;
  std::optional<std::int64_t> integer(const std::string& option, OptionRange range) const;
  std::optional<double> number(const std::string& option, OptionRange range) const;
  // What the word stands for in a list of OptionWord; throws UsageError that lists the words.
  template <typename Words>
  auto chosen(const std::string& option, const Words& words) const
      -> std::optional<std::remove_cvref_t<decltype(std::begin(words)->second)>> {
    std::vector<std::string> known;
    for (const auto& each : words) known.emplace_back(each.first);
    const auto word = choice(option, known);
    if (!word) return std::nullopt;
    return (std::begin(words) + (std::find(known.begin(), known.end(), *word) - known.begin()))
        ->second;
  }
  // The value as one of the known words; throws UsageError that lists them.
  std::optional<std::string> choice(const std::string& option,
                                    const std::vector<std::string>& known) const;

 private:
  std::map<std::string, std::vector<std::string>> values_;
  std::vector<std::string> words_;
  bool helpShown_ = false;
};

namespace detail {
std::string longName(const std::string& name);
// "; 0.001..100, default 0.2", with the unit in front.
std::string rangeText(const OptionRange& range,
                      const std::optional<std::string>& usual,
                      bool isWhole);
// "squares (default), huber, cauchy; HELP"
std::string choiceText(const std::vector<std::string>& words,
                       const std::string& usual,
                       const std::string& help);
}  // namespace detail

template <typename T>
OptionSpec bound(const std::string& name,
                 std::string value,
                 std::string help,
                 T& field,
                 OptionRange range,
                 std::optional<std::string> usual) {
  constexpr bool isOptional = requires { field.has_value(); };
  using Number = typename decltype([] {
    if constexpr (isOptional)
      return std::type_identity<typename T::value_type>();
    else
      return std::type_identity<T>();
  }())::type;
  constexpr bool isWhole = std::is_integral_v<Number>;
  if constexpr (!isOptional)
    if (!usual) usual = isWhole ? std::to_string(field) : numberText(static_cast<double>(field));
  const auto take = [option = detail::longName(name), &field, range](const CommandLine& given) {
    if constexpr (isWhole) {
      if (const auto whole = given.integer(option, range)) field = static_cast<Number>(*whole);
    } else if (const auto number = given.number(option, range)) {
      field = static_cast<Number>(*number);
    }
  };
  return {name, std::move(value), std::move(help) + detail::rangeText(range, usual, isWhole), take};
}

template <typename Words>
OptionSpec worded(const std::string& name,
                  std::string value,
                  const std::string& help,
                  const Words& words,
                  const std::string& usual) {
  std::vector<std::string> known;
  for (const auto& each : words) known.emplace_back(each.first);
  return {name,
          std::move(value),
          detail::choiceText(known, usual, help),
          [option = detail::longName(name), known](const CommandLine& given) {
            given.choice(option, known);
          }};
}

template <typename T, typename Words>
OptionSpec boundChoice(const std::string& name,
                       std::string value,
                       const std::string& help,
                       T& field,
                       const Words& words,
                       const std::optional<std::string>& usual) {
  std::string word = usual.value_or("");
  if constexpr (!requires { field.has_value(); })
    for (const auto& each : words)
      if (!usual && each.second == field) word = each.first;
  OptionSpec spec = worded(name, std::move(value), help, words, word);
  spec.take = [option = detail::longName(name), &field, words](const CommandLine& given) {
    if (const auto chosen = given.chosen(option, words)) field = *chosen;
  };
  return spec;
}

// Shows a percentage on stderr when the work takes longer than a second; shows nothing when quiet
// or when stderr is not a terminal. It must outlive the callback.
class ProgressLine {
 public:
  ProgressLine(std::string label, bool quiet);
  // Clears the line.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  Progress callback();
  // Sets the text before the percentage.
  void setLabel(std::string label);
  // Clears the line until the next percentage, so that something else can be printed.
  void wipe();

 private:
  void show(double fraction);

  std::string label_;
  bool enabled_;
  bool shown_ = false;
  int lastPercent_ = -1;
  std::int64_t startUs_;
};

// Output could not be written; the input is not the cause.
class OutputError : public Error {
 public:
  using Error::Error;
};

// Buffered standard output. Both functions throw OutputError, for example for a full disk or a
// closed pipe.
class StandardOutput {
 public:
  void write(const std::string& text);
  void finish();

 private:
  std::string buffer_;
};

}  // namespace palpate::commands
