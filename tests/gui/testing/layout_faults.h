// Finds what a layout cuts off or puts over something else, in all visible widgets of a window.
#pragma once

#include <QStringList>
#include <QWidget>

namespace palpate::gui {

// One line for each fault of the visible widgets of `window`: a text that is wider or higher than
// its label, button, box, field, tab or heading; a widget of which a part lies outside the widget
// around it (unless that scrolls, and the widget can be scrolled to in full); two widgets that
// overlap; a window that is smaller than its content needs. What is scrolled out of sight is no
// fault. Texts that are shortened on purpose (ElidedText, cells of tables) are no fault if a tool
// tip holds the whole text.
QStringList layoutFaults(const QWidget& window);

}  // namespace palpate::gui
