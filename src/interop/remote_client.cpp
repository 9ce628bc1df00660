#include "palpate/interop/remote_client.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <poll.h>
#include <sys/socket.h>

#include "palpate/core/error.h"
#include "palpate/core/json.h"

#include "interop/remote_socket.h"

namespace palpate {
namespace {
using SteadyTime = std::chrono::steady_clock;
constexpr std::size_t kLongestAnswer = 1u << 20;  // [bytes]; usual answers have some hundred
}  // namespace

struct RemoteClient::Impl {
  [[noreturn]] void gone() const {
    throw FileError(path, "the remote-controlled program has ended");
  }

  void await(short events, SteadyTime::time_point end) const {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(end - SteadyTime::now()).count();
    pollfd waiting{socket.get(), events, 0};
    const int ready = left > 0 ? ::poll(&waiting, 1, static_cast<int>(left)) : 0;
    if (ready < 0 && errno != EINTR) gone();
    if (ready == 0)
      throw FileError(path, "no answer in time; the request 'status' shows what it does");
  }

  void send(std::string_view bytes, SteadyTime::time_point end) const {
    while (!bytes.empty()) {
      const ssize_t n =
          ::send(socket.get(), bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
      if (n > 0)
        bytes.remove_prefix(static_cast<std::size_t>(n));
      else if (errno == EAGAIN || errno == EINTR)
        await(POLLOUT, end);
      else
        return;  // the server may have sent the reason before it ended
    }
  }

  [[noreturn]] void noPalpate() const {
    throw FileError(path, "this isn't Palpate: another program listens on this socket");
  }

  std::string receiveLine(SteadyTime::time_point end) {
    while (received.find('\n') == std::string::npos) {
      if (received.size() > kLongestAnswer) noPalpate();
      await(POLLIN, end);
      std::array<char, 4096> bytes{};
      const ssize_t n = ::recv(socket.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
      if (n == 0 || (n < 0 && errno != EAGAIN && errno != EINTR)) gone();
      if (n > 0) received.append(bytes.data(), static_cast<std::size_t>(n));
    }
    const auto at = received.find('\n');
    std::string line = received.substr(0, at);
    received.erase(0, at + 1);
    try {
      const Json answer = Json::parse(line);
      if (answer.isObject() && answer.at("ok").isBool()) return line;
    } catch (const Error&) {  // not JSON
    }
    noPalpate();
  }

  std::filesystem::path path;
  FileDescriptor socket;
  std::string received;
};

RemoteClient::RemoteClient(std::filesystem::path socket) : impl_(std::make_unique<Impl>()) {
  impl_->socket = connectTo(socket);
  impl_->path = std::move(socket);
}

RemoteClient::~RemoteClient() = default;

std::string RemoteClient::ask(std::string_view request, std::chrono::milliseconds timeout) {
  if (request.find('\n') != std::string_view::npos)
    throw std::invalid_argument("RemoteClient: a request is one line");
  const auto end = SteadyTime::now() + timeout;
  impl_->send(std::string(request) + "\n", end);
  return impl_->receiveLine(end);
}

}  // namespace palpate
