// Describes what a command accepts and parses what the user typed (by Boost.Program_options); also
// progress on stderr and buffered standard output for all commands.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <palpate/core/error.h>
#include <palpate/core/option_check.h>
#include <palpate/core/progress.h>

namespace palpate::commands {

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
// field, which must outlive it. The help names unit, range and default, which is the field's value
// as it is now (none of a std::optional).
template <typename T>
OptionSpec bound(
    const std::string& name, std::string value, std::string help, T& field, OptionRange range);
// A flag.
OptionSpec bound(const std::string& name, std::string help, bool& field);

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
  // The value as one of the known words; throws UsageError that lists them.
  std::optional<std::string> choice(const std::string& option,
                                    const std::vector<std::string>& known) const;

 private:
  std::map<std::string, std::vector<std::string>> values_;
  std::vector<std::string> words_;
  bool helpShown_ = false;
};

namespace detail {
std::string rangeText(const OptionRange& range, std::optional<double> usual, bool isWhole);
}  // namespace detail

template <typename T>
OptionSpec bound(
    const std::string& name, std::string value, std::string help, T& field, OptionRange range) {
  constexpr bool isOptional = requires { field.has_value(); };
  using Number = typename decltype([] {
    if constexpr (isOptional)
      return std::type_identity<typename T::value_type>();
    else
      return std::type_identity<T>();
  }())::type;
  std::optional<double> usual;
  if constexpr (!isOptional) usual = static_cast<double>(field);
  const auto take = [option = name.substr(0, name.find(',')), &field, range](const auto& given) {
    if constexpr (std::is_integral_v<Number>) {
      if (const auto whole = given.integer(option,
                                           static_cast<std::int64_t>(range.minimum),
                                           static_cast<std::int64_t>(range.maximum)))
        field = static_cast<Number>(*whole);
    } else if (const auto number = given.number(option, range.minimum, range.maximum)) {
      field = *number;
    }
  };
  return {name,
          std::move(value),
          std::move(help) + detail::rangeText(range, usual, std::is_integral_v<Number>),
          take};
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
