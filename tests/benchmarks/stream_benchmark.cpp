// What a stream costs: 512 taxels at 1 kHz as packets over TCP on loopback, and 256 taxels at 100
// Hz as lines over a pty, received and recorded for a minute, as share of one core (target: under
// 15 %, nothing lost), and beside it a program that only reads the same bytes at the same pace. The
// sender is a process of its own. Then the parsers alone, next to the checksum alone and to strtof
// on the same bytes.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <benchmark/benchmark.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>
#include <zlib.h>

#include "palpate/capture/capture_session.h"
#include "palpate/core/file_descriptor.h"
#include "palpate/device/stream_device.h"
#include "palpate/device/stream_packets.h"
#include "palpate/recording/recording.h"

#include "device/stream_hands.h"
#include "testing/awaited.h"
#include "testing/testing.h"

namespace {
using namespace palpate;
using namespace palpate::testing;

constexpr double kSeconds = 60.0;

// Two contacts that move over the places; the others are untouched.
std::vector<float> contactValues(std::size_t places, std::size_t n) {
  std::vector<float> values(places);
  for (std::size_t k = 0; k < places / 8; ++k)
    values[(n / 10 + k) % places] = static_cast<float>((n * 31 + k * 97) % 1500);
  return values;
}

std::vector<std::string> packetTexts(std::size_t places, std::size_t count) {
  std::vector<std::string> texts;
  for (std::size_t n = 0; n < count; ++n) {
    std::vector<std::byte> bytes;
    appendStreamFrame(bytes, static_cast<std::uint32_t>(n), 1000 * n, contactValues(places, n));
    texts.emplace_back(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  return texts;
}

std::vector<std::string> lineTexts(std::size_t places, std::size_t count) {
  std::vector<std::string> texts;
  for (std::size_t n = 0; n < count; ++n) {
    std::string text = "frame#" + std::to_string(n) + "," + std::to_string(10 * n);
    for (const float value : contactValues(places, n))
      text += "," + std::to_string(static_cast<int>(value));
    texts.push_back(text + "\n");
  }
  return texts;
}

double usedCpuS() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) / 1e9;
}

// Sends each text when it is due. Runs in a child process: calls the system only.
void sendPaced(int fd, const std::vector<std::string>& texts, std::int64_t periodNs) {
  timespec due{};
  ::clock_gettime(CLOCK_MONOTONIC, &due);
  for (const std::string& text : texts) {
    for (std::size_t at = 0; at < text.size();) {
      const ssize_t sent = ::write(fd, text.data() + at, text.size() - at);
      if (sent <= 0) ::_exit(1);
      at += static_cast<std::size_t>(sent);
    }
    due.tv_nsec += periodNs;
    for (; due.tv_nsec >= 1'000'000'000; due.tv_nsec -= 1'000'000'000) ++due.tv_sec;
    ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr);
  }
  ::pause();  // the connection stays open
}

// Waits at the sender's pace for `bytes` bytes and throws them away: what reading alone costs, as
// share of a core. -1 when the bytes do not come.
double percentOfReading(int fd, std::size_t bytes, pid_t sender) {
  const double before = usedCpuS();
  timespec begin{}, done{};
  ::clock_gettime(CLOCK_MONOTONIC, &begin);
  std::vector<char> buffer(1 << 16);
  constexpr int kPatienceMs = 20'000;
  pollfd readable{fd, POLLIN, 0};
  std::size_t got = 0;
  while (got < bytes && ::poll(&readable, 1, kPatienceMs) == 1) {
    const ssize_t n = ::read(fd, buffer.data(), buffer.size());
    if (n <= 0) break;
    got += static_cast<std::size_t>(n);
  }
  ::clock_gettime(CLOCK_MONOTONIC, &done);
  const double used = usedCpuS() - before;
  ::kill(sender, SIGKILL);
  ::waitpid(sender, nullptr, 0);
  if (got < bytes) return -1.0;
  return 100.0 * used /
         (static_cast<double>(done.tv_sec - begin.tv_sec) +
          static_cast<double>(done.tv_nsec - begin.tv_nsec) / 1e9);
}

// The reference lasts shorter: its pace is the same.
constexpr std::size_t kReferenceParts = 4;

std::vector<std::string> firstPart(const std::vector<std::string>& texts) {
  return {texts.begin(),
          texts.begin() + static_cast<std::ptrdiff_t>(texts.size() / kReferenceParts)};
}

std::size_t bytesOf(const std::vector<std::string>& texts) {
  std::size_t bytes = 0;
  for (const std::string& text : texts) bytes += text.size();
  return bytes;
}

