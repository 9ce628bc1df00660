// What train, evaluate, adapt and classify share: gathering features with progress and Ctrl-C,
// saying what went wrong.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "palpate/core/json.h"
#include "palpate/core/progress.h"
#include "palpate/recognition/classifier_pipeline.h"
#include "palpate/recognition/empty_hand.h"
#include "palpate/recognition/feature_table.h"
#include "palpate/recognition/model_evaluation.h"
#include "palpate/recognition/sample_set.h"
#include "palpate/recognition/trained_model.h"

#include "commands/command_line.h"
#include "commands/commands.h"

namespace palpate::commands {

// One line on standard error.
void sayLine(const std::string& message);

// Runs `work` with a progress line; Ctrl-C cancels it (Cancelled).
void runInterruptibly(const CommandLine& given,
                      const std::string& label,
                      const std::function<void(const Progress&)>& work);

// The features of recordings; says what troubles there were. Throws Error when no grasp is found.
FeatureTable extractFeatureTable(const CommandLine& given,
                                 const std::vector<std::filesystem::path>& paths,
                                 FeatureSet set);
// --empty-hand-zero: the zero of a recording in which the empty hand closes until its pads touch;
// nothing: not asked for. Throws Error: there is no touch in it.
std::optional<EmptyHandZero> zeroGiven(const CommandLine& given);
OptionSpec zeroOptionSpec();
// Throws Error: it was taken more than half a day from all of these grasps, and says nothing of
// them.
void requireSameDay(const EmptyHandZero& zero, const FeatureTable& table);
// What the offset is, {mm, sd_mm, origin, grasps, objects, trusted}; `today`: the zero it rests on,
// where it does.
Json offsetJson(const SessionOffset& offset, const std::optional<EmptyHandZero>& today = {});
// Says sessionSetWarning() and what learningNotes() has.
void sayNotes(const CommandLine& given, FeatureSet set, const SampleSet& samples);

// --classifier, --lda, --c, --shrinkage; what isn't given is left as it is in `options`. Throws
// UsageError.
void takePipelineOptions(const CommandLine& given, PipelineOptions& options);
std::vector<OptionSpec> pipelineOptionSpecs();

// kPartlyDone where something was left out, else kDone.
int codeFor(const FeatureTable& table);
// To standard output.
void printObject(const Json& json);

}  // namespace palpate::commands
