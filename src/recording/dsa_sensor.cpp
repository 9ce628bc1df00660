#include "recording/dsa_sensor.h"

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/model/hand_file.h"

namespace palpate {
namespace {

constexpr int kMaxSide = 256;           // taxels along a side of a matrix
constexpr double kMaxPitchMm = 1000.0;  // [mm]

std::string withoutBlanks(std::string_view text) {
  std::string out;
  for (const char c : text)
    if (c != ' ' && c != '\t' && c != '\r' && c != '\n') out += c;
  return out;
}

int parseSide(std::string_view text, const std::string& where) {
  const auto side = parseInteger(text);
  if (!side || *side < 1 || *side > kMaxSide)
    throw Error(where + " must be 1 to " + std::to_string(kMaxSide) + ", is " + inQuotes(text));
  return static_cast<int>(*side);
}

double parsePitch(std::string_view text, const std::string& where) {
  const auto pitch = parseDouble(text);
  if (!pitch || !(*pitch > 0.0) || *pitch > kMaxPitchMm)
    throw Error(where + " must be above 0 and at most " + numberText(kMaxPitchMm) + " mm, is " +
                inQuotes(text));
  return *pitch;
}

template <typename Value>
void setOnce(std::optional<Value>& place, Value value, const std::string& where) {
  if (place) throw Error(where + " is given twice");
  place = std::move(value);
}

}  // namespace

bool isSensorId(std::string_view text) noexcept {
  constexpr std::size_t kMaxDigits = 32;
  return !text.empty() && text.size() <= kMaxDigits &&
         text.find_first_not_of("0123456789ABCDEF") == std::string_view::npos;
}

void DsaSensor::beginMatrix() {
  if (matrices_.size() == maxMatrices_)
    throw Error("more than " + std::to_string(maxMatrices_) + " matrices");
  open_ = {};
}

void DsaSensor::set(SensorField field, std::string_view text) {
  switch (field) {
    case SensorField::kFirmware:
      firmware_ = withoutBlanks(text);
      break;
    case SensorField::kSerial:
      serial_ = withoutBlanks(text);
      break;
    case SensorField::kNumMatrices:
      if (const auto number = parseInteger(text))
        setOnce(numMatrices_, *number, "num_matrices");
      else
        throw Error("num_matrices isn't a whole number: " + inQuotes(text));
      break;
    case SensorField::kColumns:
      setOnce(open_.columns, parseSide(text, here() + ": cells_x"), here() + ": cells_x");
      break;
    case SensorField::kRows:
      setOnce(open_.rows, parseSide(text, here() + ": cells_y"), here() + ": cells_y");
      break;
    case SensorField::kPitchX:
      setOnce(open_.pitchX, parsePitch(text, here() + ": texel_width"), here() + ": texel_width");
      break;
    case SensorField::kPitchY:
      setOnce(open_.pitchY, parsePitch(text, here() + ": texel_height"), here() + ": texel_height");
      break;
    case SensorField::kStaticMask:
      setOnce(open_.staticMask, std::string(text), here() + ": static_mask");
      break;
    case SensorField::kDynamicMask:
      setOnce(open_.dynamicMask, std::string(text), here() + ": dynamic_mask");
      break;
    case SensorField::kUniqueId:
      if (isSensorId(text)) open_.uniqueId = text;  // else it says that there is none
      break;
  }
}

void DsaSensor::endMatrix() {
  if (!open_.columns) throw Error(here() + " has no cells_x");
  if (!open_.rows) throw Error(here() + " has no cells_y");
  const std::size_t places =
      static_cast<std::size_t>(*open_.rows) * static_cast<std::size_t>(*open_.columns);
  if (places > maxPlaces_ - numPlaces_)
    throw Error("the matrices have more than " + std::to_string(maxPlaces_) +
                " places for taxels together");
  numPlaces_ += places;
  MatrixLayout layout;
  layout.rows = *open_.rows;
  layout.columns = *open_.columns;
  layout.pitchMm = pitchMm(open_);
  layout.staticMask = mask(open_.staticMask, "static_mask", places);
  layout.dynamicMask = mask(open_.dynamicMask, "dynamic_mask", places);
  layout.uniqueId = open_.uniqueId;
  matrices_.push_back(std::move(layout));
}

TaxelPitch DsaSensor::pitchMm(const OpenMatrix& matrix) {
  if (matrix.pitchX && matrix.pitchY) return {*matrix.pitchX, *matrix.pitchY};
  if (matrix.pitchX) return *matrix.pitchX;
  if (matrix.pitchY) return *matrix.pitchY;
  const TaxelPitch& assumed = defaultHand().layout->matrix(0).pitchMm;
  warnings_.push_back(here() + ": no texel_width, " + pitchText(assumed) + " assumed");
  return assumed;
}

Mask DsaSensor::mask(const std::optional<std::string>& text, const char* name, std::size_t places) {
  if (!text) {
    warnings_.push_back(here() + ": no " + name + ", all taxels taken as on");
    return Mask(places, 1);
  }
  if (text->size() != places)
    throw Error(here() + ": " + name + " has " + std::to_string(text->size()) + " characters for " +
                std::to_string(places) + " taxels");
  Mask mask;
  mask.reserve(places);
  for (const char c : *text) {
    if (c != '0' && c != '1')
      throw Error(here() + ": " + name + " holds another character than 0 and 1");
    mask.push_back(c == '1' ? 1 : 0);
  }
  return mask;
}

SensorLayout DsaSensor::finish() {
  if (matrices_.empty()) throw Error("the sensor has no matrix");
  if (!numMatrices_)
    warnings_.push_back("num_matrices is missing; found " + std::to_string(matrices_.size()));
  else if (*numMatrices_ != static_cast<std::int64_t>(matrices_.size()))
    throw Error("num_matrices says " + std::to_string(*numMatrices_) + ", but there are " +
                std::to_string(matrices_.size()) + " matrices");
  return SensorLayout(matrices_);
}

}  // namespace palpate
