#include "palpate/interop/foxglove_server.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/json.h"
#include "palpate/core/network_place.h"
#include "palpate/core/number_text.h"

#include "interop/foxglove_request.h"
#include "interop/foxglove_subscriber.h"
#include "interop/outlet_server.h"

namespace palpate {
namespace {
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;

constexpr std::size_t kMaxHeaderBytes = 8192;
constexpr std::size_t kMaxClientBytes = 256U << 10;
// Connections whose handshake is not finished yet; the oldest one gives way to a new connection.
constexpr std::size_t kMaxHandshakes = 64;
// Messages that may wait for the server's thread: a second of 60 channels at 30 Hz.
constexpr std::size_t kMaxPosted = 2048;
constexpr std::size_t kMaxPostedBytes = 16U << 20;
constexpr auto kSilence = std::chrono::seconds(60);

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

}  // namespace

struct FoxgloveServer::Impl {
  class Session;

  Impl(FoxgloveServerOptions given, std::vector<FoxgloveChannel> list)
      : options(checked(std::move(given))),
        channels(std::move(list)),
        info(Json::object()
                 .set("op", "serverInfo")
                 .set("name", options.name)
                 .set("capabilities", Json::array())
                 .set("supportedEncodings", Json::array().push("json"))
                 .set("metadata", Json::object())
                 .text(-1)),
        advertised(advertisement(channels)),
        place{options.address, options.port},
        subscribers(channels.size()),
        latest(channels.size()),
        server(listen(), [this](FileDescriptor socket) { accept(std::move(socket)); }) {
    server.start();
  }

  static FoxgloveServerOptions checked(FoxgloveServerOptions options) {
    if (options.maxClients < 1 || options.maxClients > 1000)
      throw std::invalid_argument("FoxgloveServerOptions: maxClients must be 1..1000");
    if (!(options.handshakeS > 0.0 && options.handshakeS <= 3600.0))
      throw std::invalid_argument("FoxgloveServerOptions: handshakeS must be in (0, 3600]");
    return options;
  }

  FileDescriptor listen() {
    try {
      return listenAt(place, place.text(), SOCK_STREAM, SOMAXCONN);
    } catch (const std::invalid_argument& problem) {
      throw Error(problem.what());
    } catch (const DeviceError& error) {  // no device: the program goes on without it
      throw Error(error.what());
    }
  }

  std::chrono::milliseconds handshakeLimit() const {
    return std::chrono::milliseconds(static_cast<std::int64_t>(options.handshakeS * 1000.0));
  }
  void accept(FileDescriptor socket);
  void makeRoom();
  void sendPosted();

