#include "gui/widgets/notes_label.h"

#include <QLabel>

#include <palpate/calibration/calibration.h>
#include <palpate/core/time.h>

#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

constexpr int kNotesMargin = 8;  // [px]

}  // namespace

QString linesOf(const std::vector<std::string>& notes) { return linesOf(notes, {}); }

QString linesOf(const std::vector<std::string>& notes, const std::vector<std::string>& more) {
  QStringList lines;
  for (const auto* each : {&notes, &more})
    for (const std::string& note : *each) lines.append(QString::fromStdString(note));
  return lines.join("\n");
}

QLabel* notesLabel(const char* name, QWidget* parent) {
  auto* label = makeLines(parent, name, "muted");
  // setMargin(), because contents margins don't count for the height of a label.
  label->setMargin(kNotesMargin);
  return label;
}

std::string programVersion() { return PALPATE_VERSION; }

std::string madeNow() {
  constexpr std::size_t kSeconds = 19;  // "2014-11-27 10:31:05"
  std::string text = utcText(systemClock().wallUs()).substr(0, kSeconds) + "Z";
  text[text.find(' ')] = 'T';
  return text;
}

Json calibrationProvenance(const std::string& kind) {
  return Json::object()
      .set("kind", "palpate " + kind + " calibration")
      .set("format_version", Calibration::kFormatVersion)
      .set("program_version", programVersion())
      .set("made_at", madeNow());
}

}  // namespace palpate::gui
