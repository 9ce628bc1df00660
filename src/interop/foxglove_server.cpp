#include "palpate/interop/foxglove_server.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <deque>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>

#include <boost/asio/dispatch.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"

#include "interop/foxglove_request.h"

namespace palpate {
namespace {
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using BoostError = boost::system::error_code;

constexpr std::size_t kMostHeaderBytes = 8192;
constexpr std::size_t kMostClientBytes = 256U << 10;
constexpr std::size_t kMostSubscriptions = 4096;
// Connections whose handshake is not finished yet.
constexpr std::size_t kMostHandshakes = 64;
// Messages that may wait for the server's thread: a second of 60 channels at 30 Hz.
constexpr std::size_t kMostPosted = 2048;
constexpr auto kGoodbye = std::chrono::milliseconds(40);
constexpr auto kAcceptRest = std::chrono::milliseconds(100);
constexpr auto kSilence = std::chrono::seconds(60);
constexpr std::size_t kMessageHeadBytes = 13;
constexpr std::int64_t kServerNsPerUs = 1000;

using SharedText = std::shared_ptr<const std::string>;

// What waits to be sent to a client.
struct Outgoing {
  std::array<unsigned char, kMessageHeadBytes> head{};  // of a binary message
  bool binary = false;
  bool droppable = false;
  SharedText content;

  std::size_t size() const { return content->size() + (binary ? kMessageHeadBytes : 0); }
};

struct Posted {
  std::size_t channel = 0;
  std::int64_t timeUs = 0;
  SharedText payload;
};

std::string advertisement(const std::vector<FoxgloveChannel>& channels) {
  Json list = Json::array();
  for (std::size_t i = 0; i < channels.size(); ++i)
    list.push(Json::object()
                  .set("id", i)
                  .set("topic", channels[i].topic)
                  .set("encoding", "json")
                  .set("schemaName", channels[i].schemaName)
                  .set("schema", channels[i].schema)
                  .set("schemaEncoding", "jsonschema"));
  return Json::object().set("op", "advertise").set("channels", std::move(list)).text(-1);
}

void putLittleEndian(unsigned char* at, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) at[i] = static_cast<unsigned char>(value >> (8 * i) & 0xFF);
}

}  // namespace

struct FoxgloveServer::Impl {
  class Session;

  Impl(FoxgloveServerOptions given, std::vector<FoxgloveChannel> list)
      : options(std::move(given)),
        channels(std::move(list)),
        subscribers(channels.size()),
        latest(channels.size()) {
    if (options.maxClients < 1 || options.maxClients > 1000)
      throw std::invalid_argument("FoxgloveServerOptions: maxClients must be 1..1000");
    if (!(options.handshakeS > 0.0 && options.handshakeS <= 3600.0))
      throw std::invalid_argument("FoxgloveServerOptions: handshakeS must be in (0, 3600]");
    info = Json::object()
               .set("op", "serverInfo")
               .set("name", options.name)
               .set("capabilities", Json::array())
               .set("supportedEncodings", Json::array().push("json"))
               .set("metadata", Json::object())
               .text(-1);
    advertised = advertisement(channels);
    listen();
  }

  void listen() {
    const std::string place = options.address + ":" + std::to_string(options.port);
    BoostError failure;
    const auto address = asio::ip::make_address(options.address, failure);
    if (failure) throw Error("'" + options.address + "' is not a numeric address");
    const tcp::endpoint endpoint(address, options.port);
    acceptor.open(endpoint.protocol(), failure);
    if (!failure) acceptor.set_option(asio::socket_base::reuse_address(true), failure);
    if (!failure) acceptor.bind(endpoint, failure);
    if (!failure) acceptor.listen(asio::socket_base::max_listen_connections, failure);
    if (failure == asio::error::address_in_use)
      throw Error(place + ": another program listens at this port: choose another port");
    if (failure == asio::error::access_denied)
      throw Error(place + ": this port is the system's: choose one above 1023");
    if (failure) throw Error(place + ": can't listen: " + failure.message());
    port = acceptor.local_endpoint().port();
  }

