// The page that `palpate demo` leaves: what was done, in plain words, with its figures and
// pictures; one HTML file that needs no other.
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

struct DemoStep {
  std::string name;     // "slip"
  std::string what;     // what it did, a sentence
  std::string outcome;  // "ok", "skipped", "failed"
  std::string figure;
};

// A thing that a hand held.
struct DemoThing {
  std::string object;
  std::optional<DemoGrip> grip;  // as the emulator knows it
  std::string picturePng;        // the bytes; empty: none was drawn
};

struct DemoFile {
  std::string name;  // in the folder of the tour
  std::string what;
  std::uintmax_t bytes = 0;
};

struct DemoFacts {
  std::string version;
  std::string madeAt;  // UTC
  std::vector<DemoStep> steps;
  std::vector<DemoThing> things;  // in the order of recognition->grasps, where that is known
  std::optional<DemoRecognition> recognition;
  std::optional<DemoSlip> slip;
  double pitchMm = 0.0;            // of a taxel
  std::string slipPng, windowPng;  // the bytes; empty: none was drawn
  std::vector<DemoFile> files;
};

// Every text of the facts is escaped.
std::string demoPage(const DemoFacts& facts);

}  // namespace palpate::commands
