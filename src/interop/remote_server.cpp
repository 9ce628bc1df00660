#include "palpate/interop/remote_server.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <list>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include "palpate/core/error.h"

#include "interop/remote_socket.h"

namespace palpate {
namespace {
using RemoteServerSteadyTime = std::chrono::steady_clock;
using RemoteServerVerb = RemoteRequest::Verb;

constexpr std::size_t kReadBytes = 4096;
constexpr int kRestMs = 100;  // pause when the system has no descriptor left

// Queue of answers for the server's thread; answers may come from any thread at any time.
class AnswerBox {
 public:
  struct Item {
    std::uint64_t client = 0;
    RemoteAnswer answer;
  };
  AnswerBox() : wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (wake_.get() < 0) throw Error("remote control: the system has no descriptor left");
  }
  void put(std::uint64_t client, RemoteAnswer answer) {
    const std::lock_guard lock(mutex_);
    items_.push_back({client, std::move(answer)});
    ring();
  }
  std::vector<Item> take() {
    const std::lock_guard lock(mutex_);
    std::uint64_t rung = 0;
    [[maybe_unused]] const ssize_t read = ::read(wake_.get(), &rung, sizeof rung);
    return std::exchange(items_, {});
  }
  void ring() {
    const std::uint64_t one = 1;
    [[maybe_unused]] const ssize_t written = ::write(wake_.get(), &one, sizeof one);
  }
  int descriptor() const noexcept { return wake_.get(); }

 private:
  FileDescriptor wake_;
  std::mutex mutex_;
  std::vector<Item> items_;
};

// Ensures that an answer is given exactly once: when the last copy is destroyed without one, it
// sends an error.
class PendingAnswer {
 public:
  PendingAnswer(std::weak_ptr<AnswerBox> box, std::uint64_t client)
      : box_(std::move(box)), client_(client) {}
  ~PendingAnswer() { give(RemoteAnswer::refused("failed", "the request was not carried out")); }
  PendingAnswer(const PendingAnswer&) = delete;
  PendingAnswer& operator=(const PendingAnswer&) = delete;
  void give(RemoteAnswer answer) {
    if (given_.exchange(true)) return;
    if (const auto box = box_.lock()) box->put(client_, std::move(answer));
  }

 private:
  std::weak_ptr<AnswerBox> box_;
  std::uint64_t client_;
  std::atomic<bool> given_ = false;
};

struct Client {
  FileDescriptor socket;
  std::uint64_t id = 0;
  RequestLines lines;
  std::string out;                       // unsent part of the last answer
  std::optional<RemoteRequest> pending;  // request that waits for its answer
  bool ended = false;                    // nothing more is sent
  RemoteServerSteadyTime::time_point active = RemoteServerSteadyTime::now();

  bool reads() const { return !ended && !pending && out.empty(); }
};

}  // namespace

std::filesystem::path usualRemoteSocket() {
  const char* folder = std::getenv("XDG_RUNTIME_DIR");
  if (!folder || *folder == '\0')
    throw Error("XDG_RUNTIME_DIR is not set: name the socket with --socket PATH");
  return std::filesystem::path(folder) / "palpate-remote";
}

