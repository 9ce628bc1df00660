// The part of the Arduino library that the sketches in docs/stream_senders use, so that a test can
// compile and run them: a sketch is included in a namespace inside of this one.
#pragma once

#include <cstdint>
#include <string>

namespace palpate::testing::arduino {

struct FakeSerial {
  std::string sent;
  void begin(unsigned long) {}
  void print(char c) { sent += c; }
  void print(const char* text) { sent += text; }
  void print(int value) { sent += std::to_string(value); }
  void print(unsigned long value) { sent += std::to_string(value); }
  void write(std::uint8_t value) { sent += static_cast<char>(value); }
};
inline FakeSerial Serial;
inline unsigned long fakeMicros = 0;
inline int fakeDrivenRow = -1;

constexpr int HIGH = 1;
constexpr int LOW = 0;
constexpr int OUTPUT = 1;
inline unsigned long millis() { return fakeMicros / 1000; }
inline unsigned long micros() { return fakeMicros; }
inline void pinMode(int, int) {}
inline void digitalWrite(int pin, int level) { fakeDrivenRow = level == HIGH ? pin - 2 : -1; }
// A value that names its row and column.
inline int analogRead(int column) { return 100 * fakeDrivenRow + column; }

}  // namespace palpate::testing::arduino
