// Fake tactile controller for port probes: answers with the literal bytes of the protocol document,
// sections 4.1 and 1.6.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace palpate::testing {

class FakeTactileAnswers {
 public:
  using Bytes = std::vector<std::byte>;

  bool streaming = false;
  bool answersQuery = true;
  int stops = 0;

  // Section 1.6.2: an empty frame at t = 1024 ms.
  static Bytes frame() {
    Bytes bytes = of({0xAA, 0xAA, 0xAA, 0x00, 0x47, 0x00, 0x00, 0x04, 0x00, 0x00, 0x01});
    for (int i = 0; i < 32; ++i) append(bytes, of({0x00, 0xF0}));
    append(bytes, of({0x00, 0x60, 0x40, 0xFB}));
    return bytes;
  }

  Bytes receive(const Bytes& request) {
    append(pending_, request);
    Bytes answer;
    for (;;) {
      const Bytes stop = of({0xAA, 0xAA, 0xAA, 0x03, 0x03, 0x00, 0x01, 0x00, 0x00, 0x2F, 0x6A});
      const Bytes query = of({0xAA, 0xAA, 0xAA, 0x01, 0x00, 0x00});
      if (take(stop)) {
        ++stops;
        if (streaming) append(answer, frame());  // a frame that was already on the way
        streaming = false;
        append(answer, of({0xAA, 0xAA, 0xAA, 0x03, 0x02, 0x00, 0x00, 0x00, 0x4B, 0xB9}));
      } else if (take(query)) {
        if (answersQuery)
          append(answer, of({0xAA, 0xAA, 0xAA, 0x01, 0x12, 0x00, 0x00, 0x00, 0x57,
                             0x00, 0x9B, 0x1D, 0x10, 0x00, 0x29, 0x80, 0x70, 0x00,
                             0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x2F, 0x36}));
      } else {
        break;
      }
    }
    if (streaming) append(answer, frame());
    return answer;
  }

 private:
  static Bytes of(std::initializer_list<int> values) {
    Bytes bytes;
    for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
    return bytes;
  }
  static void append(Bytes& to, const Bytes& bytes) {
    to.insert(to.end(), bytes.begin(), bytes.end());
  }
  bool take(const Bytes& command) {
    const auto at = std::search(pending_.begin(), pending_.end(), command.begin(), command.end());
    if (at == pending_.end()) return false;
    pending_.erase(pending_.begin(), at + static_cast<std::ptrdiff_t>(command.size()));
    return true;
  }

  Bytes pending_;
};

}  // namespace palpate::testing
