// Compares what `palpate demo` finds in its recordings with what is true: whether and when the slip
// detector noticed that a pen slips, as the emulator knows its motion, and which objects a model
// names in recordings of known objects.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "palpate/core/json.h"
#include "palpate/emulator/hand_model.h"
#include "palpate/recognition/trained_model.h"
#include "palpate/slip/slip_series.h"

namespace palpate::commands {

// The true values of one scan.
struct DemoTruthFrame {
  std::int64_t hostUs = 0;  // [us since 1970]
  double handS = 0.0;       // [s] since the hand was switched on
  std::vector<MatrixTruth> matrices;
};

// A result compared with the truth: one line of text, and its part of report.json.
struct DemoFinding {
  std::string text;
  Json json;
};

// Compares the motion of an object between two times of the hand [s], on the matrix where it moved
// furthest, with the first alarm that overlaps it (`seen`: there is one). At `fromS` the object was
// held and at rest; an alarm between then and the motion is a false one. Throws Error when the
// object moved less than a taxel, or when fewer than two matrices held it at `fromS`.
DemoFinding compareSlip(const SlipSeries& series,
                        const SensorLayout& layout,
                        const std::vector<DemoTruthFrame>& truth,
                        double fromS,
                        double untilS);

// A recording of one grasp of a known object.
struct KnownGrasp {
  std::filesystem::path file;
  // The common name: "foam ball".
  std::string object;
};

// Asks a model about the longest grasp of each recording. JSON: `grasps` as `palpate classify
// --json`, and of each `object`, `taught` (in the training data), `rank` and `probability` of the
// true object, and `right`; an object that was not in the training data is named rightly as
// "unknown". Treats the grasps as one session of a hand whose joints were not referenced again:
// session offset 0. Throws Error for a missing recording.
DemoFinding askModel(const TrainedModel& model, const std::vector<KnownGrasp>& grasps);

}  // namespace palpate::commands