// Largest time from one frame of a recording to the next, less the period [ms].
double latestMs(const std::filesystem::path& path, std::int64_t periodNs) {
  const Profile profile = openRecording(path);
  std::int64_t longestUs = 0;
  for (std::size_t n = 1; n < profile.numFrames(); ++n)
    longestUs = std::max(longestUs, profile.frameTimeUs(n) - profile.frameTimeUs(n - 1));
  return static_cast<double>(longestUs - periodNs / 1000) / 1000.0;
}

// `connect` opens the sender's end in the child. Texts are as many as frames.
template <typename Connect>
void receiveAndRecord(benchmark::State& state,
                      const StreamDeviceOptions& options,
                      const std::vector<std::string>& texts,
                      std::int64_t periodNs,
                      std::size_t notReceived,
                      const Connect& connect) {
  for (auto _ : state) {
    const TemporaryFolder folder;
    auto owned = std::make_unique<StreamDevice>(options);
    const StreamDevice& device = *owned;
    CaptureSession session(std::move(owned));
    RecordingOptions recording;
    recording.path = folder / "a.palpate";
    session.startRecording(recording);
    session.start();
    const bool isReady = awaited([&] {
      return device.localPort() || device.status().tactile.state == PortState::kStreaming;
    });
    if (!isReady) return state.SkipWithError("the stream was not opened");
    const std::uint16_t port = device.localPort().value_or(0);
    const double before = usedCpuS();
    timespec begin{};
    ::clock_gettime(CLOCK_MONOTONIC, &begin);
    const pid_t sender = ::fork();
    if (sender == 0) sendPaced(connect(port), texts, periodNs);
    const std::size_t expected = texts.size() - notReceived;
    const auto limit = std::chrono::milliseconds(
        static_cast<std::int64_t>(texts.size()) * periodNs / 1'000'000 + 20'000);
    // Looks ten times a second, so that looking costs nothing.
    const auto end = std::chrono::steady_clock::now() + limit;
    while (device.status().tactile.items < expected && std::chrono::steady_clock::now() < end)
      ::usleep(100'000);
    timespec done{};
    ::clock_gettime(CLOCK_MONOTONIC, &done);
    const double used = usedCpuS() - before;
    const PortStatus status = device.status().tactile;
    ::kill(sender, SIGKILL);
    ::waitpid(sender, nullptr, 0);
    session.stop();
    const RecordingReport report = session.stopRecording();
    const double seconds = static_cast<double>(done.tv_sec - begin.tv_sec) +
                           static_cast<double>(done.tv_nsec - begin.tv_nsec) / 1e9;
    state.SetIterationTime(seconds);
    state.counters["percent_of_a_core"] = 100.0 * used / seconds;
    state.counters["frames"] = static_cast<double>(report.frames);
    state.counters["latest_ms"] = latestMs(folder / "a.palpate", periodNs);
    state.counters["lost"] =
        static_cast<double>(status.lost + status.suspect + status.badChecksums +
                            static_cast<std::uint64_t>(report.lost + report.refused) +
                            (expected - static_cast<std::size_t>(std::min<std::int64_t>(
                                            report.frames, static_cast<std::int64_t>(expected)))));
  }
}

// A sender's connection to a port of this machine.
int connectedTo(std::uint16_t port) {
  const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(port);
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(fd, reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0) ::_exit(1);
  return fd;
}

void streamPacketsRecorded(benchmark::State& state) {
  StreamDeviceOptions options;
  options.source = "listen:0";
  options.hand = padHand({{16, 16}, {16, 16}});
  receiveAndRecord(state,
                   options,
                   packetTexts(512, static_cast<std::size_t>(kSeconds * 1000.0)),
                   1'000'000,
                   0,
                   connectedTo);
}
BENCHMARK(streamPacketsRecorded)->UseManualTime()->Iterations(1)->Unit(benchmark::kSecond);

void streamPacketsRead(benchmark::State& state) {
  const std::vector<std::string> texts =
      firstPart(packetTexts(512, static_cast<std::size_t>(kSeconds * 1000.0)));
  for (auto _ : state) {
    const FileDescriptor listener(::socket(AF_INET, SOCK_STREAM, 0));
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof place;
    auto* generic = reinterpret_cast<sockaddr*>(&place);
    if (::bind(listener.get(), generic, size) != 0 || ::listen(listener.get(), 1) != 0 ||
        ::getsockname(listener.get(), generic, &size) != 0)
      return state.SkipWithError("no port");
    const pid_t sender = ::fork();
    if (sender == 0) sendPaced(connectedTo(ntohs(place.sin_port)), texts, 1'000'000);
    const FileDescriptor client(::accept(listener.get(), nullptr, nullptr));
    const double percent = percentOfReading(client.get(), bytesOf(texts), sender);
    if (percent < 0.0) return state.SkipWithError("bytes are missing");
    state.SetIterationTime(kSeconds / static_cast<double>(kReferenceParts));
    state.counters["percent_of_a_core"] = percent;
  }
}
BENCHMARK(streamPacketsRead)->UseManualTime()->Iterations(1)->Unit(benchmark::kSecond);

void streamLinesRead(benchmark::State& state) {
  const std::vector<std::string> texts =
      firstPart(lineTexts(256, static_cast<std::size_t>(kSeconds * 100.0)));
  for (auto _ : state) {
    int master = -1, slave = -1;
    if (::openpty(&master, &slave, nullptr, nullptr, nullptr) != 0)
      return state.SkipWithError("no pty");
    const FileDescriptor sending(master), receiving(slave);
    termios settings{};
    ::tcgetattr(slave, &settings);
    ::cfmakeraw(&settings);
    ::tcsetattr(slave, TCSANOW, &settings);
    const pid_t sender = ::fork();
    if (sender == 0) sendPaced(master, texts, 10'000'000);
    const double percent = percentOfReading(slave, bytesOf(texts), sender);
    if (percent < 0.0) return state.SkipWithError("bytes are missing");
    state.SetIterationTime(kSeconds / static_cast<double>(kReferenceParts));
    state.counters["percent_of_a_core"] = percent;
  }
}
BENCHMARK(streamLinesRead)->UseManualTime()->Iterations(1)->Unit(benchmark::kSecond);

void streamLinesRecorded(benchmark::State& state) {
  int master = -1;
  int slave = -1;
  char name[128] = {};
  if (::openpty(&master, &slave, name, nullptr, nullptr) != 0) return state.SkipWithError("no pty");
  termios settings{};
  ::tcgetattr(slave, &settings);
  ::cfmakeraw(&settings);
  ::tcsetattr(slave, TCSANOW, &settings);
  StreamDeviceOptions options;
  options.source = name;
  options.hand = padHand({{16, 16}});
  // The first line of a port is not used.
  receiveAndRecord(state,
                   options,
                   lineTexts(256, static_cast<std::size_t>(kSeconds * 100.0)),
                   10'000'000,
                   1,
                   [master](std::uint16_t) { return master; });
  ::close(master);
  ::close(slave);
}
BENCHMARK(streamLinesRecorded)->UseManualTime()->Iterations(1)->Unit(benchmark::kSecond);

// The parser alone, fed packet by packet.
void streamPacketParsed(benchmark::State& state) {
  const std::vector<std::string> texts = packetTexts(512, 256);
  StreamPacketParser parser{StreamShape(padHand({{16, 16}, {16, 16}}))};
  std::uint64_t items = 0;
  const StreamPacketParser::Sink sink = [&](const StreamItem&) { ++items; };
  std::size_t next = 0;
  for (auto _ : state) {
    parser.push(std::as_bytes(std::span(texts[next])), sink);
    next = (next + 1) % texts.size();
  }
  if (items != static_cast<std::uint64_t>(state.iterations()))
    state.SkipWithError("packets were refused");
}
BENCHMARK(streamPacketParsed);

void streamPacketChecksum(benchmark::State& state) {
  const std::vector<std::string> texts = packetTexts(512, 256);
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(::crc32_z(
        0, reinterpret_cast<const unsigned char*>(texts[next].data()), texts[next].size()));
    next = (next + 1) % texts.size();
  }
}
BENCHMARK(streamPacketChecksum);

void streamLineParsed(benchmark::State& state) {
  const std::vector<std::string> texts = lineTexts(256, 256);
  StreamLineParser parser{StreamShape(padHand({{16, 16}}))};
  std::uint64_t items = 0;
  const StreamLineParser::Sink sink = [&](const StreamItem&) { ++items; };
  std::size_t next = 0;
  for (auto _ : state) {
    parser.push(std::as_bytes(std::span(texts[next])), sink);
    next = (next + 1) % texts.size();
  }
  if (items != static_cast<std::uint64_t>(state.iterations()))
    state.SkipWithError("lines were refused");
}
BENCHMARK(streamLineParsed);

void streamLineStrtof(benchmark::State& state) {
  const std::vector<std::string> texts = lineTexts(256, 256);
  std::vector<float> values(258);
  std::size_t next = 0;
  for (auto _ : state) {
    const char* at = texts[next].c_str() + std::strlen("frame#");
    for (float& value : values) {
      char* end = nullptr;
      value = std::strtof(at, &end);
      at = end + 1;
    }
    benchmark::DoNotOptimize(values.data());
    next = (next + 1) % texts.size();
  }
}
BENCHMARK(streamLineStrtof);

}  // namespace
