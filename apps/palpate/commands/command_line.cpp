#include "commands/command_line.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <system_error>

#include <boost/program_options.hpp>
#include <sys/ioctl.h>
#include <unistd.h>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"

namespace palpate::commands {
namespace po = boost::program_options;

void sayLine(std::string_view message) {
  std::fprintf(stderr, "palpate: %s\n", escapedLine(message).c_str());
}

std::string detail::longName(const std::string& name) { return name.substr(0, name.find(',')); }

namespace {

using detail::longName;

// A synopsis of several lines as one line.
std::string inOneLine(const std::string& synopsis) {
  std::string line;
  for (std::size_t at = 0; at < synopsis.size();) {
    const std::size_t end = std::min(synopsis.find('\n', at), synopsis.size());
    line += (line.empty() ? "" : " | ") + std::string(trimmed(synopsis.substr(at, end - at)));
    at = end + 1;
  }
  return line;
}

// The words of a synopsis that name its command: "palpate calibrate noise".
std::string commandIn(const std::string& synopsis) {
  std::istringstream words(synopsis);
  std::string command;
  for (std::string word; words >> word && std::islower(static_cast<unsigned char>(word[0]));)
    command += (command.empty() ? "" : " ") + word;
  return command;
}

po::options_description described(const CommandSpec& spec) {
  po::options_description options("Options");
  const auto add = [&](const OptionSpec& option) {
    if (option.value.empty())
      options.add_options()(option.name.c_str(), option.help.c_str());
    else
      options.add_options()(option.name.c_str(),
                            po::value<std::vector<std::string>>()->value_name(option.value),
                            option.help.c_str());
  };
  for (const OptionSpec& option : spec.options) add(option);
  add({"quiet,q", "", "no progress and no remarks; errors are still printed", {}});
  add({"help,h", "", "this text", {}});
  return options;
}

constexpr std::size_t kHelpWidth = 79;  // columns; Boost lays out the options for 80

// The column at which the text of a row "  NAME  text" begins; of another indented line that of its
// first letter.
std::size_t hangingIndent(const std::string& line) {
  const std::size_t name = line.find_first_not_of(' ');
  const std::size_t gap = line.find("  ", name);
  const std::size_t text = gap == std::string::npos ? gap : line.find_first_not_of(' ', gap);
  return text == std::string::npos ? name : text;
}

// Lines of at most kHelpWidth columns; further ones are indented like the text of the first. A
// number stays next to its unit.
std::string wrapped(const std::string& line) {
  if (line.size() <= kHelpWidth) return line + "\n";
  const bool indented = line.front() == ' ';
  const std::size_t hang = indented ? hangingIndent(line) : 0;
  std::string text, current = line.substr(0, hang);
  std::istringstream words(line.substr(hang));
  bool first = true;
  for (std::string word, more; words >> word; first = false) {
    while (word.find_first_not_of("0123456789.") == std::string::npos && words >> more)
      word += " " + more;
    if (!first && current.size() + 1 + word.size() > kHelpWidth) {
      text += current + "\n";
      current = std::string(hang, ' ');
      first = true;
    }
    current += (first ? "" : " ") + word;
  }
  return text + current + "\n";
}

// Each line of `text` is a paragraph or a row of a table.
std::string wrappedLines(const std::string& text) {
  std::istringstream lines(text);
  std::string all;
  for (std::string line; std::getline(lines, line);) all += wrapped(line);
  return all;
}

void commandLineShowHelp(const CommandSpec& spec, const po::options_description& options) {
  std::ostringstream text;
  text << "Usage: " << spec.synopsis << "\n\n" << wrappedLines(spec.purpose) << "\n" << options;
  text << "\nExample:\n  " << spec.example << "\n";
  std::cout << text.str() << std::flush;
}

constexpr std::size_t kPercentWidth = 8;  // ": 100 %", and the last column stays free

// Columns of the terminal on stderr; 80 when they are unknown.
std::size_t terminalWidth() {
  winsize size{};
  const bool known =
      ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 2 * kPercentWidth;
  return known ? size.ws_col : 80;
}

constexpr std::int64_t kShowProgressAfterUs = 1'000'000;

}  // namespace

std::string detail::rangeText(const OptionRange& range,
                              const std::optional<std::string>& usual,
                              bool isWhole) {
  std::string text = *range.unit ? std::string(" [") + range.unit + "]" : "";
  const bool isOpen =
      isWhole ? range.maximum >= static_cast<double>(INT32_MAX) : !std::isfinite(range.maximum);
  const auto textOf = [&](double value) {
    return isWhole ? std::to_string(static_cast<std::int64_t>(value)) : numberText(value);
  };
  text += isOpen ? "; from " + textOf(range.minimum)
                 : "; " + textOf(range.minimum) + ".." + textOf(range.maximum);
  return usual && !usual->empty() ? text + ", default " + *usual : text;
}

std::string detail::choiceText(const std::vector<std::string>& words,
                               const std::string& usual,
                               const std::string& help) {
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : ", ") + word + (word == usual ? " (default)" : "");
  const bool isWord = std::find(words.begin(), words.end(), usual) != words.end();
  if (!usual.empty() && !isWord) text += " (default " + usual + ")";
  return help.empty() ? text : text + "; " + help;
}

