// What one command accepts, and what it was given. Parsing is Boost.Program_options' work.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <palpate/core/error.h>
#include <palpate/core/progress.h>

namespace palpate::commands {

// Wrong usage: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct OptionSpec {
  std::string name;   // "frame", or "output,o" with a short form
  std::string value;  // what its value is called in the help ("N"); empty: a flag
  std::string help;
};

struct CommandSpec {
  std::string synopsis;             // "palpate info FILE [--json]"
  std::string purpose;              // a sentence or two
  std::vector<OptionSpec> options;  // besides --help and --quiet, which every command has
  std::string example;              // a command that works
  std::size_t minArguments = 0;     // besides options
  std::size_t maxArguments = SIZE_MAX;
};

// What the command was given.
class CommandLine {
 public:
  // Throws UsageError. With --help, prints the help; then helpShown() is true and nothing else
  // counts.
  CommandLine(const CommandSpec& spec, const std::vector<std::string>& words);

  bool helpShown() const noexcept { return helpShown_; }
  const std::vector<std::string>& words() const noexcept { return words_; }
  bool has(const std::string& option) const { return values_.contains(option); }
  bool quiet() const { return has("quiet"); }
  // The option's value (the last one given); nothing when absent.
  std::optional<std::string> text(const std::string& option) const;
  std::vector<std::string> texts(const std::string& option) const;
  // As numbers in a range; throw UsageError naming the option and the range.
  std::optional<std::int64_t> integer(const std::string& option,
                                      std::int64_t least,
                                      std::int64_t most) const;
  std::optional<double> number(const std::string& option, double least, double most) const;
  // One of the given words; throws UsageError naming them all.
  std::optional<std::string> choice(const std::string& option,
                                    const std::vector<std::string>& known) const;

 private:
  std::map<std::string, std::vector<std::string>> values_;
  std::vector<std::string> words_;
  bool helpShown_ = false;
};

// Shows a percentage on stderr for work that takes over a second; silent when quiet or when stderr
// is no terminal. Keep it alive while the callback is used.
class ProgressLine {
 public:
  ProgressLine(std::string label, bool quiet);
  ~ProgressLine();  // wipes the line
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  Progress callback();
  // What comes before the percentage, from now on.
  void setLabel(std::string label);
  // Takes the line away until there is a new figure: something else is about to be printed.
  void wipe();

 private:
  void show(double fraction);

  std::string label_;
  bool enabled_;
  bool shown_ = false;
  int lastPercent_ = -1;
  std::int64_t startUs_;
};

// What was to be printed could not be: no fault of the input.
class OutputError : public Error {
 public:
  using Error::Error;
};

// Standard output in large pieces. Both throw OutputError: a full disk, a closed pipe.
class StandardOutput {
 public:
  void write(const std::string& text);
  void finish();

 private:
  std::string buffer_;
};

}  // namespace palpate::commands
