// Words and figures as all docks write them.
#pragma once

#include <QString>

class QLabel;
class QWidget;

namespace palpate::gui {

// The small heading of a part of a dock: "JOINT ANGLES".
QLabel* sectionHeading(const QString& text, QWidget* parent);
// "31.7": with so many decimals, whatever the locale.
QString figure(double value, int decimals);

}  // namespace palpate::gui
