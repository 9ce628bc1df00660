#include "palpate/recording/dsa_writer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <bzlib.h>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/progress.h"
#include "palpate/core/time.h"
#include "palpate/model/hand_file.h"
#include "palpate/recording/frame_text.h"

namespace palpate {
namespace {

constexpr std::size_t kTokensPerLine = 7;
constexpr float kDsaFullScaleCounts = 4095.0F;        // 12 bits
constexpr std::string_view kDataIndent = "        ";  // of lines within masks and frame_data
constexpr std::string_view kDataLineEnd = "\r\n";
constexpr std::size_t kTextBytes = 256u << 10;  // gathered before they are compressed
constexpr std::size_t kSamplesPerReport = 256;
// What the prior program writes, whatever the hand. Used where the profile doesn't know them.
constexpr std::string_view kDefaultRevision = "105";
constexpr std::string_view kDefaultSerial = "00000000";

// Where the prior program draws the matrices of this controller's hand [mm]; no real geometry.
struct Centre {
  int x;
  int y;
};
constexpr std::array<Centre, 6> kKnownCentres = {
    {{-50, -32}, {-50, 32}, {0, -32}, {0, 32}, {50, -32}, {50, 32}}};

// Compresses text into a file that appears when everything is written.
class Bzip2Output {
 public:
  Bzip2Output(const std::filesystem::path& path, Overwrite overwrite) : file_(path, overwrite) {
    constexpr int kBlockSize100k = 9;
    if (BZ2_bzCompressInit(&z_, kBlockSize100k, 0, 0) != BZ_OK) throw std::bad_alloc();
  }
  ~Bzip2Output() { BZ2_bzCompressEnd(&z_); }
  Bzip2Output(const Bzip2Output&) = delete;
  Bzip2Output& operator=(const Bzip2Output&) = delete;

  void write(std::string& text) {
    z_.next_in = text.data();
    z_.avail_in = static_cast<unsigned>(text.size());
    while (z_.avail_in > 0) step(BZ_RUN);
    text.clear();
  }
  void commit() {
    while (step(BZ_FINISH) != BZ_STREAM_END) {
    }
    file_.commit();
  }

 private:
  int step(int action) {
    z_.next_out = buffer_.data();
    z_.avail_out = static_cast<unsigned>(buffer_.size());
    const int result = BZ2_bzCompress(&z_, action);
    file_.write({buffer_.data(), buffer_.size() - z_.avail_out});
    return result;
  }