  void start();
  void accept();
  void stop();
  void run() noexcept;
  void sendPosted();
  void ended(const std::shared_ptr<Session>& session);

  void refuse(const std::string& why) {
    const std::lock_guard lock(mutex);
    ++stats.refused;
    stats.lastRefusal = why;
  }
  void count(std::uint64_t FoxgloveServerStats::*counter, std::uint64_t by = 1) {
    const std::lock_guard lock(mutex);
    stats.*counter += by;
  }
  void join() {
    const std::lock_guard lock(mutex);
    ++stats.accepted;
    ++stats.clients;
  }
  void leave() {
    const std::lock_guard lock(mutex);
    --stats.clients;
  }
  void subscribed(std::size_t channel, int change) {
    const std::lock_guard lock(mutex);
    subscribers[channel] += change;
  }

  const FoxgloveServerOptions options;
  const std::vector<FoxgloveChannel> channels;
  std::string info, advertised;
  std::uint16_t port = 0;

  mutable std::mutex mutex;  // protects the next three
  std::vector<int> subscribers;
  std::deque<Posted> posted;
  FoxgloveServerStats stats;

  // Its handlers own sessions, whose destructors use the members above.
  asio::io_context context{1};
  tcp::acceptor acceptor{context};
  asio::steady_timer timer{context};
  // Used by the server's thread only.
  std::set<std::shared_ptr<Session>> sessions;
  std::vector<Posted> latest;  // of latched channels; no payload: none yet
  bool stopping = false;

  std::thread thread;
};

