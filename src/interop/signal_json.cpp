#include "palpate/interop/signal_json.h"

#include "palpate/calibration/pressure_map.h"
#include "palpate/core/time.h"
#include "palpate/slip/slip_state.h"

#include "interop/json_line.h"

namespace palpate {
namespace {

// The name of a column as a key. It has no control characters.
std::string escaped(const std::string& name) {
  std::string key;
  for (const char letter : name) {
    if (letter == '"' || letter == '\\') key += '\\';
    key += letter;
  }
  return key;
}

void addSignals(JsonLine& json, const CharacteristicSignals& signals, bool withComponents) {
  json.number("mean", signals.mean);
  json.number("filtered_mean", signals.filteredMean);
  json.number("min", signals.minimum);
  json.number("max", signals.maximum);
  json.number("sum", signals.sum);
  json.integer("active", signals.active);
  json.number("area_mm2", signals.areaMm2);
  for (const SignalKind kind : signalKinds(withComponents).subspan(kAllSignalKinds.size()))
    json.number(signalName(kind), valueOf(signals, kind));
}

void addSlip(JsonLine& json, const SlipDetection& slip) {
  json.begin("slip");
  json.word("state", nameOf(slip.state));
  json.flag("slipping", slip.slipping);
  if (slip.indicator == SlipIndicator::kReady || slip.indicator == SlipIndicator::kSlipping)
    json.number("confidence", slip.confidence);
  if (slip.motion.valid) {
    json.number("dx", slip.motion.dx);
    json.number("dy", slip.motion.dy);
  }
  if (slip.motion.refValid) {
    json.number("ref_dx", slip.motion.refDx);
    json.number("ref_dy", slip.motion.refDy);
  }
  const SlipRotation& rotation = slip.motion.rotation;
  if (rotation.valid) json.number("rotation_deg", rotation.rotationDeg);
  if (rotation.refValid) json.number("ref_rotation_deg", rotation.refRotationDeg);
  if (slip.pMoved) json.number("p_moved", *slip.pMoved);
  json.end();
}

void addMatrix(JsonLine& json, const LiveResults& results, std::size_t matrix) {
  json.begin("m" + std::to_string(matrix));
  addSignals(json, results.matrixSignals[matrix], !results.frame->readings.empty());
  if (results.pressure && matrix < results.pressure->matrices.size()) {
    const MatrixPressure& pressure = results.pressure->matrices[matrix];
    json.number("pressure_kpa", pressure.kpa);
    if (results.pressure->areaKnown) {
      json.number("force_n", pressure.forceN);
      json.number("force_sd_n", pressure.sdForceN);
    }
    json.flag("in_range", pressure.inRange);
  }
  if (matrix < results.slip.size()) addSlip(json, results.slip[matrix]);
  json.end();
}

void addLink(JsonLine& json, const LinkHealth& link) {
  json.begin("link");
  json.number("rate_hz", link.frames.rateHz);
  if (link.frames.ageMs) json.number("age_ms", *link.frames.ageMs);
  json.integer("lost", static_cast<std::int64_t>(link.lost));
  json.integer("bad_checksums", static_cast<std::int64_t>(link.badChecksums));
  json.integer("saturated_frames", static_cast<std::int64_t>(link.frames.saturatedFrames));
  json.integer("queue", static_cast<std::int64_t>(link.queues.tactile.depth));
  if (link.diskHours) json.number("disk_h", *link.diskHours);
  json.flag("recording", link.recorder.state == RecorderStatus::State::kRecording);
  json.integer("recorded_frames", link.recorder.frames);
  json.integer("frames_on_disk", link.recorder.framesOnDisk);
  json.integer("alarms", static_cast<std::int64_t>(link.alarms.size()));
  json.end();
}

}  // namespace

void appendSignalJson(std::string& out,
                      const LiveResults& results,
                      std::uint64_t sequence,
                      const LinkHealth* link,
                      std::vector<JsonMember>* members) {
  JsonLine json(out, members);
  json.number("t", static_cast<double>(results.frame->hostUs) / kUsPerS);
  json.integer("sequence", static_cast<std::int64_t>(sequence));
  if (results.frame->deviceUs) json.integer("device_ms", floorMs(*results.frame->deviceUs));
  for (std::size_t m = 0; m < results.matrixSignals.size(); ++m) addMatrix(json, results, m);
  if (!results.matrixSignals.empty()) {
    json.begin("whole");
    addSignals(json, results.wholeSignals, false);
    if (results.pressure && results.pressure->areaKnown)
      json.number("force_n", results.pressure->forceN);
    json.end();
    json.begin("peak");
    json.integer("matrix", static_cast<std::int64_t>(results.peak.matrix));
    json.integer("y", results.peak.row);
    json.integer("x", results.peak.column);
    json.number("value", static_cast<double>(results.peak.counts));
    json.number("counts", static_cast<double>(results.peak.counts));  // its older name
    json.end();
  }
  if (results.angles) json.numbers("angles_deg", results.angles->values);
  if (results.temperatures) json.numbers("temperatures_degc", results.temperatures->values);
  if (!results.further.empty()) {
    json.begin("series");
    for (const FurtherSample& each : results.further) {
      json.begin(each.series->name);
      for (std::size_t i = 0; i < each.sample.values.size(); ++i)
        json.number(escaped(each.series->columns[i].name), each.sample.values[i]);
      json.end();
    }
    json.end();
  }
  if (link) addLink(json, *link);
  json.end();
}

}  // namespace palpate