OptionSpec bound(const std::string& name, std::string help, bool& field) {
  return {name, "", std::move(help), [option = longName(name), &field](const CommandLine& given) {
            if (given.has(option)) field = true;
          }};
}

OptionSpec bound(const std::string& name,
                 std::string value,
                 std::string help,
                 std::optional<std::string>& field) {
  return {name,
          std::move(value),
          std::move(help),
          [option = longName(name), &field](const CommandLine& given) {
            if (given.has(option)) field = given.text(option);
          }};
}

OptionSpec ranged(const std::string& name,
                  std::string value,
                  std::string help,
                  OptionRange range,
                  const std::optional<std::string>& usual) {
  return {
      name,
      std::move(value),
      std::move(help) + detail::rangeText(range, usual, false),
      [option = longName(name), range](const CommandLine& given) { given.number(option, range); }};
}

OptionSpec rangedWhole(const std::string& name,
                       std::string value,
                       std::string help,
                       OptionRange range,
                       const std::optional<std::string>& usual) {
  return {
      name,
      std::move(value),
      std::move(help) + detail::rangeText(range, usual, true),
      [option = longName(name), range](const CommandLine& given) { given.integer(option, range); }};
}

OptionSpec topicOption() {
  return {"topic",
          "TOPIC",
          "of an MCAP file of another program: reads only this topic; may be repeated"};
}

CommandLine::CommandLine(const CommandSpec& spec, const std::vector<std::string>& words) {
  const po::options_description options = described(spec);
  po::options_description all = options;
  all.add_options()("word", po::value<std::vector<std::string>>());
  po::positional_options_description positions;
  positions.add("word", -1);
  try {
    // Abbreviated options are refused, so that a script keeps its meaning when an option is added.
    const int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
    const auto parsed =
        po::command_line_parser(words).options(all).positional(positions).style(style).run();
    for (const auto& option : parsed.options) {
      const std::string name = longName(option.string_key);
      if (name == "word")
        words_.insert(words_.end(), option.value.begin(), option.value.end());
      else
        values_[name].insert(values_[name].end(), option.value.begin(), option.value.end());
    }
  } catch (const po::error& error) {
    throw UsageError(error.what() +
                     ("; '" + commandIn(spec.synopsis) + " --help' lists the options"));
  }
  if (has("help")) {
    commandLineShowHelp(spec, options);
    helpShown_ = true;
    return;
  }
  for (const std::string& word : words_) {
    if (word.empty()) throw UsageError("an empty file name");
    if (word == "-") throw UsageError("'-': a recording is read from a file, not from a stream");
  }
  if (words_.size() > spec.maxArguments)
    throw UsageError("'" + words_[spec.maxArguments] +
                     "' is one argument too many; usage: " + inOneLine(spec.synopsis));
  if (words_.size() < spec.minArguments) throw UsageError("usage: " + inOneLine(spec.synopsis));
  for (const OptionSpec& option : spec.options)
    if (option.take) option.take(*this);
}

