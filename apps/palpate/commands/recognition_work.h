// Functions that the commands train, evaluate, adapt and classify share: computing features with
// progress and Ctrl-C, common options, and messages.
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
#include "commands/table_command.h"

namespace palpate::commands {

// Runs `work` with a progress line; Ctrl-C cancels it (throws Cancelled).
void runInterruptibly(const CommandLine& given,
                      const std::string& label,
                      const std::function<void(const Progress&)>& work);

// Computes the features of recordings and prints problems; `set` empty: that of their hand. Throws
// Error when no grasp is found.
FeatureTable extractFeatureTable(const CommandLine& given,
                                 const std::vector<std::filesystem::path>& paths,
                                 std::optional<FeatureSet> set);
// The option --empty-hand-zero: the zero from a recording in which the empty hand closes until its
// pads touch; nothing when the option is missing. Throws Error when the recording contains no
// touch.
std::optional<EmptyHandZero> zeroGiven(const CommandLine& given);
OptionSpec zeroOptionSpec();
// Throws Error when the zero was measured more than half a day from all of these grasps, so that it
// does not apply to them.
void requireSameSession(const EmptyHandZero& zero, const FeatureTable& table);
// The offset as {mm, sd_mm, origin, grasps, objects, trusted}; with `today` also the zero that it
// is based on.
Json offsetJson(const SessionOffset& offset, const std::optional<EmptyHandZero>& today = {});
// Prints sessionSetWarning() and learningNotes().
void sayNotes(const CommandLine& given, FeatureSet set, const SampleSet& samples);

// The options --classifier, --lda, --c and --shrinkage; missing ones leave `options` unchanged.
// Throws UsageError.
void takePipelineOptions(const CommandLine& given, PipelineOptions& options);
std::vector<OptionSpec> pipelineOptionSpecs();

// kPartlyDone when something was left out, else kDone.
int codeFor(const FeatureTable& table);

}  // namespace palpate::commands
