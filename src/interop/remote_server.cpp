#include "palpate/interop/remote_server.h"

#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <mutex>
#include <stdexcept>
#include <utility>

#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/write.hpp>

#include "palpate/core/error.h"

#include "interop/outlet_server.h"
#include "interop/remote_socket.h"

namespace palpate {
namespace {
using RemoteServerSteadyTime = std::chrono::steady_clock;
using RemoteServerVerb = RemoteRequest::Verb;

constexpr std::size_t kReadBytes = 4096;

RemoteAnswer remoteHelp() {
  Json verbs = Json::array();
  for (const RemoteServerVerb verb : allRemoteVerbs()) verbs.push(nameOf(verb));
  RemoteAnswer answer;
  answer.fields.set("requests", std::move(verbs)).set("protocol", 1);
  return answer;
}

}  // namespace

std::filesystem::path usualRemoteSocket() {
  const char* folder = std::getenv("XDG_RUNTIME_DIR");
  if (!folder || *folder == '\0')
    throw Error("XDG_RUNTIME_DIR is not set: name the socket with --socket PATH");
  return std::filesystem::path(folder) / "palpate-remote";
}

struct RemoteServer::Impl {
  class Session;
  class PendingAnswer;
  // The way to the server's thread, from any thread at any time.
  struct AnswerBox {
    std::mutex mutex;
    asio::io_context* context = nullptr;  // null: the server has ended
  };

  Impl(std::filesystem::path path, RemoteTarget& who, RemoteServerOptions given)
      : target(who),
        options(std::move(given)),
        place(std::move(path)),
        server(place.takeListener(), [this](FileDescriptor socket) { accept(std::move(socket)); }) {
    box->context = &server.context();
    server.start();
  }
  ~Impl() {
    server.stop();
    const std::lock_guard lock(box->mutex);
    box->context = nullptr;
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void accept(FileDescriptor socket);
  bool makeRoom();

  void count(std::uint64_t RemoteServerStats::*counter) {
    const std::lock_guard lock(mutex);
    ++(stats.*counter);
  }
  void countClients() {
    const std::lock_guard lock(mutex);
    stats.clients = server.sessions().size();
  }

  RemoteTarget& target;
  const RemoteServerOptions options;
  ListeningSocket place;
  const std::shared_ptr<AnswerBox> box = std::make_shared<AnswerBox>();
  mutable std::mutex mutex;  // protects stats
  RemoteServerStats stats;
  OutletServer<Session> server;
};

// Ensures that an answer is given exactly once: when the last copy is destroyed without one, it
// sends an error.
class RemoteServer::Impl::PendingAnswer {
 public:
  PendingAnswer(std::shared_ptr<AnswerBox> box, std::weak_ptr<Session> session)
      : box_(std::move(box)), session_(std::move(session)) {}
  ~PendingAnswer() { give(RemoteAnswer::refused("failed", "the request was not carried out")); }
  PendingAnswer(const PendingAnswer&) = delete;
  PendingAnswer& operator=(const PendingAnswer&) = delete;
  void give(RemoteAnswer answer);

 private:
  const std::shared_ptr<AnswerBox> box_;
  const std::weak_ptr<Session> session_;
  std::atomic<bool> given_ = false;
};

// One client: reads the next request only when the previous one is answered.
class RemoteServer::Impl::Session : public std::enable_shared_from_this<Session> {
 public:
  Session(Impl& server, FileDescriptor socket)
      : server_(server),
        socket_(server.server.context(), asio::local::stream_protocol(), socket.release()) {
    socket_.non_blocking(true);
  }

  void start() {
    // Notices a client that leaves while nothing is read from it.
    socket_.async_wait(Socket::wait_error, [self = shared_from_this()](BoostError error) {
      if (error) return;
      self->hasLeft_ = true;
      if (!self->reading_) self->end();
    });
    processRequests();
  }

  // Empty while it waits for an answer of the target.
  std::optional<RemoteServerSteadyTime::time_point> silentSince() const {
    return pending_ ? std::nullopt : std::optional(active_);
  }

  void deliver(const RemoteAnswer& given) {
    if (!pending_ || !socket_.is_open()) return;  // the client has left meanwhile
    const RemoteRequest request = *std::exchange(pending_, std::nullopt);
    try {
      if (server_.options.onAnswer && request.verb != RemoteServerVerb::kStatus)
        server_.options.onAnswer(request, given);
    } catch (...) {
      // The callback may fail: the client receives its answer nevertheless.
    }
    guarded([&] { answer(given, nameOf(request.verb)); });
  }

  void close() {
    if (pending_) {
      const std::string line =
          answerLine(RemoteAnswer::refused("shutting_down", "remote control ends"),
                     nameOf(pending_->verb)) +
          "\n";
      BoostError ignored;
      socket_.write_some(asio::buffer(line), ignored);
    }
    end();
  }

 private:
  using Socket = asio::local::stream_protocol::socket;

  void end() {
    BoostError ignored;
    socket_.close(ignored);
    server_.server.ended(this);
    server_.countClients();
  }

