// What the servers for other programs have in common: one thread per server accepts and serves its
// clients, so that those of one outlet never delay those of another, and closes their sessions when
// the server ends. `Session` is one client: its close() says goodbye and calls ended(), at once or
// later.
#pragma once

#include <cerrno>
#include <chrono>
#include <functional>
#include <list>
#include <memory>
#include <thread>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <sys/socket.h>

#include "palpate/core/file_descriptor.h"

namespace palpate {
namespace asio = boost::asio;
using BoostError = boost::system::error_code;

// Declare it after everything that sessions use: they end with it at the latest.
template <typename Session>
class OutletServer {
 public:
  using Sessions = std::list<std::shared_ptr<Session>>;

  // `onClient` is called on the server's thread with each client, a non-blocking socket that no
  // child process inherits; what it throws costs this client only.
  OutletServer(FileDescriptor listener, std::function<void(FileDescriptor)> onClient)
      : onClient_(std::move(onClient)), listener_(context_, listener.release()), timer_(context_) {}
  ~OutletServer() { stop(); }
  OutletServer(const OutletServer&) = delete;
  OutletServer& operator=(const OutletServer&) = delete;

  void start() {
    thread_ = std::thread([this] { run(); });
  }
  // Closes all sessions, for at most 0.04 s. Called by the thread that called start().
  void stop() {
    if (!thread_.joinable()) return;
    asio::post(context_, [this] { sayGoodbye(); });
    thread_.join();
    sessions_.clear();
  }
  asio::io_context& context() noexcept { return context_; }  // from any thread

  // On the server's thread only.
  const Sessions& sessions() const noexcept { return sessions_; }  // the oldest first
  void add(std::shared_ptr<Session> session) { sessions_.push_back(std::move(session)); }
  // No effect on a session that has ended already.
  void ended(const Session* session) {
    sessions_.remove_if([session](const auto& each) { return each.get() == session; });
    if (stopping_ && sessions_.empty()) timer_.cancel();
  }

 private:
  static constexpr std::chrono::milliseconds kGoodbye{40};
  // Pause when the system has no descriptor or no memory left.
  static constexpr std::chrono::milliseconds kRest{100};

  // An exception of a handler ends only what this handler did: most likely memory was exhausted.
  // The process that moves a hand continues.
  void run() noexcept {
    while (true) {
      try {
        if (!awaiting_) accept();
        context_.run();
        return;
      } catch (...) {
        if (!awaiting_ && !stopping_) std::this_thread::sleep_for(kRest);
      }
    }
  }

  void accept() {
    if (stopping_) return;
    listener_.async_wait(asio::posix::stream_descriptor::wait_read, [this](BoostError error) {
      awaiting_ = false;
      if (error || stopping_) return;
      FileDescriptor client(
          ::accept4(listener_.native_handle(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
      if (client.get() < 0 && errno != EAGAIN) return rest();
      try {
        if (client.get() >= 0) onClient_(std::move(client));
      } catch (...) {  // no memory for another client
      }
      accept();
    });
    awaiting_ = true;
  }

  void rest() {
    timer_.expires_after(kRest);
    timer_.async_wait([this](BoostError cancelled) {
      awaiting_ = false;
      if (!cancelled) accept();
    });
    awaiting_ = true;
  }

  void sayGoodbye() {
    stopping_ = true;
    BoostError ignored;
    listener_.close(ignored);
    timer_.expires_after(kGoodbye);
    timer_.async_wait([this](BoostError) { context_.stop(); });
    const Sessions now = sessions_;  // close() may end them
    for (const auto& session : now) session->close();
    if (sessions_.empty()) timer_.cancel();
  }

  const std::function<void(FileDescriptor)> onClient_;
  // Its handlers own sessions.
  asio::io_context context_{1};
  asio::posix::stream_descriptor listener_;
  asio::steady_timer timer_;
  Sessions sessions_;      // used by the server's thread only, as the following members
  bool awaiting_ = false;  // a client, or the end of a rest
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace palpate
