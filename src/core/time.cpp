#include "palpate/core/time.h"

#include <chrono>
#include <cstdio>
#include <ctime>
#include <iomanip>
#include <sstream>

namespace palpate {
namespace {

class SystemClock final : public Clock {
 public:
  std::int64_t monotonicUs() const override { return read(CLOCK_BOOTTIME); }
  std::int64_t wallUs() const override { return read(CLOCK_REALTIME); }

 private:
  static std::int64_t read(clockid_t clock) {
    timespec now{};
    ::clock_gettime(clock, &now);
    return std::int64_t{now.tv_sec} * 1'000'000 + now.tv_nsec / 1000;
  }
};

}  // namespace

const Clock& systemClock() {
  static const SystemClock clock;
  return clock;
}

HostTime::HostTime(const Clock& clock)
    : clock_(clock), wallStartUs_(clock.wallUs()), monotonicStartUs_(clock.monotonicUs()) {}

std::int64_t HostTime::nowUs() const {
  return wallStartUs_ + (clock_.monotonicUs() - monotonicStartUs_);
}

std::int64_t HostTime::wallOffsetUs() const { return clock_.wallUs() - nowUs(); }

std::string utcText(std::int64_t hostUs) {
  using std::chrono::days;
  using std::chrono::floor;
  using std::chrono::microseconds;
  using std::chrono::milliseconds;
  const std::chrono::sys_time<microseconds> time{microseconds(hostUs)};
  const auto day = floor<days>(time);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss clock(floor<milliseconds>(time - day));
  char text[64];
  std::snprintf(text,
                sizeof text,
                "%04d-%02u-%02u %02d:%02d:%02d.%03d",
                static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()),
                static_cast<unsigned>(date.day()),
                static_cast<int>(clock.hours().count()),
                static_cast<int>(clock.minutes().count()),
                static_cast<int>(clock.seconds().count()),
                static_cast<int>(clock.subseconds().count()));
  return text;
}

std::string localText(std::int64_t hostUs, const char* format) {
  const std::time_t seconds =
      std::chrono::floor<std::chrono::seconds>(std::chrono::microseconds(hostUs)).count();
  std::tm parts{};
  ::localtime_r(&seconds, &parts);
  std::ostringstream text;
  text << std::put_time(&parts, format);
  return text.str();
}

}  // namespace palpate
