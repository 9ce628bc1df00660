#include "commands/demo_truth.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/recognition/model_evaluation.h"

namespace palpate::commands {
namespace {

constexpr double kMinWayTaxels = 1.0;
// The motion begins after this way, and ends when no more than this is left.
constexpr double kMovedTaxels = 0.1;
// Largest delay between a scan and the stamp of its received frame, from transmission: two frames.
constexpr std::int64_t kLineUs = 70 * kUsPerMs;

double wayTaxels(const MatrixTruth& from, const MatrixTruth& to) {
  return std::hypot(to.slipXTaxels - from.slipXTaxels, to.slipYTaxels - from.slipYTaxels);
}

bool isBefore(const DemoTruthFrame& frame, double handS) { return frame.handS < handS; }

// The matrix of those that hold the object in both frames where it moved furthest, and that way
// [taxels]; no way when fewer than two matrices hold it in the first one.
std::pair<std::size_t, double> furthestWay(const DemoTruthFrame& first,
                                           const DemoTruthFrame& last) {
  std::size_t holding = 0;
  std::pair<std::size_t, double> furthest;
  for (std::size_t m = 0; m < first.matrices.size(); ++m) {
    const MatrixTruth &from = first.matrices[m], &to = last.matrices[m];
    holding += from.contact ? 1 : 0;
    if (from.contact && to.contact && wayTaxels(from, to) > furthest.second)
      furthest = {m, wayTaxels(from, to)};
  }
  if (holding < 2) furthest.second = 0.0;
  return furthest;
}

// What a model says of one recording; `taught`: whether the object was in the training data.
struct Answer {
  bool taught = false, right = false, sure = false;
  std::string text;
  Json json;
};

Answer answerAbout(const KnownGrasp& known,
                   const TrainedModel& model,
                   const FeatureTable& table,
                   const std::vector<Prediction>& predictions) {
  const FeatureRow* longest = nullptr;
  for (const FeatureRow& row : table.rows)
    if (row.file == known.file && (!longest || row.end - row.begin > longest->end - longest->begin))
      longest = &row;
  const auto taught = std::find(model.classes.begin(), model.classes.end(), known.object);
  Answer answer;
  answer.taught = taught != model.classes.end();
  answer.text = known.object;
  Json rank, probability;
  if (longest) {
    const Prediction& prediction =
        predictions[static_cast<std::size_t>(longest - table.rows.data())];
    FeatureRow row = *longest;
    row.file = known.file.filename();
    answer.json = predictionJson(model, row, prediction);
    const int label =
        answer.taught ? static_cast<int>(taught - model.classes.begin()) : Prediction::kUnknown;
    answer.right = prediction.label == label;
    answer.sure = prediction.sure;
    if (!answer.right) answer.text += " is called " + labelOf(model, prediction.label);
    if (answer.taught) {
      const auto at = std::find(prediction.ranking.begin(), prediction.ranking.end(), label);
      const auto k = static_cast<std::size_t>(at - prediction.ranking.begin());
      rank = k + 1;
      probability = prediction.p.at(k);
      if (!answer.right)
        answer.text += "; its own name is at rank " + std::to_string(k + 1) + " with probability";
      answer.text += " " + fixedText(prediction.p[k], 2);
    } else {
      answer.text += answer.right ? ", which was not trained, is called unknown"
                                  : " (" + fixedText(prediction.confidence, 2) + ")";
    }
  } else {
    answer.text += " could not be asked about: no grasp was found in its recording";
    answer.json.set("file", known.file.filename().string())
        .set("label", Json())
        .set("trouble", "no grasp was found");
  }
  answer.json.set("object", known.object)
      .set("taught", answer.taught)
      .set("rank", rank)
      .set("probability", probability)
      .set("right", answer.right);
  return answer;
}

}  // namespace

DemoFinding compareSlip(const SlipSeries& series,
                        const SensorLayout& layout,
                        const std::vector<DemoTruthFrame>& truth,
                        double fromS,
                        double untilS) {
  const auto first = std::lower_bound(truth.begin(), truth.end(), fromS, isBefore);
  const auto end = std::lower_bound(first, truth.end(), untilS, isBefore);
  const Error still("the pen did not slip through the fingers");
  if (first == end) throw still;
  const auto [matrix, moved] = furthestWay(*first, *std::prev(end));
  if (moved < kMinWayTaxels) throw still;
  const auto wayAt = [&, m = matrix](const DemoTruthFrame& frame) {
    return wayTaxels(first->matrices[m], frame.matrices[m]);
  };
  const auto timeOfWay = [&](double taxels) {
    return std::find_if(first, end, [&](const auto& frame) { return wayAt(frame) >= taxels; })
        ->hostUs;
  };
  const std::int64_t beganUs = timeOfWay(kMovedTaxels), endedUs = timeOfWay(moved - kMovedTaxels);
  const SlipSegment* seen = nullptr;
  std::size_t early = 0;
  for (const SlipSegment& slip : series.slips) {  // ordered by their begin
    if (slip.beginUs > endedUs + kLineUs || slip.endUs < first->hostUs) continue;
    if (slip.endUs < beganUs)
      ++early;
    else if (!seen)
      seen = &slip;
  }
  const MatrixTruth &from = first->matrices[matrix], &to = std::prev(end)->matrices[matrix];
  const double movedMm = layout.matrix(matrix).pitchMm.lengthMm(to.slipXTaxels - from.slipXTaxels,
                                                                to.slipYTaxels - from.slipYTaxels);
  DemoFinding found;
  found.json
      .set("truth",
           Json::object()
               .set("matrix", matrix)
               .set("moved_taxels", moved)
               .set("moved_mm", movedMm)
               .set("began_ms", beganUs / kUsPerMs)
               .set("ended_ms", endedUs / kUsPerMs))
      .set("seen", seen != nullptr)
      .set("false_alarms_before", early);
  found.text = "a pen was pulled " + fixedText(moved, 1) + " taxels (" + fixedText(movedMm, 1) +
               " mm) through the fingers";
  if (seen) {
    const auto behind = std::find_if(
        first, truth.end(), [&](const auto& frame) { return frame.hostUs > seen->beginUs; });
    const double gone = behind == first ? 0.0 : wayAt(*std::prev(behind));
    double imprint = 0.0;
    for (const SlipSample& sample : series.between(seen->matrix, seen->begin, seen->end))
      if (sample.refValid) imprint = std::max(imprint, sample.shiftTaxels());
    const SlipSample* raised = series.at(seen->matrix, seen->begin);
    const std::string lamp(nameOf(raised ? raised->indicator : SlipIndicator::kOff));
    found.json.set("alarm",
                   Json::object()
                       .set("matrix", seen->matrix)
                       .set("frame", seen->begin)
                       .set("after_s", static_cast<double>(seen->beginUs - beganUs) / kUsPerS)
                       .set("moved_taxels", gone)
                       .set("imprint_taxels", imprint)
                       .set("lamp", lamp));
    found.text += "; the alarm of matrix " + std::to_string(seen->matrix) + " said '" + lamp +
                  "' in frame " + std::to_string(seen->begin) + ", when it had gone " +
                  fixedText(gone, 1) + "; by its imprint it went " + fixedText(imprint, 1);
  } else {
    found.text += " and no alarm was raised";
  }
  if (early > 0) found.text += "; " + counted(early, "false alarm") + " before";
  return found;
}

DemoFinding askModel(const TrainedModel& model, const std::vector<KnownGrasp>& grasps) {
  std::vector<std::filesystem::path> files;
  for (const KnownGrasp& known : grasps) files.push_back(known.file);
  const FeatureTable table = extractFeatures(files, {.set = model.set});
  Classification said;
  if (!table.rows.empty()) said = classifyTable(model, table, {OffsetChoice::Kind::kGiven, 0.0});
  std::size_t taught = 0, right = 0;
  bool allSure = true;
  std::string named, other;
  Json answers = Json::array();
  for (const KnownGrasp& known : grasps) {
    Answer answer = answerAbout(known, model, table, said.predictions);
    taught += answer.taught ? 1 : 0;
    if (answer.taught && answer.right) {
      ++right;
      named += (named.empty() ? " (" : ", ") + answer.text;
      allSure = allSure && answer.sure;
    } else {
      other += (answer.right ? "; the " : "; wrong: the ") + answer.text;
    }
    answers.push(std::move(answer.json));
  }
  std::string text =
      std::to_string(right) + " of " + std::to_string(taught) + " objects named rightly";
  if (right > 0) text += named + ")" + (allSure ? ", all surely" : ", not all surely");
  return {text + other,
          Json::object()
              .set("taught", taught)
              .set("right", right)
              .set("grasps", std::move(answers))
              .set("warnings", jsonList(said.use.warnings))};
}

}  // namespace palpate::commands
