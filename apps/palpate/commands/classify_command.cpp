// The command `palpate classify MODEL.json FILE...` names the grasped objects.
#include <algorithm>
#include <filesystem>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/recognition/model_evaluation.h"
#include "palpate/recognition/trained_model.h"

#include "commands/recognition_work.h"

namespace palpate::commands {
namespace {

void printTable(const TrainedModel& model,
                const FeatureTable& table,
                const std::vector<Prediction>& predictions,
                const SessionContext& use) {
  StandardOutput out;
  for (std::size_t i = 0; i < predictions.size(); ++i) {
    const FeatureRow& row = table.rows[i];
    const Prediction& prediction = predictions[i];
    std::string line = row.file.string() + " " + std::to_string(row.begin) + "-" +
                       std::to_string(row.end) + ": " + labelOf(model, prediction.label) +
                       (prediction.sure ? " (sure)" : "") + ";";
    for (std::size_t k = 0; k < std::min<std::size_t>(3, prediction.ranking.size()); ++k)
      line += (k == 0 ? " " : ", ") + labelOf(model, prediction.ranking[k]) + " " +
              fixedText(prediction.p[k], 2);
    out.write(line + "\n");
  }
  if (model.adaptsToSession()) {
    const bool byZero = use.offset.origin == OffsetSource::kEmptyHand && model.sessionZero;
    out.write(use.offset.text() +
              (byZero ? "; zero of the empty hand: " + model.sessionZero->text() : std::string()) +
              "\n");
  }
  out.finish();
}

}  // namespace

int classifyCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis =
           "palpate classify MODEL.json FILE... [--json] [--session-offset model|none|batch|MM]",
       .purpose =
           "Says what was grasped: a line per grasp, or with --json an object. FILEs (recordings, "
           "or "
           "folders of them) of\none call are of one session. An answer is called sure when it is "
           "right "
           "95 times in 100: in the session of the\ntraining, or with an offset of the session "
           "that "
           "can be trusted.\n\n  model  what `adapt` stored (default); of a fresh model 0 in the "
           "session of the training, else as none\n  none   nothing is assumed: all offsets are "
           "weighed\n  batch  estimated from all grasps of the "
           "call, unlabelled, and applied; resting on fewer than two different\n         objects "
           "it "
           "warns and nothing is sure\n  MM     so many mm the hand reads too wide",
       .options = {{"json", "", "one JSON object"},
                   {"session-offset", "WHICH", "model (default), none, batch, or mm"}},
       .example = "palpate classify objects.json grasp.dsa --json --session-offset batch",
       .minArguments = 2},
      words);
  if (given.helpShown()) return kDone;
  OffsetChoice choice;
  try {
    if (const auto text = given.text("session-offset")) choice = OffsetChoice::from(*text);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--session-offset: ") + error.what());
  }
  const TrainedModel model = loadModel(given.words().front());
  const FeatureTable table =
      extractFeatureTable(given, {given.words().begin() + 1, given.words().end()}, model.set);
  const auto [use, predictions] = classifyTable(model, table, choice);
  for (const std::string& warning : use.warnings) sayLine(warning);
  if (!given.has("json")) {
    printTable(model, table, predictions, use);
    return codeFor(table);
  }
  Json grasps = Json::array();
  for (std::size_t i = 0; i < predictions.size(); ++i)
    grasps.push(predictionJson(model, table.rows[i], predictions[i]));
  printObject(Json::object()
                  .set("grasps", std::move(grasps))
                  .set("session_offset",
                       offsetJson(use.offset,
                                  choice.kind == OffsetChoice::Kind::kModel
                                      ? model.sessionZero
                                      : std::optional<EmptyHandZero>()))
                  .set("warnings", jsonList(use.warnings)));
  return codeFor(table);
}

}  // namespace palpate::commands
