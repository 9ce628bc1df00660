#include "recording/dsa_corpus.h"

#include <cstring>
#include <fstream>
#include <stdexcept>

#include <bzlib.h>

namespace palpate::testing {
namespace {

constexpr int kSdh2Rows[] = {14, 13, 14, 13, 14, 13};
constexpr std::size_t kSdh2Places = 486;

std::string element(std::string_view name, std::string_view text) {
  std::string out = "<";
  out.append(name).append(">").append(text).append("</").append(name).append(">\n");
  return out;
}

std::string matrixXml(int rows, int columns, std::string mask = "") {
  if (mask.empty())
    mask.assign(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns), '1');
  return "<matrix index=\"0\" name=\"\">\n" + element("cells_x", std::to_string(columns)) +
         element("cells_y", std::to_string(rows)) + element("texel_width", "3.4") +
         element("texel_height", "3.4") + element("static_mask", mask) +
         element("dynamic_mask", mask) + "</matrix>\n";
}

// The fingertips' (13 rows) upper corners are cut.
std::string sdh2Mask(int rows) {
  std::string mask;
  for (int y = 0; y < rows; ++y) mask += rows == 13 && y < 5 ? "011110" : "111111";
  return mask;
}

std::string hex(std::uint32_t bits) {
  std::string out;
  for (int shift = 28; shift >= 0; shift -= 4) out += "0123456789ABCDEF"[bits >> shift & 15u];
  return out;
}

std::uint32_t scrambled(std::uint32_t x) {  // Murmur3's finisher
  x ^= x >> 16;
  x *= 0x85EBCA6Bu;
  x ^= x >> 13;
  x *= 0xC2B2AE35u;
  return x ^ x >> 16;
}

struct Compressor {
  explicit Compressor(int level) {
    if (BZ2_bzCompressInit(&z, level, 0, 0) != BZ_OK) throw std::bad_alloc();
  }
  ~Compressor() { BZ2_bzCompressEnd(&z); }
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;

  template <typename Sink>
  void run(std::string_view text, int action, Sink&& sink) {
    char buffer[65536];
    z.next_in = const_cast<char*>(text.data());
    z.avail_in = static_cast<unsigned>(text.size());
    int result = BZ_OK;
    do {
      z.next_out = buffer;
      z.avail_out = sizeof buffer;
      result = BZ2_bzCompress(&z, action);
      sink(std::string_view(buffer, sizeof buffer - z.avail_out));
    } while (action == BZ_RUN ? z.avail_in > 0 : result != BZ_STREAM_END);
  }
  bz_stream z{};
};

}  // namespace

std::string exampleXml() {
  return R"(<?xml version="1.0" encoding="utf-8"?>
<root>
  <sensor name="">
    <generated_by>105</generated_by>
    <hw_revision>1</hw_revision>
    <serial_nr>00000001</serial_nr>
    <num_matrices>1</num_matrices>
    <converter_resolution>12</converter_resolution>
    <matrix index="0" name="">
      <cells_x>3</cells_x>
      <cells_y>2</cells_y>
      <texel_width>3.4</texel_width>
      <texel_height>3.4</texel_height>
      <matrix_center_x>0</matrix_center_x>
      <matrix_center_y>0</matrix_center_y>
      <matrix_center_z>0</matrix_center_z>
      <theta_x>0</theta_x>
      <theta_y>0</theta_y>
      <theta_z>0</theta_z>
      <output_unit>mV</output_unit>
      <hw_revision>1</hw_revision>
      <one_wire_uid>Not implemented yet</one_wire_uid>
      <fullscale>4095</fullscale>
      <static_mask>111 111</static_mask>
      <dynamic_mask>111 111</dynamic_mask>
    </matrix>
  </sensor>
  <data>
    <frame_count>2</frame_count>
    <frame index="0">
      <time_stamp>1400000000000</time_stamp>
      <frame_data>C0C00000</frame_data>
    </frame>
    <frame index="1">
      <time_stamp>1400000000032</time_stamp>
      <frame_data>C0000000 42C80000 BF800000 447A0000 BF800000</frame_data>
    </frame>
  </data>
  <temperatures>
    <temp_count>1</temp_count>
    <temp index="0">
      <time_stamp>1400000000010</time_stamp>
      <temp_data>35.50, 35.00, 31.25, 35.25, 31.50, 34.50, 32.00, 44.50, 44.25</temp_data>
    </temp>
  </temperatures>
  <joint_angles>
    <angle_count>1</angle_count>
    <angle index="0">
      <time_stamp>1400000000001</time_stamp>
      <angle_data>60.00000, -10.00000, 10.00000, -90.00000, 0.00000, -10.00000, 10.00000</angle_data>
    </angle>
  </joint_angles>
</root>
)";
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("not found: " + std::string(from));
  return text.replace(at, from.size(), to);
}