  // An exception while serving a client closes only that client.
  template <typename Step>
  void guarded(const Step& step) {
    try {
      step();
    } catch (...) {
      end();
    }
  }

  // Processes requests until one has to wait for its answer, or an answer for its client.
  void processRequests() {
    while (!pending_ && out_.empty()) {
      const auto line = lines_.next();
      if (!line) return ended_ ? end() : read();
      const ReadRequest read = line->tooLong ? readRequest(std::string(kMaxRequestBytes + 1, 'x'))
                                             : readRequest(line->text);
      if (!read.request) {
        server_.count(&RemoteServerStats::refused);
        answer(read.refusal, {});
      } else if (read.request->verb == RemoteServerVerb::kHelp) {
        answer(remoteHelp(), nameOf(RemoteServerVerb::kHelp));
      } else {
        ask(*read.request);
      }
    }
    if (hasLeft_) end();
  }

  void read() {
    socket_.async_read_some(asio::buffer(bytes_),
                            [self = shared_from_this()](BoostError error, std::size_t n) {
                              self->reading_ = false;
                              if (error && error != asio::error::eof) return self->end();
                              self->active_ = RemoteServerSteadyTime::now();
                              self->ended_ = error == asio::error::eof;
                              self->guarded([&] {
                                self->lines_.push({self->bytes_.data(), n});
                                self->processRequests();
                              });
                            });
    reading_ = true;
  }

  void ask(const RemoteRequest& request) {
    server_.count(&RemoteServerStats::requests);
    pending_ = request;
    const auto pending = std::make_shared<PendingAnswer>(server_.box, weak_from_this());
    try {
      server_.target.carryOut(request,
                              [pending](RemoteAnswer answer) { pending->give(std::move(answer)); });
    } catch (const std::exception& failure) {
      pending->give(RemoteAnswer::refused("failed", failure.what()));
    } catch (...) {
      pending->give(RemoteAnswer::refused("failed", "an unknown exception"));
    }
  }

  void answer(const RemoteAnswer& answer, std::string_view command) {
    out_ = answerLine(answer, command) + "\n";
    asio::async_write(
        socket_, asio::buffer(out_), [self = shared_from_this()](BoostError error, std::size_t) {
          if (error) return self->end();
          self->active_ = RemoteServerSteadyTime::now();
          self->out_.clear();
          self->guarded([&] { self->processRequests(); });
        });
  }

  Impl& server_;
  Socket socket_;
  std::array<char, kReadBytes> bytes_{};
  RequestLines lines_;
  std::string out_;                       // the answer that is being sent
  std::optional<RemoteRequest> pending_;  // request that waits for its answer
  bool reading_ = false;
  bool ended_ = false;    // the client sends nothing more
  bool hasLeft_ = false;  // nor does it receive anything
  RemoteServerSteadyTime::time_point active_ = RemoteServerSteadyTime::now();
};

void RemoteServer::Impl::PendingAnswer::give(RemoteAnswer answer) {
  if (given_.exchange(true)) return;
  const std::lock_guard lock(box_->mutex);
  if (!box_->context) return;
  asio::post(*box_->context, [session = session_, answer = std::move(answer)] {
    if (const auto open = session.lock()) open->deliver(answer);
  });
}

void RemoteServer::Impl::accept(FileDescriptor socket) {
  if (!isOfThisUser(socket.get())) return count(&RemoteServerStats::rejectedClients);
  if (server.sessions().size() >= options.maxClients && !makeRoom()) {
    const std::string line =
        answerLine(RemoteAnswer::refused("busy", "too many clients: close one"), {}) + "\n";
    [[maybe_unused]] const ssize_t sent =
        ::send(socket.get(), line.data(), line.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    return count(&RemoteServerStats::rejectedClients);
  }
  const auto session = std::make_shared<Session>(*this, std::move(socket));
  server.add(session);
  count(&RemoteServerStats::accepted);
  countClients();
  session->start();
}

// Closes the client that was silent for the longest time, if that is long enough.
bool RemoteServer::Impl::makeRoom() {
  const auto limit = RemoteServerSteadyTime::now() - std::chrono::duration<double>(options.idleS);
  std::shared_ptr<Session> longest;
  for (const auto& each : server.sessions()) {
    const auto since = each->silentSince();
    if (since && *since < limit && (!longest || *since < *longest->silentSince())) longest = each;
  }
  if (longest) longest->close();
  return longest != nullptr;
}

RemoteServer::RemoteServer(std::filesystem::path socket,
                           RemoteTarget& target,
                           RemoteServerOptions options) {
  if (options.maxClients < 1 || options.maxClients > 1000)
    throw std::invalid_argument("RemoteServerOptions: maxClients must be 1..1000");
  if (!(options.idleS >= 0.0))
    throw std::invalid_argument("RemoteServerOptions: idleS must be >= 0");
  impl_ = std::make_unique<Impl>(std::move(socket), target, std::move(options));
}

RemoteServer::~RemoteServer() = default;

const std::filesystem::path& RemoteServer::socket() const noexcept { return impl_->place.path(); }

RemoteServerStats RemoteServer::stats() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->stats;
}

}  // namespace palpate
