// What the pages of the dock Calibrate write alike: notes, and who made a file when.
#pragma once

#include <QString>
#include <initializer_list>
#include <string>
#include <vector>

#include <palpate/core/json.h>

class QLabel;
class QWidget;

namespace palpate::gui {

// A sentence per line.
QString linesOf(const std::vector<std::string>& notes);
QString linesOf(const std::vector<std::string>& notes, const std::vector<std::string>& more);
// Quiet words below a table, in as many lines as they take.
QLabel* notesLabel(const char* name, QWidget* parent);
// As `palpate calibrate` begins its JSON: kind, format version, program version, when.
Json calibrationProvenance(const std::string& kind);
std::string programVersion();
// Now, UTC, ISO 8601: "2014-11-27T10:31:05Z".
std::string madeNow();

}  // namespace palpate::gui
