// Input, timing and binary records of the emulated motion controller; sdh_command_processor.cpp
// executes the commands.
#include "palpate/emulator/sdh_server.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "palpate/core/byte_reader.h"
#include "palpate/core/number_text.h"
#include "palpate/device/weiss_checksum.h"

#include "emulator/sdh_command_processor.h"
#include "emulator/wire_writer.h"

namespace palpate {
namespace {

constexpr std::size_t kMaxInputBytes = 4096;
constexpr std::int64_t kMotionCheckUs = 5000;
// A motion that doesn't end (a finger that stays blocked) counts as ended this time after its
// expected end [s].
constexpr double kMotionPatienceS = 2.0;

bool isBinary(std::byte b) { return (b & std::byte{0x80}) != std::byte{0}; }
bool isLineEnd(std::byte b) { return b == std::byte{'\r'} || b == std::byte{'\n'}; }
bool isBlank(std::byte b) { return b == std::byte{' '} || b == std::byte{'\t'}; }

}  // namespace

SdhServer::SdhServer(HandModel& model, const SdhServerOptions& options)
    : model_(model),
      options_(options),
      motion_(std::make_unique<SdhCommandProcessor>(model, options)),
      random_(options.seed) {
  if (!(options.minResponseDelayUs >= 0.0 &&
        options.maxResponseDelayUs >= options.minResponseDelayUs))
    throw std::invalid_argument("think times " + numberText(options.minResponseDelayUs) + ".." +
                                numberText(options.maxResponseDelayUs) + " us");
  bootEndUs_ = static_cast<std::int64_t>(std::max(options.bootS, 0.0) * 1e6);
}

SdhServer::~SdhServer() = default;

void SdhServer::powerCycle(std::int64_t nowUs, double bootS) {
  input_.clear();
  pending_.reset();
  answerAfterMotion_.clear();
  discarding_ = tooLong_ = false;
  nowUs_ = std::max(nowUs_, nowUs);
  bootEndUs_ = nowUs + static_cast<std::int64_t>(std::max(bootS, 0.0) * 1e6);
  motion_->powerCycle();
}

void SdhServer::receive(std::span<const std::byte> bytes, std::int64_t nowUs) {
  nowUs_ = std::max(nowUs_, nowUs);
  if (nowUs_ < bootEndUs_) return;
  for (const std::byte b : bytes) {
    if (discarding_ && isLineEnd(b)) discarding_ = false;
    if (discarding_) continue;
    if (input_.size() == kMaxInputBytes) advance(nowUs_);
    if (input_.size() < kMaxInputBytes) {
      input_.push_back(b);
    } else {
      ++lostBytes_;
    }
  }
  advance(nowUs_);
}

bool SdhServer::hasPartialRequest() const noexcept {
  return discarding_ ||
         (!pending_ && answerAfterMotion_.empty() && !input_.empty() && isBinary(input_.front()));
}

void SdhServer::onReceiveTimeout() {
  if (!hasPartialRequest()) return;
  discarding_ = false;
  input_.clear();
}

std::size_t SdhServer::recordBytes(bool set) const noexcept {
  return 3 + (set ? 4 * kSdhRecordAxes : 0) + (options_.checksum ? 2 : 0);
}

std::optional<SdhServer::Command> SdhServer::nextRecord() {
  if (input_.size() < 3) return std::nullopt;
  const auto length = std::to_integer<std::size_t>(input_[1]);
  const auto count = std::to_integer<std::size_t>(input_[2]);
  const std::size_t total = recordBytes(count == kSdhRecordAxes);
  if ((count != 0 && count != kSdhRecordAxes) || length != total - 2) {
    // The begin of the next command is unknown: all input is skipped up to the end of a line, or
    // until the client is silent.
    Command garbage;
    garbage.record = {input_[0]};
    garbage.refusal = kSdhFormatError;
    const auto end = std::find_if(input_.begin(), input_.end(), isLineEnd);
    discarding_ = end == input_.end();
    input_.erase(input_.begin(), end);
    return garbage;
  }
  if (input_.size() < total) return std::nullopt;
  Command command;
  const auto end = input_.begin() + static_cast<std::ptrdiff_t>(total);
  command.record.assign(input_.begin(), end);
  input_.erase(input_.begin(), end);
  return command;
}

std::optional<SdhServer::Command> SdhServer::nextLine() {
  const auto end = std::find_if(
      input_.begin(), input_.end(), [](std::byte b) { return isLineEnd(b) || isBinary(b); });
  const auto length = static_cast<std::size_t>(end - input_.begin());
  if (end == input_.end()) {
    // A line that is too long is answered when its end has arrived.
    if (length > kSdhMaxLine) {
      tooLong_ = true;
      input_.clear();
    }
    return std::nullopt;
  }
  const bool cut = isBinary(*end);  // the line's end was lost, a record follows
  Command command;
  if (!cut) {
    for (auto b = input_.begin(); b != end; ++b) command.line.push_back(std::to_integer<char>(*b));
    if (tooLong_ || length > kSdhMaxLine) command.refusal = kSdhLineTooLong;
  }
  tooLong_ = false;
  input_.erase(input_.begin(), cut ? end : end + 1);
  return command;
}

std::optional<SdhServer::Command> SdhServer::next() {
  while (!input_.empty()) {
    if (!tooLong_ && (isBlank(input_.front()) || isLineEnd(input_.front()))) {
      input_.pop_front();
      continue;
    }
    auto command = isBinary(input_.front()) ? nextRecord() : nextLine();
    if (!command) return std::nullopt;
    if (!command->record.empty() || !command->line.empty() || command->refusal) return command;
  }
  return std::nullopt;
}

void SdhServer::start(Command command) {
  const std::size_t bytes =
      command.record.empty() ? command.line.size() + 2 : command.record.size();
  double us = options_.requestByteUs * static_cast<double>(bytes);
  if (options_.maxResponseDelayUs > 0.0)
    us += std::uniform_real_distribution<double>(options_.minResponseDelayUs,
                                                 options_.maxResponseDelayUs)(random_);
  pending_ = Pending{std::move(command), nowUs_ + static_cast<std::int64_t>(us)};
}

void SdhServer::advance(std::int64_t nowUs) {
  nowUs_ = std::max(nowUs_, nowUs);
  for (;;) {
    if (!answerAfterMotion_.empty()) {
      if (nowUs_ < motionCheckUs_) return;
      endMotion();
      if (!answerAfterMotion_.empty()) return;
    }
    if (!pending_) {
      auto command = next();
      if (!command) return;
      start(std::move(*command));
    }
    if (pending_->dueUs > nowUs_) return;
    const Command command = std::move(pending_->command);
    pending_.reset();
    model_.advanceTo(static_cast<double>(nowUs_) * 1e-6);
    execute(command);
  }
}

std::optional<std::int64_t> SdhServer::nextUs() const {
  if (!answerAfterMotion_.empty()) return motionCheckUs_;
  if (pending_) return pending_->dueUs;
  return std::nullopt;
}

void SdhServer::endMotion() {
  model_.advanceTo(static_cast<double>(nowUs_) * 1e-6);
  if (motion_->moving() && nowUs_ < motionEndsUs_) {
    motionCheckUs_ = nowUs_ + kMotionCheckUs;
    return;
  }
  sendText(std::exchange(answerAfterMotion_, {}));
}

void SdhServer::execute(const Command& command) {
  if (!command.record.empty()) {
    if (command.refusal)
      return sendRecord(std::to_integer<unsigned>(command.record[0]), *command.refusal, {});
    return executeRecord(command.record);
  }
  if (command.refusal) return sendText("E" + std::to_string(*command.refusal));
  executeLine(command.line);
}

void SdhServer::executeLine(const std::string& line) {
  try {
    const SdhAnswer answer = motion_->execute(line);
    if (!answer.afterMotion) return sendText(answer.text);
    answerAfterMotion_ = answer.text;
    motionCheckUs_ = nowUs_ + static_cast<std::int64_t>(answer.durationS * 1e6);
    motionEndsUs_ = motionCheckUs_ + static_cast<std::int64_t>(kMotionPatienceS * 1e6);
  } catch (const SdhRefusal& refusal) {
    sendText("E" + std::to_string(refusal.code));
  }
}

void SdhServer::executeRecord(std::span<const std::byte> record) {
  ByteReader in(record);
  const unsigned number = in.u8();
  in.u8();
  const std::size_t count = in.u8();
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(static_cast<double>(in.f32()));
  try {
    if (options_.checksum && in.u16() != weissChecksum(record.first(record.size() - 2)))
      throw SdhRefusal{kSdhChecksumError};
    const SdhAxisVariable* quantity = motion_->quantity(number);
    if (!quantity) throw SdhRefusal{kSdhUnknownCommand};
    // For a hand with fewer axes the remaining values have no meaning.
    values.resize(std::min(values.size(), model_.hand().axes.size()));
    sendRecord(number, 0, count == 0 ? motion_->get(*quantity) : motion_->set(*quantity, values));
  } catch (const SdhRefusal& refusal) {
    sendRecord(number, refusal.code, {});
  }
}

void SdhServer::sendText(const std::string& text) {
  output_.push_back({.bytes = std::move(WireWriter().text(text).text("\r\n").data())});
}

void SdhServer::sendRecord(unsigned command, unsigned status, const std::vector<double>& values) {
  WireWriter out;
  out.u8(command).u8(2 + 4 * kSdhRecordAxes + (options_.checksum ? 2 : 0)).u8(kSdhRecordAxes);
  out.u8(status);
  for (std::size_t i = 0; i < kSdhRecordAxes; ++i) out.f32(i < values.size() ? values[i] : 0.0);
  if (options_.checksum) out.u16(weissChecksum(out.data()));
  output_.push_back({.bytes = std::move(out.data()), .checksummed = options_.checksum});
}

std::vector<LineMessage> SdhServer::take() { return std::exchange(output_, {}); }

}  // namespace palpate
