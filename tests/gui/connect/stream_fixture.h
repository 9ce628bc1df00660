// A window that receives a stream of another hand, and the sender of that stream over loopback.
#pragma once

#include <QTimer>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <palpate/core/error.h>
#include <palpate/core/number_text.h>
#include <palpate/device/byte_channel.h>

#include "gui/testing/window_fixture.h"

namespace palpate::gui {

class StreamWindowTest : public WindowTest {
 protected:
  ~StreamWindowTest() override {
    timer_.stop();
    window_.reset();
  }
  static bool await(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 20'000);
  }
  LiveController& live() { return window().state().live; }
  // Connects to a stream of `hand` (a name or a folder) and waits until a sender is awaited.
  void listen(const std::string& hand) {
    Connection connection;
    connection.kind = Connection::Kind::kStream;
    connection.stream.source = "listen:0";
    connection.stream.hand = QString::fromStdString(hand);
    window().state().connectTo(connection);
    ASSERT_TRUE(await([&] {
      return live().source() && live().source()->streamDevice()->localPort().has_value();
    }));
  }
  void plugIn() {
    channel_ = openChannel("tcp:127.0.0.1:" +
                           std::to_string(*live().source()->streamDevice()->localPort()));
  }
  void unplug() { channel_.reset(); }
  void send(const std::string& line) {
    const std::string whole = line + "\n";
    channel_->write(std::as_bytes(std::span(whole)));
  }
  // The next frame; its numbers are counted.
  void sendFrame(const std::vector<float>& values) {
    std::string line = "frame#" + std::to_string(number_++);
    for (const float value : values) line += " " + numberText(value);
    send(line);
  }
  // Sends these lines again and again, with a frame between each two, until stopSending().
  void sendAgain(std::vector<float> values, std::vector<std::string> lines = {}) {
    timer_.disconnect();
    QObject::connect(&timer_, &QTimer::timeout, [this, values, lines] {
      // After unplug() there is none.
      if (!channel_) return;
      sendFrame(values);
      for (const std::string& line : lines) send(line);
    });
    timer_.start(10);
  }
  void stopSending() { timer_.stop(); }
  // Connects to `hand`, and shows frames with these values.
  void show(const std::string& hand,
            const std::vector<float>& values,
            std::vector<std::string> lines = {}) {
    listen(hand);
    plugIn();
    sendAgain(values, std::move(lines));
    ASSERT_TRUE(await([&] { return !live().stale() && window().state().displayed.isLive(); }));
  }

  std::uint32_t number_ = 0;

 private:
  std::unique_ptr<ByteChannel> channel_;
  QTimer timer_;
};

}  // namespace palpate::gui