std::string framesXml(int rows, int columns, const std::vector<std::string>& frameTexts) {
  std::string out = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<root>\n<sensor name=\"\">\n";
  out += element("num_matrices", "1") + matrixXml(rows, columns) + "</sensor>\n<data>\n";
  out += element("frame_count", std::to_string(frameTexts.size()));
  for (std::size_t i = 0; i < frameTexts.size(); ++i)
    out += "<frame index=\"" + std::to_string(i) + "\">" +
           element("time_stamp", std::to_string(1'400'000'000'000 + 32 * i)) +
           element("frame_data", frameTexts[i]) + "</frame>\n";
  return out + "</data>\n</root>\n";
}

float longXmlValue(std::size_t frame, std::size_t place, std::uint32_t seed) {
  std::size_t inMatrix = place;
  for (const int rows : kSdh2Rows) {
    const std::string mask = sdh2Mask(rows);
    if (inMatrix < mask.size()) {
      if (mask[inMatrix] == '0') return 0.0F;
      break;
    }
    inMatrix -= mask.size();
  }
  const auto key = static_cast<std::uint32_t>(frame * kSdh2Places + place);
  return static_cast<float>(1 + scrambled(key ^ seed) % 3000);
}

std::string longXml(std::size_t numFrames, std::size_t numAngles, std::uint32_t seed) {
  std::string out = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<root>\n<sensor name=\"\">\n";
  out += element("generated_by", "105") + element("serial_nr", "0000ABCD") +
         element("num_matrices", "6");
  for (const int rows : kSdh2Rows) out += matrixXml(rows, 6, sdh2Mask(rows));
  out += "</sensor>\n<data>\n" + element("frame_count", std::to_string(numFrames));
  for (std::size_t frame = 0; frame < numFrames; ++frame) {
    std::string text;
    for (std::size_t place = 0; place < kSdh2Places; ++place) {
      const float value = longXmlValue(frame, place, seed);
      std::uint32_t bits = 0;
      static_assert(sizeof bits == sizeof value);
      std::memcpy(&bits, &value, sizeof bits);
      text += hex(bits);
    }
    out += "<frame index=\"" + std::to_string(frame) + "\">\n" +
           element("time_stamp", std::to_string(1'400'000'000'000 + 32 * frame)) +
           element("frame_data", text) + "</frame>\n";
  }
  out += "</data>\n<joint_angles>\n" + element("angle_count", std::to_string(numAngles));
  for (std::size_t i = 0; i < numAngles; ++i)
    out += "<angle index=\"" + std::to_string(i) + "\">\n" +
           element("time_stamp", std::to_string(1'400'000'000'000 + 6 * i)) +
           element("angle_data", std::to_string(i % 90) + ".5, 0, 0, 0, 0, 0, 0") + "</angle>\n";
  return out + "</joint_angles>\n</root>\n";
}

std::string compressed(std::string_view text, int level) {
  std::string out;
  Compressor(level).run(text, BZ_FINISH, [&](std::string_view bytes) { out += bytes; });
  return out;
}

std::string decompressed(std::string_view bytes) {
  std::string out(1u << 20, '\0');
  for (;;) {
    auto size = static_cast<unsigned>(out.size());
    const int result = BZ2_bzBuffToBuffDecompress(out.data(),
                                                  &size,
                                                  const_cast<char*>(bytes.data()),
                                                  static_cast<unsigned>(bytes.size()),
                                                  0,
                                                  0);
    if (result == BZ_OK) {
      out.resize(size);
      return out;
    }
    if (result != BZ_OUTBUFF_FULL) throw std::runtime_error("not bzip2");
    out.resize(out.size() * 4);
  }
}

void writeBomb(const std::filesystem::path& path,
               std::string_view begin,
               std::string_view piece,
               std::size_t count) {
  std::ofstream file(path, std::ios::binary);
  Compressor compressor(9);
  const auto sink = [&](std::string_view bytes) {
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  };
  if (!begin.empty()) compressor.run(begin, BZ_RUN, sink);
  for (std::size_t i = 0; i < count; ++i) compressor.run(piece, BZ_RUN, sink);
  compressor.run({}, BZ_FINISH, sink);
}

}  // namespace palpate::testing
