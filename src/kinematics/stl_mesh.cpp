#include "palpate/kinematics/stl_mesh.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "palpate/core/byte_reader.h"
#include "palpate/core/error.h"
#include "palpate/core/file_name.h"
#include "palpate/core/text_file.h"

namespace palpate {
namespace {

constexpr std::size_t kMaxTriangles = 1'000'000;
constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kTriangleBytes = 50;
constexpr std::uint64_t kMaxBytes = 64u << 20;  // a million triangles, binary

std::vector<StlTriangle> readBinary(const std::string& bytes, const std::filesystem::path& path) {
  ByteReader reader(std::as_bytes(std::span(bytes)));
  reader.take(kHeaderBytes);
  const std::uint32_t count = reader.u32();
  if (count > kMaxTriangles) throw FormatError(path, "more than a million triangles");
  std::vector<StlTriangle> triangles(count);
  for (StlTriangle& triangle : triangles) {
    reader.take(12);  // the normal, which follows from the corners
    for (Eigen::Vector3f& corner : triangle)
      for (int i = 0; i < 3; ++i) corner[i] = reader.f32();
    reader.take(2);
    for (const Eigen::Vector3f& corner : triangle)
      if (!corner.allFinite()) throw FormatError(path, "a corner that is not a number");
  }
  return triangles;
}

// Words of a text, separated by white space.
class StlWords {
 public:
  explicit StlWords(std::string_view text) : text_(text) {}
  std::string_view next() {
    const std::size_t begin = text_.find_first_not_of(" \t\r\n", at_);
    if (begin == std::string_view::npos) {
      at_ = text_.size();
      return {};
    }
    at_ = std::min(text_.find_first_of(" \t\r\n", begin), text_.size());
    return text_.substr(begin, at_ - begin);
  }
  std::size_t offset() const { return at_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

std::vector<StlTriangle> readText(const std::string& text, const std::filesystem::path& path) {
  std::vector<StlTriangle> triangles;
  StlWords words(text);
  std::size_t corners = 0;
  StlTriangle triangle;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word == "endfacet") {
      if (corners != 3) throw FormatError(path, "a facet without three corners", words.offset());
      if (triangles.size() == kMaxTriangles)
        throw FormatError(path, "more than a million triangles");
      triangles.push_back(triangle);
      corners = 0;
    }
    if (word != "vertex") continue;
    if (corners == 3) throw FormatError(path, "a facet of more than three corners", words.offset());
    for (int i = 0; i < 3; ++i) {
      const std::string_view number = words.next();
      float value = 0.0F;
      const char* end = number.data() + number.size();
      const auto [stop, error] = std::from_chars(number.data(), end, value);
      if (number.empty() || error != std::errc() || stop != end || !std::isfinite(value))
        throw FormatError(path, "a corner that is not a number", words.offset());
      triangle[corners][i] = value;
    }
    ++corners;
  }
  return triangles;
}

}  // namespace

std::vector<StlTriangle> readStl(const std::filesystem::path& path) {
  const std::string bytes = readTextFile(path, kMaxBytes);
  // A binary file may begin with "solid", too; its length then tells.
  if (bytes.size() >= kHeaderBytes + 4) {
    ByteReader reader(std::as_bytes(std::span(bytes)));
    reader.take(kHeaderBytes);
    const std::uint64_t count = reader.u32();
    if (bytes.size() == kHeaderBytes + 4 + count * kTriangleBytes) return readBinary(bytes, path);
  }
  if (!bytes.starts_with("solid"))
    throw FormatError(path, "not an STL file: neither its length nor its first word fits");
  return readText(bytes, path);
}

std::vector<std::string> meshFaults(const GeometryDescription& hand) {
  std::vector<std::string> faults;
  for (const LinkShape& shape : hand.shapes) {
    if (shape.kind != LinkShape::Kind::kMesh) continue;
    std::string fault = shape.meshFault;
    if (fault.empty()) {
      try {
        readStl(shape.mesh);
        continue;
      } catch (const Error& error) {
        fault = error.what();
        if (lowerEndingOf(shape.mesh) != ".stl") fault += "; convert it to STL";
      }
    }
    fault = "the mesh " + fault + "; a box is drawn instead";
    if (std::find(faults.begin(), faults.end(), fault) == faults.end())
      faults.push_back(std::move(fault));
  }
  return faults;
}

}  // namespace palpate