struct RemoteServer::Impl {
  Impl(std::filesystem::path path, RemoteTarget& who, RemoteServerOptions given)
      : target(who), options(std::move(given)), listener(std::move(path)) {}

  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      try {
        await();
        for (AnswerBox::Item& item : box->take()) deliver(item);
        const std::lock_guard lock(mutex);
        stats.clients = clients.size();
      } catch (...) {
        resting = true;  // most likely out of memory: the process that moves a hand continues
      }
    }
    for (Client& client : clients)
      if (client.pending) {
        client.out += answerLine(RemoteAnswer::refused("shutting_down", "remote control ends"),
                                 nameOf(client.pending->verb)) +
                      "\n";
        write(client);
      }
    clients.clear();
  }

  void await() {
    std::vector<pollfd> waiting{{box->descriptor(), POLLIN, 0},
                                {resting ? -1 : listener.descriptor(), POLLIN, 0}};
    for (const Client& client : clients)
      waiting.push_back(
          {client.socket.get(),
           static_cast<short>((client.reads() ? POLLIN : 0) | (client.out.empty() ? 0 : POLLOUT)),
           0});
    ::poll(waiting.data(), waiting.size(), resting ? kRestMs : -1);
    resting = false;
    std::size_t next = 2;
    for (auto client = clients.begin(); client != clients.end(); ++next)
      client = isServed(*client, waiting[next].revents) ? std::next(client) : clients.erase(client);
    if (waiting[1].revents != 0) accept();
  }

  // An exception while serving a client closes only that client.
  bool isServed(Client& client, short events) {
    try {
      return serve(client, events);
    } catch (...) {
      return false;
    }
  }

  // Returns false when the client is to be closed.
  bool serve(Client& client, short events) {
    if ((events & POLLOUT) != 0 && !write(client)) return false;
    if ((events & POLLIN) != 0 && !read(client)) return false;
    if ((events & (POLLHUP | POLLERR | POLLNVAL)) != 0 && (events & POLLIN) == 0) return false;
    return processRequests(client);
  }

  bool read(Client& client) const {
    std::array<char, kReadBytes> bytes{};
    const ssize_t n = ::recv(client.socket.get(), bytes.data(), bytes.size(), 0);
    if (n < 0) return errno == EAGAIN || errno == EINTR;
    client.active = RemoteServerSteadyTime::now();
    client.ended = n == 0;
    client.lines.push({bytes.data(), static_cast<std::size_t>(n)});
    return true;
  }

  static bool write(Client& client) {
    const ssize_t n = ::send(
        client.socket.get(), client.out.data(), client.out.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (n < 0) return errno == EAGAIN || errno == EINTR;
    client.active = RemoteServerSteadyTime::now();
    client.out.erase(0, static_cast<std::size_t>(n));
    return true;
  }

  // Processes requests until one has to wait; returns false when the client is to be closed.
  bool processRequests(Client& client) {
    while (!client.pending && client.out.empty()) {
      const auto line = client.lines.next();
      if (!line) return !client.ended;
      const ReadRequest read = line->tooLong ? readRequest(std::string(kMaxRequestBytes + 1, 'x'))
                                             : readRequest(line->text);
      if (!read.request) {
        const std::lock_guard lock(mutex);
        ++stats.refused;
      }
      if (!read.request) {
        if (!answer(client, read.refusal, {})) return false;
      } else if (read.request->verb == RemoteServerVerb::kHelp) {
        if (!answer(client, help(), nameOf(RemoteServerVerb::kHelp))) return false;
      } else {
        ask(client, *read.request);
      }
    }
    return true;
  }

  void ask(Client& client, const RemoteRequest& request) {
    {
      const std::lock_guard lock(mutex);
      ++stats.requests;
    }
    client.pending = request;
    const auto pending = std::make_shared<PendingAnswer>(box, client.id);
    try {
      target.carryOut(request,
                      [pending](RemoteAnswer answer) { pending->give(std::move(answer)); });
    } catch (const std::exception& failure) {
      pending->give(RemoteAnswer::refused("failed", failure.what()));
    } catch (...) {
      pending->give(RemoteAnswer::refused("failed", "an unknown exception"));
    }
  }

  static RemoteAnswer help() {
    Json verbs = Json::array();
    for (const RemoteServerVerb verb : allRemoteVerbs()) verbs.push(nameOf(verb));
    RemoteAnswer answer;
    answer.fields.set("requests", std::move(verbs)).set("protocol", 1);
    return answer;
  }

  static bool answer(Client& client, const RemoteAnswer& answer, std::string_view command) {
    client.out += answerLine(answer, command) + "\n";
    return write(client);
  }

  void deliver(const AnswerBox::Item& item) {
    const auto client = std::find_if(
        clients.begin(), clients.end(), [&](const Client& each) { return each.id == item.client; });
    if (client == clients.end() || !client->pending) return;  // the client has left meanwhile
    const RemoteRequest request = *std::exchange(client->pending, std::nullopt);
    try {
      if (options.onAnswer && request.verb != RemoteServerVerb::kStatus)
        options.onAnswer(request, item.answer);
    } catch (...) {
      // The callback may fail: the client has received its answer nevertheless.
    }
    try {
      if (answer(*client, item.answer, nameOf(request.verb)) && processRequests(*client)) return;
    } catch (...) {
      // Most likely out of memory: this client gets no answer.
    }
    clients.erase(client);
  }

  void accept() {
    FileDescriptor socket = listener.accept();
    if (socket.get() < 0) {
      resting = errno == EMFILE || errno == ENFILE || errno == ENOMEM || errno == ENOBUFS;
      if (errno == EACCES) turnAway();
      return;
    }
    if (clients.size() >= options.maxClients && !makeRoom()) {
      Client rejected;
      rejected.socket = std::move(socket);
      answer(rejected, RemoteAnswer::refused("busy", "too many clients: close one"), {});
      return turnAway();
    }
    Client client;
    client.socket = std::move(socket);
    client.id = ++lastId;
    clients.push_back(std::move(client));
    const std::lock_guard lock(mutex);
    ++stats.accepted;
  }

  void turnAway() {
    const std::lock_guard lock(mutex);
    ++stats.rejectedClients;
  }

  // Closes the client that was silent for the longest time, if that is long enough.
  bool makeRoom() {
    const auto limit = RemoteServerSteadyTime::now() - std::chrono::duration<double>(options.idleS);
    auto longest = clients.end();
    for (auto each = clients.begin(); each != clients.end(); ++each)
      if (!each->pending && each->active < limit &&
          (longest == clients.end() || each->active < longest->active))
        longest = each;
    if (longest == clients.end()) return false;
    clients.erase(longest);
    return true;
  }

  RemoteTarget& target;
  const RemoteServerOptions options;
  const ListeningSocket listener;
  const std::shared_ptr<AnswerBox> box = std::make_shared<AnswerBox>();
  std::list<Client> clients;  // used by the server's thread only, as the following members
  std::uint64_t lastId = 0;
  bool resting = false;
  mutable std::mutex mutex;  // protects stats
  RemoteServerStats stats;
  std::jthread thread;
};

RemoteServer::RemoteServer(std::filesystem::path socket,
                           RemoteTarget& target,
                           RemoteServerOptions options) {
  if (options.maxClients < 1 || options.maxClients > 1000)
    throw std::invalid_argument("RemoteServerOptions: maxClients must be 1..1000");
  if (!(options.idleS >= 0.0))
    throw std::invalid_argument("RemoteServerOptions: idleS must be >= 0");
  impl_ = std::make_unique<Impl>(std::move(socket), target, std::move(options));
  impl_->thread =
      std::jthread([impl = impl_.get()](const std::stop_token& stop) { impl->run(stop); });
}

RemoteServer::~RemoteServer() {
  impl_->thread.request_stop();
  impl_->box->ring();
  impl_->thread.join();
}

const std::filesystem::path& RemoteServer::socket() const noexcept {
  return impl_->listener.path();
}

RemoteServerStats RemoteServer::stats() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->stats;
}

}  // namespace palpate
