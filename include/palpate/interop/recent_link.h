// The health of the link for the outlets of live results, asked for at most four times per second
// of the frames' time.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <functional>
#include <optional>
#include <utility>

#include <palpate/capture/link_health.h>

namespace palpate {

// May be empty: nobody can be asked.
using LinkHealthQuery = std::function<LinkHealth()>;

// Not thread-safe.
class RecentLink {
 public:
  explicit RecentLink(LinkHealthQuery ask) : ask_(std::move(ask)) {}
  // Null where nobody can be asked; valid until the next call. `hostUs`: stamp of a frame [us],
  // which may jump in either direction when a new source starts.
  const LinkHealth* at(std::int64_t hostUs) {
    if (!ask_) return nullptr;
    if (!link_ || std::abs(hostUs - askedUs_) >= kIntervalUs) {
      link_ = ask_();
      askedUs_ = hostUs;
    }
    return &*link_;
  }

 private:
  static constexpr std::int64_t kIntervalUs = 250'000;

  LinkHealthQuery ask_;
  std::optional<LinkHealth> link_;
  std::int64_t askedUs_ = 0;
};

}  // namespace palpate
