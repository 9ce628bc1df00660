#include "commands/demo_page.h"

#include <QByteArray>
#include <algorithm>
#include <cmath>

#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/core/xml.h"

namespace palpate::commands {
namespace {

constexpr const char* kDemoPageHead =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
    "<title>Palpate: a tour</title>\n<style>\n"
    "body { font: 16px/1.5 sans-serif; color: #1f2933; background: #fff; max-width: 68rem;"
    " margin: 2rem auto; padding: 0 1rem; }\n"
    "h1 { margin-bottom: 0; } h2 { margin-top: 2.5rem; }\n"
    ".quiet { color: #52606d; }\n"
    "table { border-collapse: collapse; width: 100%; margin: 1rem 0; }\n"
    "th, td { text-align: left; vertical-align: top; padding: .35rem .8rem .35rem 0;"
    " border-bottom: 1px solid #d9e2ec; }\n"
    "td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; }\n"
    ".ok { color: #0b6e4f; font-weight: bold; } .bad { color: #b42318; font-weight: bold; }\n"
    ".skipped { color: #52606d; font-weight: bold; }\n"
    "img { max-width: 100%; height: auto; border: 1px solid #d9e2ec; }\n"
    ".hands { display: grid; grid-template-columns: repeat(auto-fill, minmax(19rem, 1fr));"
    " gap: 1rem; }\n"
    "figure { margin: 0; } figcaption { margin-top: .3rem; }\n"
    "</style>\n</head>\n<body>\n";

std::string pageTagged(const std::string& tag, const std::string& text) {
  return "<" + tag + ">" + xmlEscaped(text) + "</" + tag.substr(0, tag.find(' ')) + ">";
}

std::string pageCell(const std::string& text) { return pageTagged("td", text); }
std::string pageNumberCell(const std::string& text) {
  return pageTagged("td class=\"number\"", text);
}
std::string pageMarkedCell(const std::string& text, const char* mark) {
  return "<td class=\"" + std::string(mark) + "\">" + xmlEscaped(text) + "</td>";
}
std::string pageRow(const std::string& cells) { return "<tr>" + cells + "</tr>\n"; }
// `heads`: cells of the header row.
std::string pageTable(const std::string& heads, const std::string& rows) {
  return "<table>\n" + pageRow(heads) + rows + "</table>\n";
}

std::string pageImage(const std::string& png, const std::string& words) {
  const QByteArray bytes = QByteArray::fromRawData(png.data(), static_cast<qsizetype>(png.size()));
  return "<img alt=\"" + xmlEscaped(words) + "\" src=\"data:image/png;base64," +
         bytes.toBase64().toStdString() + "\"/>";
}

std::string pagePictureOrNothing(const std::string& png, const std::string& words) {
  return png.empty() ? std::string() : "<p>" + pageImage(png, words) + "</p>\n";
}

const char* pageMarkOf(const std::string& outcome) {
  if (outcome == "ok") return "ok";
  return outcome == "failed" ? "bad" : "skipped";
}

std::string pageSteps(const DemoFacts& facts) {
  std::string rows;
  for (const DemoStep& step : facts.steps)
    rows += pageRow(pageCell(step.name) + pageCell(step.what) +
                    pageMarkedCell(step.outcome, pageMarkOf(step.outcome)) + pageCell(step.figure));
  return "<h2>What was done</h2>\n" +
         pageTable("<th>step</th><th>what it does</th><th></th><th>figure</th>", rows);
}

// "; named: ball" when recognition was asked about the object; else empty.
std::string pageNamed(const DemoFacts& facts, const std::string& object) {
  if (facts.recognition)
    for (const AskedGrasp& asked : facts.recognition->grasps)
      if (asked.known.object == object && asked.prediction) return "; named: " + asked.called;
  return {};
}

std::string pageHands(const DemoFacts& facts) {
  std::string figures;
  for (const DemoThing& thing : facts.things) {
    if (thing.picturePng.empty()) continue;
    std::string words = thing.object;
    if (thing.grip)
      words += ": " + std::to_string(thing.grip->fingers) + " fingers press it with " +
               fixedText(thing.grip->forceN, 1) + " N" + pageNamed(facts, thing.object);
    figures += "<figure>" + pageImage(thing.picturePng, "The hand holds: " + thing.object) +
               pageTagged("figcaption", words) + "</figure>\n";
  }
  if (figures.empty()) return {};
  return "<h2>What was held</h2>\n<p>Each picture is drawn from a recording: the joint angles say "
         "how "
         "the hand stands, the coloured taxels what its matrices feel, the sphere encloses what "
         "touches. The forces are the emulator's own.</p>\n<div class=\"hands\">\n" +
         figures + "</div>\n";
}

std::string pageRecognitionRow(const AskedGrasp& asked) {
  const std::string rank = asked.rank ? std::to_string(*asked.rank) : "not trained";
  std::string said = asked.problem, sure, probability;
  if (asked.prediction) {
    said = asked.called;
    sure = asked.prediction->sure ? "sure" : "not sure";
    if (asked.rank) probability = fixedText(asked.probability, 3);
    if (asked.called == "unknown") sure.clear();
  }
  return pageRow(pageCell(asked.known.object) + pageCell(said) + pageCell(sure) +
                 pageNumberCell(rank) + pageNumberCell(probability) +
                 pageMarkedCell(asked.right() ? "right" : "wrong", asked.right() ? "ok" : "bad"));
}

std::string pageRecognition(const DemoFacts& facts) {
  if (!facts.recognition) return {};
  std::string rows, warnings;
  for (const AskedGrasp& asked : facts.recognition->grasps) rows += pageRecognitionRow(asked);
  for (const std::string& warning : facts.recognition->warnings)
    warnings += pageTagged("p", warning);
  return "<h2>What was recognised</h2>\n<p>The model that comes with the program was trained on "
         "other grasps of these objects, each placed a little differently, and simulated without "
         "ports. It knows only the recordings. The rank and the probability are those of the "
         "object that was really there.</p>\n" +
         pageTable(
             "<th>held</th><th>called</th><th></th><th class=\"number\">rank</th>"
             "<th class=\"number\">probability</th><th></th>",
             rows) +
         warnings;
}

std::string pageSlip(const DemoFacts& facts) {
  if (!facts.slip) return {};
  const DemoSlip& slip = *facts.slip;
  const auto taxels = [&](double count) {
    return fixedText(count, 2) + " taxels, " + fixedText(count * facts.pitchMm, 1) + " mm";
  };
  std::string rows =
      pageRow(pageCell("the pen moved over matrix " + std::to_string(slip.motion.matrix)) +
              pageCell(taxels(slip.motion.movedTaxels)) + pageCell("the emulator"));
  if (slip.alarm) {
    const DemoAlarm& alarm = *slip.alarm;
    std::string matrices;
    for (const std::size_t matrix : slip.matrices)
      matrices += (matrices.empty() ? "" : ", ") + std::to_string(matrix);
    rows +=
        pageRow(pageCell("first alarm") +
                pageCell("frame " + std::to_string(alarm.frame) + ", " + fixedText(alarm.atS, 2) +
                         " s, matrix " + std::to_string(alarm.matrix)) +
                pageCell("the recording"));
    rows += pageRow(pageCell("distance the pen had moved by then") +
                    pageCell(taxels(alarm.movedTaxels)) + pageCell("the emulator"));
    rows +=
        pageRow(pageCell("time since it had moved " + fixedText(kDemoMovedTaxels, 1) + " taxel") +
                pageCell(fixedText(alarm.afterS * kMsPerS, 0) + " ms") + pageCell("both"));
    rows += pageRow(
        pageCell("alarm, state") +
        pageCell(std::string(nameOf(alarm.indicator)) + ", " + std::string(nameOf(alarm.state))) +
        pageCell("the recording"));
    rows += pageRow(pageCell("distance its imprint moved") + pageCell(taxels(alarm.imprintTaxels)) +
                    pageCell("the recording"));
    rows += pageRow(pageCell("matrices that raised an alarm") + pageCell(matrices) +
                    pageCell("the recording"));
  } else {
    rows += pageRow(pageCell("first alarm") + pageMarkedCell("none", "bad") +
                    pageCell("the recording"));
  }
  rows += pageRow(pageCell("alarms before it moved") + pageCell(std::to_string(slip.early)) +
                  pageCell("the recording"));
  return "<h2>What slipped</h2>\n<p>A smooth pen is pulled upwards between two fingertips, harder "
         "and harder: friction holds it, then it slips, and it is caught when the pull ends. How "
         "far it went is known to the emulator alone; the detector sees the pressure on the "
         "taxels.</p>\n" +
         pageTable("<th></th><th></th><th>known from</th>", rows) +
         pagePictureOrNothing(facts.slipPng,
                              "The window on the recording of the slip, with the dock Slip");
}

std::string pageFiles(const DemoFacts& facts) {
  std::string rows;
  for (const DemoFile& file : facts.files)
    rows += pageRow(
        pageCell(file.name) + pageCell(file.what) +
        pageNumberCell(file.bytes == 0
                           ? std::string()
                           : fixedText(std::ceil(static_cast<double>(file.bytes) / 1000.0), 0) +
                                 " kB"));
  return "<h2>Files in this folder</h2>\n" +
         pageTable("<th>file</th><th>what it is</th><th class=\"number\">size</th>", rows) +
         "<p><code>palpate FILE</code> opens a recording in the window, "
         "<code>palpate --demo</code> the window on an emulated hand.</p>\n";
}

}  // namespace

std::string demoPage(const DemoFacts& facts) {
  std::string page = kDemoPageHead;
  page +=
      "<h1>Palpate: a tour</h1>\n" +
      pageTagged("p class=\"quiet\"", "palpate " + facts.version + ", " + facts.madeAt + " UTC");
  page +=
      "\n<p>No hand was connected and nothing moved. What is shown here was measured by hands that "
      "the program emulates: joints, rubber, sensors and noise, behind the two serial ports "
      "that a real hand has, at its own speed. Connecting, recording and recognition work as with "
      "a real hand. The emulator knows what it holds and how far it slipped: so what was found "
      "can be compared with what is true.</p>\n";
  page += pageSteps(facts) + pageHands(facts) + pageRecognition(facts) + pageSlip(facts);
  if (!facts.windowPng.empty())
    page += "<h2>The window</h2>\n<p>The recording of the ball, as the window shows it.</p>\n" +
            pagePictureOrNothing(facts.windowPng, "The window on the recording of the ball");
  return page + pageFiles(facts) + "</body>\n</html>\n";
}

}  // namespace palpate::commands
