// The report of `palpate demo`: one self-contained HTML page that describes what was done, with
// results and pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "palpate/core/json.h"

#include "commands/demo_hand.h"
#include "commands/demo_recognition.h"
#include "commands/demo_truth.h"

namespace palpate::commands {

// A step of the demo with its result.
struct DemoStep {
  // A short name: "slip".
  std::string name;
  // What the step did, in one sentence.
  std::string what;
  // "ok", "skipped" or "failed".
  std::string outcome;
  std::string figure;
};

// An object that a hand held.
struct DemoThing {
  std::string object;
  // The grip as the emulator knows it.
  std::optional<DemoGrip> grip;
  // Content of a PNG file; empty when there is no picture.
  std::string picturePng;
};

// A file that the demo wrote.
struct DemoFile {
  // File name in the folder of the demo.
  std::string name;
  std::string what;
  std::uintmax_t bytes = 0;
};

// Everything that the page shows.
struct DemoFacts {
  std::string version;
  // Date and time in UTC.
  std::string madeAt;
  std::vector<DemoStep> steps;
  // In the order of recognition->grasps, if that exists.
  std::vector<DemoThing> things;
  std::optional<DemoRecognition> recognition;
  std::optional<DemoSlip> slip;
  // Pitch of the taxels.
  double pitchMm = 0.0;
  // Contents of PNG files; empty when there is no picture.
  std::string slipPng, windowPng;
  std::vector<DemoFile> files;
};

// Returns the page as HTML; all texts of the facts are escaped.
std::string demoPage(const DemoFacts& facts);

}  // namespace palpate::commands