  OutputFile file_;
  bz_stream z_{};
  std::vector<char> buffer_ = std::vector<char>(64u << 10);
};

void addLine(std::string& out, std::string_view indent, std::string_view name, std::string_view v) {
  out.append(indent).append("<").append(name).append(">").append(v);
  out.append("</").append(name).append(">\n");
}

void addMask(std::string& out, std::string_view name, const Mask& mask, int columns) {
  out.append("      <").append(name).append(">").append(kDataLineEnd);
  for (std::size_t place = 0; place < mask.size(); ++place) {
    const bool first = place % static_cast<std::size_t>(columns) == 0;
    if (first) out += kDataIndent;
    out += mask[place] ? '1' : '0';
    if ((place + 1) % static_cast<std::size_t>(columns) == 0) out += kDataLineEnd;
  }
  out.append("      </").append(name).append(">\n");
}

// Why the recording cannot be a .dsa, which holds 12 bits of a DSACON32-M; empty when it can.
std::string dsaRefusal(const HandDescription& hand) {
  const char* what = nullptr;
  if (hand.file && hand.file->controller != defaultHand().file->controller)
    what = "has no such controller";
  else if (hand.unit != "counts")
    what = "measures in a unit other than counts";
  else if (hand.maximumCounts > kDsaFullScaleCounts)
    what = "has more than 12 bits";
  if (!what) return {};
  return ".dsa is the format of the " + defaultHand().file->controller + "; '" + hand.name + "' " +
         what + ": use .palpate, CSV or NPZ";
}

void addMatrix(std::string& out, const MatrixLayout& matrix, std::size_t index, Centre centre) {
  constexpr std::string_view kIndent = "      ";
  out += "    <matrix index=\"" + std::to_string(index) + "\" name=\"\">\n";
  addLine(out, kIndent, "cells_x", std::to_string(matrix.columns));
  addLine(out, kIndent, "cells_y", std::to_string(matrix.rows));
  addLine(out, kIndent, "texel_width", numberText(matrix.pitchMm.x));
  addLine(out, kIndent, "texel_height", numberText(matrix.pitchMm.y));
  addLine(out, kIndent, "matrix_center_x", std::to_string(centre.x));
  addLine(out, kIndent, "matrix_center_y", std::to_string(centre.y));
  addLine(out, kIndent, "matrix_center_z", "0");
  addLine(out, kIndent, "theta_x", "0");
  addLine(out, kIndent, "theta_y", "0");
  addLine(out, kIndent, "theta_z", "0");
  addLine(out, kIndent, "output_unit", "mV");
  addLine(out, kIndent, "hw_revision", "1");
  // What the prior program writes where it knows none.
  addLine(out,
          kIndent,
          "one_wire_uid",
          matrix.uniqueId.empty() ? "Not implemented yet" : matrix.uniqueId);
  addLine(out, kIndent, "fullscale", "4095");
  addMask(out, "static_mask", matrix.staticMask, matrix.columns);
  addMask(out, "dynamic_mask", matrix.dynamicMask, matrix.columns);
  out += "    </matrix>\n";
}

// `generated_by`: the prior program reads a whole number there. A controller's firmware ("2.9.0.0")
// is none.
std::string revisionText(const ProfileInfo& info) {
  constexpr std::int64_t kLargest = 65'535;  // the sensor's description holds 16 bits
  for (const std::string& text : {info.sensorRevision, info.firmware})
    if (const auto number = parseInteger(text); number && *number >= 0 && *number <= kLargest)
      return std::to_string(*number);
  return std::string(kDefaultRevision);
}

// `serial_nr`: up to eight hexadecimal digits.
std::string serialText(const ProfileInfo& info) {
  constexpr std::string_view kDigits = "0123456789abcdefABCDEF";
  const std::string& serial = info.serial;
  const bool fits = !serial.empty() && serial.size() <= kDefaultSerial.size() &&
                    serial.find_first_not_of(kDigits) == std::string::npos;
  return fits ? serial : std::string(kDefaultSerial);
}

std::string headerText(const Profile& profile) {
  constexpr std::string_view kIndent = "    ";
  const ProfileInfo& info = profile.info();
  const SensorLayout& layout = profile.layout();
  std::string out = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<root>\n  <sensor name=\"\">\n";
  addLine(out, kIndent, "generated_by", revisionText(info));
  addLine(out, kIndent, "hw_revision", "1");
  addLine(out, kIndent, "serial_nr", serialText(info));
  addLine(out, kIndent, "num_matrices", std::to_string(layout.numMatrices()));
  addLine(out, kIndent, "converter_resolution", "12");
  const bool known = sameSizes(layout, *defaultHand().layout);
  for (std::size_t i = 0; i < layout.numMatrices(); ++i)
    addMatrix(out, layout.matrix(i), i, known ? kKnownCentres[i] : Centre{0, 0});
  out += "  </sensor>\n";
  return out;
}

// As printf's "%.*f": unlike fixedText() it keeps the sign of a value that rounds to zero, as the
// prior program does.
void addFixed(std::string& out, double value, int decimals) {
  char text[400];  // 309 digits before the point
  out.append(
      text, std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals).ptr);
}

void addNumbers(std::string& out, const std::vector<double>& values, int decimals) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) out += ", ";
    addFixed(out, values[i], decimals);
  }
}

class Writer {
 public:
  Writer(const Profile& profile, Bzip2Output& output, const Progress& progress)
      : profile_(profile), output_(output), progress_(progress) {
    all_ = profile.numFrames() + profile.numAngles() + profile.numTemperatures();
  }

  void write() {
    text_ = headerText(profile_);
    writeFrames();
    writeTemperatures();
    writeAngles();
    text_ += "</root>\n";
    output_.write(text_);
  }
  const DsaWriteReport& report() const noexcept { return report_; }