std::optional<std::string> CommandLine::text(const std::string& option) const {
  const auto found = values_.find(option);
  if (found == values_.end() || found->second.empty()) return std::nullopt;
  return found->second.back();
}

std::vector<std::string> CommandLine::texts(const std::string& option) const {
  const auto found = values_.find(option);
  return found == values_.end() ? std::vector<std::string>{} : found->second;
}

std::optional<std::int64_t> CommandLine::integer(const std::string& option,
                                                 std::int64_t least,
                                                 std::int64_t most) const {
  const auto given = text(option);
  if (!given) return std::nullopt;
  const auto value = parseInteger(*given);
  if (!value || *value < least || *value > most)
    throw UsageError("--" + option + " must be a whole number " + std::to_string(least) +
                     (most == INT64_MAX ? " or above" : ".." + std::to_string(most)) + ", not '" +
                     *given + "'");
  return value;
}

std::optional<double> CommandLine::number(const std::string& option,
                                          double least,
                                          double most) const {
  const auto given = text(option);
  if (!given) return std::nullopt;
  const auto value = parseDouble(*given);
  if (!value || !(*value >= least && *value <= most))
    throw UsageError("--" + option + " must be a number " + numberText(least) + ".." +
                     numberText(most) + ", not '" + *given + "'");
  return value;
}

std::optional<std::int64_t> CommandLine::integer(const std::string& option,
                                                 OptionRange range) const {
  // 2^63 as a double is above the largest whole number.
  const auto whole = [](double value) {
    return value >= 0x1p63 ? INT64_MAX : static_cast<std::int64_t>(value);
  };
  return integer(option, whole(range.minimum), whole(range.maximum));
}

std::optional<double> CommandLine::number(const std::string& option, OptionRange range) const {
  return number(option, range.minimum, range.maximum);
}

std::optional<std::string> CommandLine::choice(const std::string& option,
                                               const std::vector<std::string>& known) const {
  const auto given = text(option);
  if (!given) return std::nullopt;
  std::string list;
  for (const std::string& word : known) {
    if (*given == word) return given;
    list += (list.empty() ? "" : ", ") + word;
  }
  throw UsageError("--" + option + " must be one of " + list + ", not '" + *given + "'");
}

ProgressLine::ProgressLine(std::string label, bool quiet)
    : label_(std::move(label)),
      enabled_(!quiet && ::isatty(STDERR_FILENO) == 1),
      startUs_(systemClock().monotonicUs()) {}

ProgressLine::~ProgressLine() { wipe(); }

void ProgressLine::wipe() {
  if (shown_) std::fputs("\r\033[K", stderr);
  shown_ = false;
  lastPercent_ = -1;
}

void ProgressLine::setLabel(std::string label) {
  label_ = std::move(label);
  lastPercent_ = -1;
}

Progress ProgressLine::callback() {
  if (!enabled_) return {};
  return [this](double fraction) {
    show(fraction);
    return true;
  };
}

void ProgressLine::show(double fraction) {
  if (systemClock().monotonicUs() - startUs_ < kShowProgressAfterUs) return;
  const int percent = static_cast<int>(std::floor(100.0 * fraction));
  if (percent == lastPercent_) return;
  lastPercent_ = percent;
  shown_ = true;
  // The label is shortened, because a wrapped line could not be cleared.
  const std::string label(beginningOf(label_, terminalWidth() - kPercentWidth));
  std::fprintf(stderr, "\r%s: %d %%\033[K", label.c_str(), percent);
  std::fflush(stderr);
}

void StandardOutput::write(const std::string& text) {
  constexpr std::size_t kPiece = 1u << 16;
  buffer_ += text;
  if (buffer_.size() >= kPiece) finish();
}

void StandardOutput::finish() {
  const std::size_t written = std::fwrite(buffer_.data(), 1, buffer_.size(), stdout);
  if (written != buffer_.size() || std::fflush(stdout) != 0)
    throw OutputError("standard output can't be written: " +
                      std::generic_category().message(errno));
  buffer_.clear();
}

}  // namespace palpate::commands
