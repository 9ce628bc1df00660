#include "imports/npz_source.h"

#include <algorithm>
#include <array>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

// Of all arrays of a file, as NumPy writes them 128 bytes each.
constexpr std::size_t kNpyHeadersBytes = 16u << 20;

}  // namespace

NpzSource::NpzSource(const std::filesystem::path& path) : StoredArraySource(path) {
  std::array<std::byte, 4> magic{};
  file_.read(
      0,
      std::span(magic).first(static_cast<std::size_t>(std::min<std::uint64_t>(4, file_.size()))));
  isArchive_ = magic[0] == std::byte{'P'} && magic[1] == std::byte{'K'};
  std::size_t headerBytes = 0;
  // The header of an array, from its first bytes. `read` gives the bytes from the start of the
  // array.
  const auto headerFrom = [&](const std::string& name, std::uint64_t size, const auto& read) {
    std::vector<std::byte> head(static_cast<std::size_t>(std::min<std::uint64_t>(12, size)));
    read(std::span(head));
    const std::size_t needed = std::min(npyHeaderBytes(head).value_or(0), kMaxNpyHeaderBytes);
    const std::size_t before = head.size();
    if (needed > before) {
      head.resize(static_cast<std::size_t>(std::min<std::uint64_t>(needed, size)));
      read(std::span(head).subspan(before));
    }
    headerBytes += head.size();
    if (headerBytes > kNpyHeadersBytes)
      throw FormatError(path_, "has too many arrays, or descriptions of them that are too long");
    try {
      return parseNpyHeader(head);
    } catch (const FormatError&) {
      throw;
    } catch (const Error& error) {
      throw FormatError(path_, (name.empty() ? "" : inQuotes(name) + ": ") + error.what());
    }
  };
  if (!isArchive_) {
    std::uint64_t at = 0;
    NpyHeader header = headerFrom("", file_.size(), [&](std::span<std::byte> bytes) {
      file_.read(at, bytes);
      at += bytes.size();
    });
    addColumn("array", std::move(header), file_.size());
    return;
  }
  constexpr std::string_view kEnding = ".npy";
  for (ZipEntry& entry : readZipDirectory(file_)) {
    if (!entry.name.ends_with(kEnding)) continue;
    ZipEntryReader reader(file_, entry);
    const std::string name = entry.name.substr(0, entry.name.size() - kEnding.size());
    const std::uint64_t size = entry.size;
    addColumn(name,
              headerFrom(name, size, [&](std::span<std::byte> bytes) { reader.read(bytes); }),
              size);
    entries_.push_back(std::move(entry));
  }
  if (columns_.empty()) throw FormatError(path_, "is a zip file without arrays (.npy)");
}

void NpzSource::addColumn(const std::string& name, NpyHeader header, std::uint64_t available) {
  if (header.kind != NumberKind::kOther) {
    const auto bytes = header.numBytes();
    if (!bytes || *bytes > available - header.dataOffset)
      throw FormatError(path_,
                        inQuotes(name) +
                            " declares more numbers than it holds: it is cut off, or "
                            "its shape is wrong");
  }
  std::string type = header.typeName();
  addArray(name, std::move(header), std::move(type));
}

std::string NpzSource::form() const {
  return isArchive_ ? "NumPy .npz, " + counted(columns_.size(), "array") : "NumPy .npy, one array";
}

std::unique_ptr<SequentialReader> NpzSource::unpacked(std::size_t column) {
  if (!isArchive_) return nullptr;
  auto reader = std::make_unique<ZipEntryReader>(file_, entries_[column]);
  reader->skip(arrays_[column].header.dataOffset);
  return reader;
}

// np.save() into an open file appends arrays, which NumPy reads one after the other.
std::string NpzSource::rowNote() const {
  const NpyHeader& header = arrays_.front().header;
  const std::uint64_t end = header.dataOffset + header.numBytes().value_or(0);
  if (isArchive_ || header.kind == NumberKind::kOther || end >= file_.size()) return {};
  return std::to_string(file_.size() - end) +
         " bytes after the array are not read: what they hold (another array?) is not imported";
}

}  // namespace palpate
