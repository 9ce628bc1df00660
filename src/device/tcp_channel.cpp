#include "device/tcp_channel.h"

#include <algorithm>
#include <cerrno>
#include <future>
#include <memory>
#include <system_error>
#include <thread>

#include <netdb.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

using TcpChannelSteadyClock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::string_view kPrefix = "tcp:";

struct Place {
  std::string host;
  std::string port;
};

Place placeOf(const std::string& name) {
  const std::string rest = name.substr(kPrefix.size());
  const std::size_t colon = rest.rfind(':');
  const std::int64_t number =
      colon == std::string::npos ? 0 : parseInteger(rest.substr(colon + 1)).value_or(0);
  Place place{rest.substr(0, colon), ""};
  if (place.host.size() > 2 && place.host.front() == '[' && place.host.back() == ']')
    place.host = place.host.substr(1, place.host.size() - 2);
  if (place.host.empty() || number < 1 || number > 65'535)
    throw DeviceError(DeviceFault::kNotFound,
                      name,
                      "a network port is named tcp:HOST:PORT, for example tcp:192.168.1.42:23");
  place.port = std::to_string(number);
  return place;
}

struct Addresses {
  addrinfo* first = nullptr;
  int error = 0;
  Addresses() = default;
  Addresses(const Addresses&) = delete;
  Addresses& operator=(const Addresses&) = delete;
  ~Addresses() {
    if (first) ::freeaddrinfo(first);
  }
};

void look(const Place& place, int flags, Addresses& found) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = flags | AI_NUMERICSERV;
  found.error = ::getaddrinfo(place.host.c_str(), place.port.c_str(), &hints, &found.first);
}

// The addresses of a host. The resolver has no time limit, so it runs in a thread of its own. If it
// takes too long, that thread is detached and ends when the resolver gives up.
std::shared_ptr<const Addresses> resolve(const std::string& name,
                                         const Place& place,
                                         TcpChannelSteadyClock::time_point deadline) {
  auto found = std::make_shared<Addresses>();
  look(place, AI_NUMERICHOST, *found);
  if (found->error == 0) return found;
  auto named = std::make_shared<Addresses>();
  std::packaged_task<void()> task([place, named] { look(place, 0, *named); });
  std::future<void> done = task.get_future();
  std::thread(std::move(task)).detach();
  if (done.wait_until(deadline) != std::future_status::ready)
    throw DeviceError(DeviceFault::kNotFound,
                      name,
                      "the name " + place.host + " was not resolved in time; try its address");
  if (named->error != 0)
    throw DeviceError(DeviceFault::kNotFound,
                      name,
                      "no host of the name " + place.host + " (" + ::gai_strerror(named->error) +
                          "); try its address");
  return named;
}

void tune(int fd) noexcept {
  const auto set = [fd](int level, int option, int value) {
    ::setsockopt(fd, level, option, &value, sizeof value);
  };
  set(IPPROTO_TCP, TCP_NODELAY, 1);  // sends each request immediately
  // Detects a host that no longer answers within about 4 s.
  set(SOL_SOCKET, SO_KEEPALIVE, 1);
  set(IPPROTO_TCP, TCP_KEEPIDLE, 2);
  set(IPPROTO_TCP, TCP_KEEPINTVL, 1);
  set(IPPROTO_TCP, TCP_KEEPCNT, 2);
  set(IPPROTO_TCP, TCP_USER_TIMEOUT, 4000);
}

// Connects before the deadline. Returns 0, or the errno of the failure.
int connectWithin(int fd, const addrinfo& address, TcpChannelSteadyClock::time_point deadline) {
  if (::connect(fd, address.ai_addr, address.ai_addrlen) == 0) return 0;
  if (errno != EINPROGRESS && errno != EINTR) return errno;
  for (;;) {
    const auto left =
        std::chrono::ceil<milliseconds>(deadline - TcpChannelSteadyClock::now()).count();
    pollfd wait{fd, POLLOUT, 0};
    const int ready = ::poll(&wait, 1, static_cast<int>(std::max<std::int64_t>(left, 0)));
    if (ready > 0) {
      int error = 0;
      socklen_t size = sizeof error;
      return ::getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
    }
    if (ready < 0 && errno != EINTR) return errno;
    if (TcpChannelSteadyClock::now() >= deadline) return ETIMEDOUT;
  }
}

}  // namespace

TcpChannel::TcpChannel(std::string name, FileDescriptor fd)
    : DescriptorChannel(std::move(name), fd.get(), true), fd_(std::move(fd)) {}

std::unique_ptr<ByteChannel> TcpChannel::accepted(const std::string& name,
                                                  FileDescriptor connection) {
  tune(connection.get());
  return std::unique_ptr<ByteChannel>(new TcpChannel(name, std::move(connection)));
}

std::unique_ptr<ByteChannel> TcpChannel::open(const std::string& name,
                                              milliseconds connectTimeout) {
  const auto deadline = TcpChannelSteadyClock::now() + connectTimeout;
  const Place place = placeOf(name);
  const auto addresses = resolve(name, place, deadline);
  int error = ETIMEDOUT;
  for (const addrinfo* at = addresses->first; at; at = at->ai_next) {
    FileDescriptor fd(
        ::socket(at->ai_family, at->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, at->ai_protocol));
    if (fd.get() < 0) {
      error = errno;
      continue;
    }
    error = connectWithin(fd.get(), *at, deadline);
    if (error != 0) continue;
    tune(fd.get());
    return std::unique_ptr<ByteChannel>(new TcpChannel(name, std::move(fd)));
  }
  throw DeviceError(DeviceFault::kNotFound,
                    name,
                    "no connection (" + std::generic_category().message(error) +
                        "); is the hand on, its address and port right, the network up?");
}

}  // namespace palpate