  void refuse(const std::string& why) {
    const std::lock_guard lock(mutex);
    ++stats.refused;
    stats.lastRefusal = why;
  }
  void tellOrigin(const std::string& origin, const std::string& why) {
    constexpr std::size_t kMaxOrigins = 16;
    if (!options.onRefusedOrigin || refusedOrigins.size() == kMaxOrigins) return;
    if (refusedOrigins.insert(origin).second) options.onRefusedOrigin(why);
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
  const std::string info, advertised;
  NetworkPlace place;

  mutable std::mutex mutex;  // protects the next three
  std::vector<int> subscribers;
  OutletQueue<FoxgloveMessage> posted{kMaxPostedBytes, kMaxPosted};
  FoxgloveServerStats stats;

  // Used by the server's thread only.
  std::set<std::string> refusedOrigins;  // those that were told
  std::vector<FoxgloveMessage> latest;   // of latched channels

  OutletServer<Session> server;
};

// One connection: the handshake, then messages in both directions.
class FoxgloveServer::Impl::Session : public std::enable_shared_from_this<Session> {
 public:
  Session(Impl& server, tcp::socket socket)
      : server_(server),
        stream_(std::move(socket)),
        subscriber_(
            server.channels.size(),
            server.options.maxWaitingBytes,
            [&server](std::size_t channel, int change) { server.subscribed(channel, change); }) {
    beast::get_lowest_layer(stream_).socket().set_option(tcp::no_delay(true), ignored_);
  }
  ~Session() {
    if (connected_) server_.leave();
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Whether its handshake was valid.
  bool admitted() const noexcept { return admitted_; }

  void start() {
    parser_.header_limit(kMaxHeaderBytes);
    parser_.body_limit(0);
    beast::get_lowest_layer(stream_).expires_after(server_.handshakeLimit());
    http::async_read_header(
        beast::get_lowest_layer(stream_),
        buffer_,
        parser_,
        [self = shared_from_this()](BoostError error, std::size_t) { self->onRequest(error); });
  }

  void publish(const FoxgloveMessage& message) {
    subscriber_.publish(message);
    write();
  }

  void close() {
    if (!connected_) {
      beast::get_lowest_layer(stream_).socket().close(ignored_);
      return;
    }
    if (std::exchange(closing_, true)) return;
    stream_.async_close(websocket::close_code::going_away, [self = shared_from_this()](BoostError) {
      self->server_.server.ended(self.get());
    });
  }

 private:
  void onRequest(BoostError error) {
    if (error == asio::error::operation_aborted) return server_.server.ended(this);
    if (error) {
      server_.refuse(error == beast::error::timeout
                         ? "a client did not finish its handshake in time"
                         : "a connection sent no valid HTTP request");
      return server_.server.ended(this);
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
        std::count_if(server_.server.sessions().begin(),
                      server_.server.sessions().end(),
                      [](const auto& session) { return session->admitted(); }));
    handshake.maxClients = server_.options.maxClients;
    const FoxgloveReply reply = replyTo(handshake, server_.options.origins);
    if (reply.status == kForbidden) server_.tellOrigin(handshake.origin, reply.text);
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
                        self->server_.server.ended(self.get());
                      });
  }