// One connection: the handshake, then messages in both directions.
class FoxgloveServer::Impl::Session : public std::enable_shared_from_this<Session> {
 public:
  Session(Impl& server, tcp::socket socket) : server_(server), stream_(std::move(socket)) {
    beast::get_lowest_layer(stream_).socket().set_option(tcp::no_delay(true), ignored_);
  }
  ~Session() {
    unsubscribeAll();
    if (connected_) server_.leave();
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Whether its handshake was valid.
  bool admitted() const noexcept { return admitted_; }

  void start() {
    parser_.header_limit(kMostHeaderBytes);
    parser_.body_limit(0);
    beast::get_lowest_layer(stream_).expires_after(
        std::chrono::milliseconds(static_cast<std::int64_t>(server_.options.handshakeS * 1000.0)));
    http::async_read_header(
        beast::get_lowest_layer(stream_),
        buffer_,
        parser_,
        [self = shared_from_this()](BoostError error, std::size_t) { self->onRequest(error); });
  }

  void say(const Posted& message) {
    for (const auto& [id, channel] : subscriptions_)
      if (channel == message.channel) sayOne(id, message, true);
  }

  void close() {
    if (!connected_) {
      beast::get_lowest_layer(stream_).socket().close(ignored_);
      return;
    }
    if (std::exchange(closing_, true)) return;
    stream_.async_close(websocket::close_code::going_away,
                        [self = shared_from_this()](BoostError) { self->server_.ended(self); });
  }

 private:
  void onRequest(BoostError error) {
    if (error) {
      server_.refuse(error == beast::error::timeout
                         ? "a client did not finish its handshake in time"
                         : "a connection was no HTTP request");
      return server_.ended(shared_from_this());
    }
    const auto& request = parser_.get();
    const auto text = [](beast::string_view view) { return std::string(view.data(), view.size()); };
    FoxgloveHandshake handshake;
    handshake.isUpgrade = websocket::is_upgrade(request);
    handshake.hasOneOrigin = request.count(http::field::origin) <= 1;
    handshake.origin = text(request[http::field::origin]);
    for (auto [at, end] = request.equal_range(http::field::sec_websocket_protocol); at != end; ++at)
      handshake.protocols += (handshake.protocols.empty() ? "" : ",") + text(at->value());
    handshake.clients = static_cast<std::size_t>(
        std::count_if(server_.sessions.begin(), server_.sessions.end(), [](const auto& session) {
          return session->admitted();
        }));
    handshake.maxClients = server_.options.maxClients;
    const FoxgloveReply reply = replyTo(handshake, server_.options.origins);
    if (reply.status != kSwitchingProtocols) return sendRefusal(reply);
    if (buffer_.size() > 0)
      return sendRefusal({400, "", "Data arrived before the handshake was finished."});
    accept(reply.protocol);
  }

  void sendRefusal(const FoxgloveReply& reply) {
    server_.refuse(reply.text);
    refusal_.result(static_cast<http::status>(reply.status));
    refusal_.version(11);
    refusal_.set(http::field::server, "Palpate");
    refusal_.set(http::field::content_type, "text/plain; charset=utf-8");
    if (reply.status == 426) refusal_.set(http::field::upgrade, "websocket");
    refusal_.body() = reply.text + "\n";
    refusal_.keep_alive(false);
    refusal_.prepare_payload();
    http::async_write(beast::get_lowest_layer(stream_),
                      refusal_,
                      [self = shared_from_this()](BoostError, std::size_t) {
                        beast::get_lowest_layer(self->stream_)
                            .socket()
                            .shutdown(tcp::socket::shutdown_send, self->ignored_);
                        self->server_.ended(self);
                      });
  }

  void accept(const std::string& protocol) {
    admitted_ = true;
    const auto limit =
        std::chrono::milliseconds(static_cast<std::int64_t>(server_.options.handshakeS * 1000.0));
    beast::get_lowest_layer(stream_).expires_never();
    stream_.set_option(websocket::stream_base::timeout{limit, kSilence, true});
    stream_.set_option(
        websocket::stream_base::decorator([protocol](websocket::response_type& response) {
          response.set(http::field::server, "Palpate");
          response.set(http::field::sec_websocket_protocol, protocol);
        }));
    stream_.read_message_max(kMostClientBytes);
    stream_.auto_fragment(false);  // a message is one frame: simple clients read no others
    stream_.async_accept(parser_.get(), [self = shared_from_this()](BoostError error) {
      if (error) {
        self->server_.refuse("a WebSocket handshake failed: " + error.message());
        return self->server_.ended(self);
      }
      self->connected_ = true;
      self->server_.join();
      self->queueText(std::make_shared<const std::string>(self->server_.info), false);
      self->queueText(std::make_shared<const std::string>(self->server_.advertised), false);
      self->read();
    });
  }

  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](BoostError error, std::size_t) {
      if (error) return self->server_.ended(self);
      const std::string text = beast::buffers_to_string(self->buffer_.data());
      const bool isText = self->stream_.got_text();
      self->buffer_.consume(self->buffer_.size());
      self->onMessage(isText, text);
      self->read();
    });
  }

  void onMessage(bool isText, const std::string& text) {
    const FoxgloveRequest request = isText ? readFoxgloveRequest(text, server_.channels.size())
                                           : FoxgloveRequest{.problem = kNothingIsTaken};
    for (const auto& [id, channel] : request.subscribe) subscribe(id, channel);
    for (const std::uint32_t id : request.unsubscribe) {
      const auto found = subscriptions_.find(id);
      if (found == subscriptions_.end()) continue;
      server_.subscribed(found->second, -1);
      subscriptions_.erase(found);
    }
    if (!request.problem.empty()) sayStatus(request.problem);
  }

  void subscribe(std::uint32_t id, std::size_t channel) {
    if (subscriptions_.size() >= kMostSubscriptions)
      return sayStatus("too many subscriptions: the limit is " +
                       std::to_string(kMostSubscriptions));
    if (!subscriptions_.emplace(id, channel).second)
      return sayStatus("subscription " + std::to_string(id) + " exists already");
    server_.subscribed(channel, 1);
    if (const Posted& latest = server_.latest[channel]; latest.payload) sayOne(id, latest, false);
  }

  void unsubscribeAll() {
    for (const auto& [id, channel] : subscriptions_) server_.subscribed(channel, -1);
    subscriptions_.clear();
  }

  // Level 1: a warning, shown among the problems of the connection.
  void sayStatus(const std::string& message) {
    queueText(
        std::make_shared<const std::string>(
            Json::object().set("op", "status").set("level", 1).set("message", message).text(-1)),
        true);
  }

  void sayOne(std::uint32_t id, const Posted& message, bool droppable) {
    Outgoing out;
    out.binary = true;
    out.droppable = droppable;
    out.content = message.payload;
    out.head[0] = 1;
    putLittleEndian(out.head.data() + 1, id, 4);
    putLittleEndian(
        out.head.data() + 5,
        static_cast<std::uint64_t>(std::max<std::int64_t>(message.timeUs, 0) * kServerNsPerUs),
        8);
    queue(std::move(out));
  }

  void queueText(SharedText text, bool droppable) {
    Outgoing out;
    out.droppable = droppable;
    out.content = std::move(text);
    queue(std::move(out));
  }

  // The message that is being sent stays where it is: the first one.
  void queue(Outgoing out) {
    if (closing_) return;
    waitingBytes_ += out.size();
    waiting_.push_back(std::move(out));
    std::uint64_t dropped = 0;
    auto oldest = waiting_.begin() + (writing_ ? 1 : 0);
    while (waitingBytes_ > server_.options.maxWaitingBytes && oldest != waiting_.end()) {
      if (!oldest->droppable) {
        ++oldest;
        continue;
      }
      waitingBytes_ -= oldest->size();
      oldest = waiting_.erase(oldest);
      ++dropped;
    }
    if (dropped > 0) server_.count(&FoxgloveServerStats::dropped, dropped);
    // What can't be dropped is little, unless a client asks for it again and again.
    if (waitingBytes_ > 2 * server_.options.maxWaitingBytes && waiting_.size() > 64) {
      beast::get_lowest_layer(stream_).close();
      return;
    }
    write();
  }

  void write() {
    if (writing_ || closing_ || waiting_.empty()) return;
    writing_ = true;
    const Outgoing& out = waiting_.front();
    stream_.binary(out.binary);
    const std::array<asio::const_buffer, 2> buffers{
        asio::const_buffer(out.head.data(), out.binary ? out.head.size() : 0),
        asio::const_buffer(out.content->data(), out.content->size())};
    stream_.async_write(buffers, [self = shared_from_this()](BoostError error, std::size_t) {
      self->writing_ = false;
      if (error) return self->server_.ended(self);
      if (self->waiting_.front().binary) self->server_.count(&FoxgloveServerStats::sent);
      self->waitingBytes_ -= self->waiting_.front().size();
      self->waiting_.pop_front();
      self->write();
    });
  }

  Impl& server_;
  websocket::stream<beast::tcp_stream> stream_;
  beast::flat_buffer buffer_;
  http::request_parser<http::empty_body> parser_;
  http::response<http::string_body> refusal_;
  BoostError ignored_;
  bool admitted_ = false;
  bool connected_ = false;  // the handshake is finished
  bool closing_ = false;
  bool writing_ = false;
  std::map<std::uint32_t, std::size_t> subscriptions_;  // channel by id
  std::deque<Outgoing> waiting_;
  std::size_t waitingBytes_ = 0;
};

