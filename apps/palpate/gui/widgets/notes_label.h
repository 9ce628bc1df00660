// Texts that the pages of the dock Calibrate share: notes below tables, and the origin of a
// calibration file.
#pragma once

#include <QString>
#include <initializer_list>
#include <string>
#include <vector>

#include <palpate/core/json.h>

class QLabel;
class QWidget;

namespace palpate::gui {

// Joins the notes, one per line.
QString linesOf(const std::vector<std::string>& notes);
QString linesOf(const std::vector<std::string>& notes, const std::vector<std::string>& more);
// A label for notes below a table, in a muted colour, with as many lines as needed.
QLabel* notesLabel(const char* name, QWidget* parent);
// The first members of the JSON of `palpate calibrate`: kind, format version, program version,
// time.
Json calibrationProvenance(const std::string& kind);
std::string programVersion();
// The present time in UTC, ISO 8601: "2014-11-27T10:31:05Z".
std::string madeNow();

}  // namespace palpate::gui