 private:
  void writeFrames() {
    lastMs_.reset();
    text_ += "  <data>\n";
    addLine(text_, "    ", "frame_count", std::to_string(profile_.numFrames()));
    TactileFrame frame;
    for (std::size_t i = 0; i < profile_.numFrames(); ++i) {
      beginSample("frame", i, profile_.frameTimeUs(i));
      profile_.readFrame(i, frame);
      text_.append("      <frame_data>").append(kDataLineEnd);
      appendFrameText(frame.values, kTokensPerLine, kDataIndent, kDataLineEnd, text_);
      text_ += "      </frame_data>\n";
      endSample("frame");
    }
    text_ += "  </data>\n";
  }
  void writeTemperatures() {
    lastMs_.reset();
    text_ += "  <temperatures>\n";
    addLine(text_, "    ", "temp_count", std::to_string(profile_.numTemperatures()));
    for (std::size_t i = 0; i < profile_.numTemperatures(); ++i) {
      beginSample("temp", i, profile_.temperatureTimeUs(i));
      text_ += "      <temp_data>";
      addNumbers(text_, profile_.temperatures(i).values, 2);
      text_ += "</temp_data>\n";
      endSample("temp");
    }
    text_ += "  </temperatures>\n";
  }
  void writeAngles() {
    lastMs_.reset();
    text_ += "  <joint_angles>\n";
    addLine(text_, "    ", "angle_count", std::to_string(profile_.numAngles()));
    for (std::size_t i = 0; i < profile_.numAngles(); ++i) {
      beginSample("angle", i, profile_.angleTimeUs(i));
      text_ += "      <angle_data>";
      addNumbers(text_, profile_.angles(i).values, 5);
      text_ += "</angle_data>\n";
      endSample("angle");
    }
    text_ += "  </joint_angles>\n";
  }

  void beginSample(std::string_view name, std::size_t index, std::int64_t hostUs) {
    reportProgress(progress_, done_++, all_, kSamplesPerReport);
    text_.append("    <").append(name).append(" index=\"");
    text_.append(std::to_string(index)).append("\">\n");
    std::int64_t ms = floorMs(hostUs);
    if (lastMs_ && ms <= *lastMs_) {
      ms = *lastMs_ + 1;
      ++report_.movedStamps;
    }
    lastMs_ = ms;
    addLine(text_, "      ", "time_stamp", std::to_string(ms));
  }
  void endSample(std::string_view name) {
    text_.append("    </").append(name).append(">\n");
    if (text_.size() >= kTextBytes) output_.write(text_);
  }

  const Profile& profile_;
  Bzip2Output& output_;
  const Progress& progress_;
  std::string text_;
  std::optional<std::int64_t> lastMs_;  // of the stream that is being written
  DsaWriteReport report_;
  std::size_t done_ = 0;
  std::size_t all_ = 0;
};

// A negative value would be read as a run of zeros: better no file than a wrong one.
void dsaWriterRequireStorable(const Profile& profile, const std::filesystem::path& path) {
  if (const std::string why = dsaRefusal(profile.hand()); !why.empty())
    throw FileError(path, "can't be written: " + why);
  if (profile.info().valueType == ValueType::kCounts) return;
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    profile.readFrame(i, frame);
    const auto wrong =
        std::find_if(frame.values.begin(), frame.values.end(), [](float v) { return v < 0.0F; });
    if (wrong != frame.values.end())
      throw FileError(path,
                      "can't be written: a .dsa recording has no negative values, but frame " +
                          std::to_string(i) + " holds " + numberText(*wrong) +
                          "; choose another format, such as .csv");
  }
}

}  // namespace

DsaWriteReport writeDsa(const Profile& profile,
                        const std::filesystem::path& path,
                        Overwrite overwrite,
                        const Progress& progress) {
  dsaWriterRequireStorable(profile, path);
  Bzip2Output output(path, overwrite);
  Writer writer(profile, output, progress);
  writer.write();
  output.commit();
  return writer.report();
}

}  // namespace palpate
