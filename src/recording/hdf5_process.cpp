#include "palpate/recording/hdf5_process.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

#include <poll.h>
#include <sys/socket.h>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/recording/hdf5_program.h"

#include "recording/hdf5_request.h"

namespace palpate {
namespace {

using SteadyClock = std::chrono::steady_clock;
using std::chrono::milliseconds;

// Of the processor for one request. A block of frames takes milliseconds; a piece of another
// program's file may need all of its chunks.
constexpr milliseconds kRecordingCpu{1'000};
constexpr milliseconds kImportCpu{10'000};
// Until the answer is there; on a busy machine that is longer.
constexpr milliseconds kValuesPatience{2'000};
constexpr milliseconds kOpeningPatience{10'000};
constexpr milliseconds kImportPatience{60'000};
// Until a program that is of no use any more has ended by itself.
constexpr milliseconds kEndingPatience{1'000};

milliseconds patienceFor(Hdf5Use use, Hdf5Request wanted) {
  if (use == Hdf5Use::kImport) return kImportPatience;
  return wanted == Hdf5Request::kRead ? kValuesPatience : kOpeningPatience;
}

}  // namespace

Hdf5Process::Hdf5Process(std::filesystem::path path, int descriptor, Hdf5Use use)
    : path_(std::move(path)), use_(use) {
  std::array<int, 2> sockets{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0)
    throw FileError(path_, "can't be read: " + std::generic_category().message(errno));
  socket_ = FileDescriptor(sockets[0]);
  {
    // Closed before anything is asked: what the program has closed must be closed altogether.
    const FileDescriptor theirs(sockets[1]);
    const milliseconds cpu = use == Hdf5Use::kImport ? kImportCpu : kRecordingCpu;
    try {
      program_.emplace(hdf5Program(),
                       std::vector<std::string>{std::to_string(cpu.count())},
                       std::vector<int>{theirs.get(), descriptor});
    } catch (const Error& error) {
      throw FileError(
          path_, std::string("HDF5 can't be read: ") + error.what() + "; install palpate again");
    }
  }
  ask(Hdf5Request::kOpen, {});  // throws where the library can't open the file
}

bool Hdf5Process::waitFor(short event) {
  for (;;) {
    const auto left = std::chrono::ceil<milliseconds>(deadline_ - SteadyClock::now());
    pollfd polled{socket_.get(), event, 0};
    const int ready =
        left > milliseconds::zero() ? ::poll(&polled, 1, static_cast<int>(left.count())) : 0;
    if (ready > 0) return true;
    isLate_ = ready == 0;
    if (isLate_ || errno != EINTR) return false;
  }
}

bool Hdf5Process::send(std::string_view bytes) {
  while (!bytes.empty()) {
    if (!waitFor(POLLOUT)) return false;
    const ssize_t sent =
        ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

bool Hdf5Process::receive(std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    if (!waitFor(POLLIN)) return false;
    const ssize_t got = ::recv(socket_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
  return true;
}

std::string Hdf5Process::ending(Hdf5Request wanted, const std::string& name) {
  constexpr int kKilledBy = 128;
  constexpr int kNotByItself = -1;
  int code = kNotByItself;
  // Nobody asks any more: it ends, if it can.
  socket_ = FileDescriptor();
  if (!isLate_) {
    const auto end = SteadyClock::now() + kEndingPatience;
    try {
      code = program_->finish([&] { return SteadyClock::now() < end; });
    } catch (const Error&) {  // it is killed
    }
  }
  program_.reset();
  if (code == kKilledBy + SIGKILL)
    return "can't be read: the program that reads it was ended by the system (out of memory?); try "
           "again";
  const bool tookTooLong = isLate_ || code == kKilledBy + SIGPROF;
  const bool wantedValues = wanted == Hdf5Request::kRead || wanted == Hdf5Request::kTexts;
  if (tookTooLong && use_ == Hdf5Use::kImport && wantedValues)
    return inQuotes(name) +
           " takes too long to read: its chunks don't match rows; write it again with larger "
           "chunks";
  std::string how = "crashed";
  if (tookTooLong)
    how = "took too long";
  else if (code == kHdf5MemoryExitCode)
    how = "needs more than " + std::to_string(kHdf5MemoryBytes >> 20) + " MB of memory";
  else if (code == kNotByItself)
    how = "gave no valid answer";
  return "libhdf5 could not read it (" + how +
         "): it is damaged, or was made to do that; use the recording or the data that it was "
         "exported from";
}

void Hdf5Process::throwEnded(Hdf5Request wanted, const std::string& name) {
  if (program_) fault_ = ending(wanted, name);
  throw FormatError(path_, fault_);
}

std::vector<std::byte> Hdf5Process::ask(Hdf5Request wanted,
                                        const std::string& name,
                                        std::string_view rest) {
  const std::lock_guard lock(mutex_);
  if (!program_) throwEnded(wanted, name);
  std::string request(1, static_cast<char>(wanted));
  appendText(request, name);
  request += rest;
  std::string sized;
  appendLittleEndian(sized, request.size(), 4);
  sized += request;
  if (sized.size() > kMaxHdf5RequestBytes) throw FormatError(path_, "has too long a name");
  deadline_ = SteadyClock::now() + patienceFor(use_, wanted);
  if (!send(sized)) throwEnded(wanted, name);
  std::array<std::byte, 5> head{};
  if (!receive(head)) throwEnded(wanted, name);
  ByteReader in(head);
  const std::uint32_t size = in.u32();
  const auto answer = static_cast<Hdf5Answer>(in.u8());
  if (size < 1 || size > kMaxHdf5AnswerBytes) throwEnded(wanted, name);
  std::vector<std::byte> value(size - 1);
  if (!receive(value)) throwEnded(wanted, name);
  if (answer == Hdf5Answer::kValue) return value;
  const std::string fault(reinterpret_cast<const char*>(value.data()), value.size());
  throw FormatError(path_, name.empty() ? fault : inQuotes(name) + " " + fault);
}

std::vector<std::string> Hdf5Process::namesAsked(Hdf5Request wanted, const std::string& name) {
  const std::vector<std::byte> value = ask(wanted, name);
  ByteReader in(value);
  std::vector<std::string> names;
  for (std::uint32_t count = in.u32(); count > 0 && in.ok(); --count) names.push_back(textFrom(in));
  return names;
}

std::vector<std::string> Hdf5Process::arrayNames() {
  return namesAsked(Hdf5Request::kArrayNames, {});
}

std::vector<std::string> Hdf5Process::axisNames(const std::string& name) {
  return namesAsked(Hdf5Request::kAxisNames, name);
}

bool Hdf5Process::has(const std::string& name) {
  const std::vector<std::byte> value = ask(Hdf5Request::kHas, name);
  return ByteReader(value).u8() != 0;
}

Hdf5Facts Hdf5Process::facts(const std::string& name) {
  const std::vector<std::byte> value = ask(Hdf5Request::kFacts, name);
  ByteReader in(value);
  Hdf5Facts facts;
  facts.kind = static_cast<Hdf5Kind>(in.u8());
  facts.typeName = textFrom(in);
  facts.shape.resize(in.u8());
  for (std::uint64_t& length : facts.shape) length = in.u64();
  facts.chunkLength = in.u64();
  facts.fault = textFrom(in);
  return facts;
}

void Hdf5Process::read(const std::string& name,
                       std::uint64_t first,
                       std::uint64_t count,
                       Hdf5Number type,
                       std::span<std::byte> out,
                       Hdf5Axis axis) {
  std::string rest;
  appendLittleEndian(rest, first, 8);
  appendLittleEndian(rest, count, 8);
  appendLittleEndian(rest, static_cast<std::uint8_t>(type), 1);
  appendLittleEndian(rest, static_cast<std::uint8_t>(axis), 1);
  const std::vector<std::byte> value = ask(Hdf5Request::kRead, name, rest);
  if (value.size() != out.size())
    throw FormatError(path_, inQuotes(name) + " can't be read: damaged or cut off");
  if (!out.empty()) std::memcpy(out.data(), value.data(), out.size());
}

std::vector<std::string> Hdf5Process::texts(const std::string& name,
                                            std::uint64_t first,
                                            std::uint64_t count,
                                            std::uint64_t longest) {
  std::string rest;
  appendLittleEndian(rest, first, 8);
  appendLittleEndian(rest, count, 8);
  appendLittleEndian(rest, longest, 8);
  const std::vector<std::byte> value = ask(Hdf5Request::kTexts, name, rest);
  ByteReader in(value);
  std::vector<std::string> texts;
  for (std::uint32_t number = in.u32(); number > 0 && in.ok(); --number)
    texts.push_back(textFrom(in));
  if (texts.empty()) throw FormatError(path_, inQuotes(name) + " can't be read: damaged");
  return texts;
}

std::optional<std::string> Hdf5Process::textAttribute(const std::string& object,
                                                      const std::string& name,
                                                      std::uint64_t longest) {
  std::string rest;
  appendText(rest, name);
  appendLittleEndian(rest, longest, 8);
  const std::vector<std::byte> value = ask(Hdf5Request::kTextAttribute, object, rest);
  ByteReader in(value);
  if (in.u8() == 0) return std::nullopt;
  return textFrom(in);
}

std::optional<std::int64_t> Hdf5Process::integerAttribute(const std::string& object,
                                                          const std::string& name) {
  std::string rest;
  appendText(rest, name);
  const std::vector<std::byte> value = ask(Hdf5Request::kIntegerAttribute, object, rest);
  ByteReader in(value);
  if (in.u8() == 0) return std::nullopt;
  return in.i64();
}

std::optional<double> Hdf5Process::numberAttribute(const std::string& object,
                                                   const std::string& name) {
  std::string rest;
  appendText(rest, name);
  const std::vector<std::byte> value = ask(Hdf5Request::kNumberAttribute, object, rest);
  ByteReader in(value);
  if (in.u8() == 0) return std::nullopt;
  return in.f64();
}

}  // namespace palpate