  void accept(const std::string& protocol) {
    admitted_ = true;
    beast::get_lowest_layer(stream_).expires_never();
    stream_.set_option(websocket::stream_base::timeout{server_.handshakeLimit(), kSilence, true});
    stream_.set_option(
        websocket::stream_base::decorator([protocol](websocket::response_type& response) {
          response.set(http::field::server, "Palpate");
          response.set(http::field::sec_websocket_protocol, protocol);
        }));
    stream_.read_message_max(kMaxClientBytes);
    stream_.auto_fragment(false);  // a message is one frame: simple clients read no others
    stream_.async_accept(parser_.get(), [self = shared_from_this()](BoostError error) {
      if (error) {
        self->server_.refuse("a WebSocket handshake failed: " + error.message());
        return self->server_.server.ended(self.get());
      }
      self->connected_ = true;
      self->server_.join();
      self->subscriber_.queueText(self->server_.info);
      self->subscriber_.queueText(self->server_.advertised);
      self->write();
      self->read();
    });
  }

  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](BoostError error, std::size_t) {
      if (error) return self->server_.server.ended(self.get());
      const std::string text = beast::buffers_to_string(self->buffer_.data());
      self->buffer_.consume(self->buffer_.size());
      self->subscriber_.take(self->stream_.got_text(), text, self->server_.latest);
      self->write();
      self->read();
    });
  }

  // The message that is being sent has left the queue, from which others may be dropped meanwhile.
  void write() {
    OutletQueue<FoxgloveOutgoing>& waiting = subscriber_.waiting();
    if (const std::uint64_t dropped = waiting.takeDropped(); dropped > 0)
      server_.count(&FoxgloveServerStats::dropped, dropped);
    if (waiting.isOverrun()) return beast::get_lowest_layer(stream_).close();
    if (sending_ || closing_) return;
    sending_ = waiting.pop();
    if (!sending_) return;
    stream_.binary(sending_->binary);
    const std::array<asio::const_buffer, 2> buffers{
        asio::const_buffer(sending_->head.data(), sending_->binary ? sending_->head.size() : 0),
        asio::const_buffer(sending_->content->data(), sending_->content->size())};
    stream_.async_write(buffers, [self = shared_from_this()](BoostError error, std::size_t) {
      const bool isMessage = self->sending_->binary;
      self->sending_.reset();
      if (error) return self->server_.server.ended(self.get());
      if (isMessage) self->server_.count(&FoxgloveServerStats::sent);
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
  FoxgloveSubscriber subscriber_;
  std::optional<FoxgloveOutgoing> sending_;
};

void FoxgloveServer::Impl::accept(FileDescriptor socket) try {
  makeRoom();
  const bool isV6 = place.address.find(':') != std::string::npos;
  const auto session = std::make_shared<Session>(
      *this, tcp::socket(server.context(), isV6 ? tcp::v6() : tcp::v4(), socket.release()));
  server.add(session);
  session->start();
} catch (...) {
  refuse("no memory for another client");
}

void FoxgloveServer::Impl::makeRoom() {
  const auto& sessions = server.sessions();
  const auto isUnfinished = [](const auto& each) { return !each->admitted(); };
  const auto unfinished = std::count_if(sessions.begin(), sessions.end(), isUnfinished);
  if (static_cast<std::size_t>(unfinished) < kMaxHandshakes) return;
  const auto oldest = *std::find_if(sessions.begin(), sessions.end(), isUnfinished);
  refuse("an unfinished handshake gave way to a new connection: there were " +
         std::to_string(unfinished));
  oldest->close();
  server.ended(oldest.get());
}

// Sends what was posted up to now. What is posted meanwhile waits until the thread has served its
// connections: publish() calls it again.
void FoxgloveServer::Impl::sendPosted() {
  OutletQueue<FoxgloveMessage> messages(kMaxPostedBytes, kMaxPosted);
  {
    const std::lock_guard lock(mutex);
    std::swap(messages, posted);
  }
  while (const auto message = messages.pop()) {
    if (channels[message->channel].latched) latest[message->channel] = *message;
    for (const auto& session : server.sessions()) {
      try {
        session->publish(*message);
      } catch (...) {
        count(&FoxgloveServerStats::dropped);  // no memory: the next message may find some
      }
    }
  }
}

FoxgloveServer::FoxgloveServer(FoxgloveServerOptions options, std::vector<FoxgloveChannel> channels)
    : impl_(std::make_unique<Impl>(std::move(options), std::move(channels))) {}

FoxgloveServer::~FoxgloveServer() = default;

std::uint16_t FoxgloveServer::port() const noexcept { return impl_->place.port; }

std::string FoxgloveServer::url() const { return "ws://" + impl_->place.text(); }

bool FoxgloveServer::wanted(std::size_t channel) const {
  if (impl_->channels.at(channel).latched) return true;
  const std::lock_guard lock(impl_->mutex);
  return impl_->subscribers[channel] > 0;
}

void FoxgloveServer::publish(std::size_t channel, std::int64_t timeUs, std::string payload) {
  const bool latched = impl_->channels.at(channel).latched;
  FoxgloveMessage next{
      channel, timeUs, std::make_shared<const std::string>(std::move(payload)), !latched};
  {
    const std::lock_guard lock(impl_->mutex);
    if (!latched && impl_->subscribers[channel] == 0) return;
    ++impl_->stats.published;
    if (impl_->posted.isOverrun()) {
      ++impl_->stats.dropped;
      return;
    }
    const bool called = impl_->posted.size() > 0;
    impl_->posted.push(std::move(next));
    impl_->stats.dropped += impl_->posted.takeDropped();
    if (called) return;  // the thread comes for it
  }
  asio::post(impl_->server.context(), [impl = impl_.get()] { impl->sendPosted(); });
}

FoxgloveServerStats FoxgloveServer::stats() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->stats;
}

}  // namespace palpate
