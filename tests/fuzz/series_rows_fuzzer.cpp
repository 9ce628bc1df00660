// Fuzzes what a native file says of its series and of touch, with right checksums: the rules of
// touch, then a byte more than the number of the stream, name, role, source and JSON of the columns
// of each series; a zero byte ends each of them. Whatever they say, reading and recovery give valid
// series with the same samples or refuse the file in one line.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <sqlite3.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/model/touch.h"
#include "palpate/recording/palpate_reader.h"
#include "palpate/recording/palpate_recovery.h"
#include "palpate/recording/palpate_writer.h"

#include "recording/native/palpate_rows.h"

namespace {

using namespace palpate;

constexpr int kSamples = 3;

void require(bool condition) {
  if (!condition) std::abort();
}

const std::filesystem::path& folder() {
  static const std::filesystem::path path = [] {
    const std::filesystem::path memory = "/dev/shm";
    auto root =
        std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    return root / ("palpate-rows-" + std::to_string(getpid()));
  }();
  return path;
}

// A file with one further series of two columns; its description is taken out.
void writePlain(const std::filesystem::path& path) {
  PalpateWriterOptions options;
  options.synced = false;
  const SensorLayout layout({MatrixLayout::full(2, 2, 2.0)});
  PalpateWriter writer(path, std::make_shared<const SensorLayout>(layout), {}, options);
  writer.addSeries({"wrist", "", {{"a", ""}, {"b", ""}}, ""});
  for (int i = 0; i < kSamples; ++i) {
    TactileFrame frame(std::make_shared<const SensorLayout>(layout));
    frame.hostUs = 1'000'000 + i;
    writer.addFrame(frame);
    writer.addSample({1'000'000 + i, {1.0, 2.0}, kHandSeries});
  }
  writer.finish();
}

class Rows {
 public:
  explicit Rows(const std::filesystem::path& path) {
    require(sqlite3_open(path.c_str(), &database_) == SQLITE_OK);
    run("PRAGMA journal_mode=MEMORY; PRAGMA synchronous=OFF; BEGIN; DELETE FROM series;");
  }
  ~Rows() {
    run("COMMIT");
    sqlite3_close(database_);
  }
  void run(const char* sql) { sqlite3_exec(database_, sql, nullptr, nullptr, nullptr); }
  // Integers stand for themselves, everything else is a text.
  void insert(const char* sql, const std::vector<std::string>& texts, std::uint32_t crc) {
    sqlite3_stmt* row = nullptr;
    require(sqlite3_prepare_v2(database_, sql, -1, &row, nullptr) == SQLITE_OK);
    int at = 0;
    for (const std::string& text : texts)
      sqlite3_bind_text(row, ++at, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
    sqlite3_bind_int64(row, ++at, crc);
    sqlite3_step(row);  // refused where the number is taken
    sqlite3_finalize(row);
  }

 private:
  sqlite3* database_ = nullptr;
};

std::string takeText(std::string_view& all) {
  const std::size_t end = all.find('\0');
  std::string text(all.substr(0, end));
  all.remove_prefix(end == std::string_view::npos ? all.size() : end + 1);
  return text;
}

void addRows(const std::filesystem::path& path, std::string_view all) {
  Rows rows(path);
  const std::string rules = takeText(all);
  if (!rules.empty())
    rows.insert("INSERT OR REPLACE INTO meta VALUES(?, ?, ?)",
                {kTouchRulesKey, rules},
                metaCrc(kTouchRulesKey, rules));
  while (!all.empty()) {
    const std::int64_t stream = static_cast<unsigned char>(all.front()) - 1;
    all.remove_prefix(1);
    std::vector<std::string> texts{std::to_string(stream)};
    for (int i = 0; i < 4; ++i) texts.push_back(takeText(all));
    const auto series = seriesFrom(texts[1], texts[2], texts[3], texts[4]);
    rows.insert("INSERT INTO series VALUES(?, ?, ?, ?, ?, ?)",
                texts,
                series ? seriesCrc(stream, *series) : 0);
  }
}

void requireValid(const Profile& profile) {
  require(profile.series().size() > kHandSeries && profile.series().size() <= kMaxSeries);
  for (std::size_t s = kHandSeries; s < profile.series().size(); ++s) {
    const SeriesDescription& series = profile.series()[s];
    validate(series);
    require(std::ranges::count(profile.series(), series.name, &SeriesDescription::name) == 1);
    for (std::size_t i = 0; i < profile.numSamples(s); ++i)
      require(profile.sample(s, i).values.size() == series.columns.size());
  }
  for (std::size_t i = 0; i < profile.numFrames(); ++i)
    require(profile.frame(i).values.size() == 4);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto plain = folder() / "plain.palpate";
  const auto path = folder() / "a.palpate";
  std::filesystem::create_directories(folder());
  if (!std::filesystem::exists(plain)) writePlain(plain);
  std::filesystem::copy_file(plain, path, std::filesystem::copy_options::overwrite_existing);
  addRows(path, {reinterpret_cast<const char*>(data), size});
  const auto requireLine = [](const std::exception& error) {
    require(std::string_view(error.what()).find('\n') == std::string_view::npos);
  };
  try {
    requireValid(readPalpate(path).profile);
  } catch (const FormatError& error) {
    requireLine(error);
  }
  const PalpateRecovery recovery = recoverPalpateProfile(path);
  if (recovery.profile) requireValid(*recovery.profile);
  return 0;
}
