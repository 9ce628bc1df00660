#include "palpate/interop/remote_client.h"

#include <stdexcept>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>

#include "palpate/core/error.h"
#include "palpate/core/json.h"

#include "interop/remote_socket.h"

namespace palpate {
namespace {
namespace asio = boost::asio;
constexpr std::size_t kLongestAnswer = 1u << 20;  // [bytes]; usual answers have some hundred
}  // namespace

struct RemoteClient::Impl {
  explicit Impl(std::filesystem::path socketPath)
      : path(std::move(socketPath)),
        socket(context, asio::local::stream_protocol(), connectTo(path).release()) {}

  // Sends `text` and receives into `received` up to a line end; gives up after `timeout`.
  void exchange(const std::string& text, std::chrono::milliseconds timeout) {
    boost::system::error_code failure = asio::error::timed_out;
    // Where sending fails, the server may have sent the reason before it ended.
    asio::async_write(socket, asio::buffer(text), [&](boost::system::error_code, std::size_t) {
      asio::async_read_until(
          socket,
          asio::dynamic_buffer(received, kLongestAnswer),
          '\n',
          [&](boost::system::error_code error, std::size_t) { failure = error; });
    });
    context.restart();
    context.run_for(timeout);
    if (!context.stopped()) {
      boost::system::error_code ignored;
      socket.close(ignored);
      context.run();  // ends what refers to `text`
      throw FileError(path, "no answer in time; the request 'status' shows what it does");
    }
    if (failure == asio::error::not_found) noPalpate();
    if (failure) throw FileError(path, "the remote-controlled program has ended");
  }

  [[noreturn]] void noPalpate() const {
    throw FileError(path, "this isn't Palpate: another program listens on this socket");
  }

  // Takes the first line out of `received`.
  std::string takeLine() {
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
  asio::io_context context;
  asio::local::stream_protocol::socket socket;
  std::string received;
};

RemoteClient::RemoteClient(std::filesystem::path socket)
    : impl_(std::make_unique<Impl>(std::move(socket))) {}

RemoteClient::~RemoteClient() = default;

std::string RemoteClient::ask(std::string_view request, std::chrono::milliseconds timeout) {
  if (request.find('\n') != std::string_view::npos)
    throw std::invalid_argument("RemoteClient: a request is one line");
  impl_->exchange(std::string(request) + "\n", timeout);
  return impl_->takeLine();
}

}  // namespace palpate
