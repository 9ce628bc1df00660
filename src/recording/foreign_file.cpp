#include "palpate/recording/foreign_file.h"

#include <algorithm>
#include <string_view>
#include <system_error>

#include "palpate/core/text_file.h"
#include "palpate/recording/hdf5_recording.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

using namespace std::string_view_literals;

constexpr const char* kSqliteBag =
    "is a bag of ROS 2 in SQLite: convert it to MCAP (ros2 bag convert), then use palpate convert";
constexpr const char* kIsRecording = "is a recording already: open or convert it";

// What the first bytes of a file say.
struct KnownStart {
  std::string_view start;
  const char* text;
};
constexpr KnownStart kReadStarts[] = {
    {"BZh"sv, kIsRecording},
    {kHdf5RecordingStart, kIsRecording},
    {"\x89MCAP0\r\n"sv, "is an MCAP file: palpate convert makes a recording of it"},
};
constexpr KnownStart kKnownStarts[] = {
    {"\xD0\xCF\x11\xE0"sv, "is an Excel workbook: save it as CSV"},
    {"PAR1"sv, "is a Parquet file: save it as CSV (pandas: read_parquet, to_csv)"},
    {"ARROW1"sv, "is a Feather file: save it as CSV (pandas: read_feather, to_csv)"},
    {"XDF:"sv, "is an XDF file of LabStreamingLayer: save its streams as CSV or .npz (pyxdf)"},
    {"#ROSBAG"sv, "is a bag of ROS 1: convert it to MCAP (mcap convert), then use palpate convert"},
    {"TDSm"sv, "is a TDMS file of LabVIEW: save it as CSV or .npz (npTDMS)"},
    {"version https://git-lfs"sv,
     "is a pointer of Git LFS, not the file itself: fetch it with git lfs pull"},
    {"\x80\x02"sv, "is a pickle of Python: save its arrays as .npz"},
    {"\x80\x03"sv, "is a pickle of Python: save its arrays as .npz"},
    {"\x80\x04"sv, "is a pickle of Python: save its arrays as .npz"},
    {"\x80\x05"sv, "is a pickle of Python: save its arrays as .npz"},
    {"\x1F\x8B"sv, "is compressed; unpack it with gunzip"},
    {"\x28\xB5\x2F\xFD"sv, "is compressed; unpack it with unzstd"},
    {"\xFD"
     "7zXZ"sv,
     "is compressed; unpack it with unxz"},
};

// How often bytes 0 begin: in a text not at all, or once where power was cut.
std::size_t numNulRuns(std::string_view bytes) {
  std::size_t runs = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    runs += bytes[i] == 0 && (i == 0 || bytes[i - 1] != 0) ? 1 : 0;
  return runs;
}

bool isUtf16(std::string_view bytes) {
  // A byte 0 beside each letter.
  constexpr int kFirstLetter = '\t';
  return bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF") ||
         (bytes.size() >= 4 && (bytes[0] == 0) == (bytes[2] == 0) &&
          (bytes[1] == 0) == (bytes[3] == 0) && (bytes[0] == 0) != (bytes[1] == 0) &&
          bytes[0] + bytes[1] >= kFirstLetter && bytes[2] + bytes[3] >= kFirstLetter);
}

}  // namespace

std::string bagFolderText(const fs::path& folder) {
  std::error_code failure;
  bool isSqlite = false;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure)) {
    if (entry.path().extension() == ".mcap")
      return "is the folder of a bag of ROS 2: name its file " + entry.path().filename().string();
    isSqlite = isSqlite || entry.path().extension() == ".db3";
  }
  return isSqlite ? kSqliteBag : "";
}

std::string foreignFormatText(const fs::path& path) {
  constexpr std::size_t kLookedAt = 512;
  constexpr std::size_t kSqliteIdAt =
      68;  // of a native recording, see docs/notes/palpate_format.md
  const std::string bytes = beginningOfFile(path, kLookedAt);
  const std::string_view first = bytes;
  for (const auto& [start, text] : kKnownStarts)
    if (first.starts_with(start)) return text;
  if (first.starts_with("SQLite f") && path.extension() == ".db3" &&
      first.substr(std::min(kSqliteIdAt, first.size()), 4) != "PALP")
    return kSqliteBag;
  if (first.starts_with("PK") && (first.find("[Content_Types].xml") != std::string_view::npos ||
                                  first.find("xl/") != std::string_view::npos))
    return "is an Excel workbook: save it as CSV";
  if (first.starts_with("PK") && first.find("opendocument") != std::string_view::npos)
    return "is a spreadsheet of OpenDocument: save it as CSV";
  return {};
}

std::string foreignFileText(const fs::path& path) {
  constexpr std::size_t kLookedAt = 512;
  constexpr std::size_t kMaxNulRuns = 4;
  std::error_code failure;
  if (fs::is_directory(path, failure)) return bagFolderText(path);
  if (const std::string known = foreignFormatText(path); !known.empty()) return known;
  const std::string bytes = beginningOfFile(path, kLookedAt);
  const std::string_view first = bytes;
  for (const auto& [start, text] : kReadStarts)
    if (first.starts_with(start)) return text;
  if (first.starts_with("SQLite f")) return kIsRecording;
  if (first.starts_with("PK") || first.starts_with("\x93NUMPY")) return {};
  if (isUtf16(first)) return "is a text in UTF-16; save it as UTF-8";
  if (numNulRuns(first) > kMaxNulRuns)
    return "is neither a text nor a known table: it holds bytes 0";
  return {};
}

}  // namespace palpate