void FoxgloveServer::Impl::start() {
  accept();
  thread = std::thread([this] { run(); });
}

// An exception of a handler ends only what this handler did: most likely memory was exhausted. The
// process that moves a hand continues.
void FoxgloveServer::Impl::run() noexcept {
  while (true) {
    try {
      context.run();
      return;
    } catch (...) {
      continue;
    }
  }
}

void FoxgloveServer::Impl::accept() {
  acceptor.async_accept([this](BoostError error, tcp::socket socket) {
    if (stopping || error == asio::error::operation_aborted) return;
    if (error) {  // the system has no descriptor left
      timer.expires_after(kAcceptRest);
      timer.async_wait([this](BoostError cancelled) {
        if (!cancelled && !stopping) accept();
      });
      return;
    }
    try {
      const auto unfinished = static_cast<std::size_t>(std::count_if(
          sessions.begin(), sessions.end(), [](const auto& each) { return !each->admitted(); }));
      if (unfinished >= kMostHandshakes) {
        refuse("too many connections at once");
      } else {
        const auto session = std::make_shared<Session>(*this, std::move(socket));
        sessions.insert(session);
        session->start();
      }
    } catch (...) {
      refuse("no memory for another client");
    }
    accept();
  });
}

void FoxgloveServer::Impl::ended(const std::shared_ptr<Session>& session) {
  sessions.erase(session);
  if (stopping && sessions.empty()) timer.cancel();
}

