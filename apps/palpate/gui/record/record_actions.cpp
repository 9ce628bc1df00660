#include "gui/record/record_actions.h"

namespace palpate::gui {
namespace {

constexpr int kDigits = 10;

}  // namespace

RecordActions::RecordActions(ActionRegistry& book) {
  record = book.make("record", "Hand", "&Record", {key("Ctrl+R")});
  recordingSettings =
      book.make("recordingSettings", "Hand", "Recording &names and marks…", {key("Ctrl+N")});
  openRecorded =
      book.make("openRecorded", "Hand", "&Open the last recording", {key("Ctrl+Shift+O")});
  mark = book.make("mark", "Hand", "&Mark the moment", {key("Space")});
  for (int digit = 0; digit < kDigits; ++digit)
    labels.append(book.add("labels",
                           "Hand",
                           "Mark " + QString::number(digit),
                           {QKeySequence(QString::number(digit))}));
  record->setIconText(" " + plainText(*record));
}

}  // namespace palpate::gui