void FoxgloveServer::Impl::sendPosted() {
  while (true) {
    Posted next;
    {
      const std::lock_guard lock(mutex);
      if (posted.empty()) return;
      next = std::move(posted.front());
      posted.pop_front();
    }
    if (channels[next.channel].latched) latest[next.channel] = next;
    // A client whose connection fails leaves the set meanwhile.
    const std::vector<std::shared_ptr<Session>> now(sessions.begin(), sessions.end());
    for (const auto& session : now) {
      try {
        session->say(next);
      } catch (...) {
        count(&FoxgloveServerStats::dropped);  // no memory: the next message may find some
      }
    }
  }
}

// Called on the server's thread.
void FoxgloveServer::Impl::stop() {
  stopping = true;
  BoostError ignored;
  acceptor.close(ignored);
  timer.expires_after(kGoodbye);
  timer.async_wait([this](BoostError) { context.stop(); });
  const std::vector<std::shared_ptr<Session>> now(sessions.begin(), sessions.end());
  for (const auto& session : now) session->close();
  if (sessions.empty()) timer.cancel();
}

FoxgloveServer::FoxgloveServer(FoxgloveServerOptions options, std::vector<FoxgloveChannel> channels)
    : impl_(std::make_unique<Impl>(std::move(options), std::move(channels))) {
  impl_->start();
}

FoxgloveServer::~FoxgloveServer() {
  asio::post(impl_->context, [impl = impl_.get()] { impl->stop(); });
  impl_->thread.join();
  impl_->sessions.clear();
}

std::uint16_t FoxgloveServer::port() const noexcept { return impl_->port; }

std::string FoxgloveServer::url() const {
  const std::string& address = impl_->options.address;
  const bool bracketed = address.find(':') != std::string::npos;
  return "ws://" + (bracketed ? "[" + address + "]" : address) + ":" + std::to_string(impl_->port);
}

bool FoxgloveServer::wanted(std::size_t channel) const {
  if (impl_->channels.at(channel).latched) return true;
  const std::lock_guard lock(impl_->mutex);
  return impl_->subscribers[channel] > 0;
}

void FoxgloveServer::publish(std::size_t channel, std::int64_t timeUs, std::string payload) {
  const bool latched = impl_->channels.at(channel).latched;
  Posted next{channel, timeUs, std::make_shared<const std::string>(std::move(payload))};
  {
    const std::lock_guard lock(impl_->mutex);
    if (!latched && impl_->subscribers[channel] == 0) return;
    ++impl_->stats.published;
    if (impl_->posted.size() >= kMostPosted) {
      ++impl_->stats.dropped;
      return;
    }
    impl_->posted.push_back(std::move(next));
    if (impl_->posted.size() > 1) return;  // the thread has been called already
  }
  asio::post(impl_->context, [impl = impl_.get()] { impl->sendPosted(); });
}

FoxgloveServerStats FoxgloveServer::stats() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->stats;
}

}  // namespace palpate
