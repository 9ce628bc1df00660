// Makes controls with their names and tips, and places them in rows and columns. The spaces
// between them are a few named ones and grow with the text.
#pragma once

#include <QBoxLayout>
#include <QString>
#include <QWidget>
#include <cstdint>
#include <initializer_list>
#include <variant>

class QAction;
class QDialog;
class QLabel;
class QPushButton;
class QToolButton;

namespace palpate::gui {

// Spaces in steps of half a grid of 8 px at the usual size of text (9 pt at 96 dpi): 4, 8, 12 px,
// and 20 around the fields of a dialog.
enum class Space : std::uint8_t { kNone, kNarrow, kUsual, kWide, kDialog = 5 };
// At the present size of text [px].
int px(Space space);

// Spaces around the controls of a row or column.
struct Edges {
  Space left = Space::kNone, top = Space::kNone, right = Space::kNone, bottom = Space::kNone;
};
constexpr Edges around(Space space) { return {space, space, space, space}; }
// Of the page of a dock, and of a line of controls at its border.
inline constexpr Edges kPageEdges{Space::kWide, Space::kUsual, Space::kWide, Space::kUsual};
inline constexpr Edges kBarEdges{Space::kWide, Space::kNarrow, Space::kWide, Space::kNarrow};
// Of the buttons below a dialog.
inline constexpr Edges kFootEdges{Space::kDialog, Space::kWide, Space::kDialog, Space::kWide};

// A space that takes what the controls leave of a row, in this share.
struct Stretch {
  int share = 1;
};

// What stands in a row: a control or other layout, with its share of the room that is left, a text
// (a label is made of it), an additional space, or a stretch.
struct Part {
  Part(QWidget* widget, int ofRoom = 0, Qt::Alignment at = {})
      : content(widget), share(ofRoom), alignment(at) {}
  Part(QLayout* layout, int ofRoom = 0) : content(layout), share(ofRoom) {}
  Part(const char* text) : content(QString(text)) {}
  Part(const QString& text) : content(text) {}
  Part(Space space) : content(space) {}
  Part(Stretch stretch) : content(stretch) {}

  std::variant<QWidget*, QLayout*, QString, Space, Stretch> content;
  int share = 0;
  Qt::Alignment alignment;
};

// The layouts have no widget yet: setLayout(inColumn({…})), or they are parts of other ones.
QBoxLayout* inRow(std::initializer_list<Part> parts,
                  Space between = Space::kUsual,
                  Edges edges = {});
QBoxLayout* inColumn(std::initializer_list<Part> parts,
                     Space between = Space::kUsual,
                     Edges edges = {});
// With usual spaces between the parts.
QBoxLayout* inRow(std::initializer_list<Part> parts, Edges edges);
QBoxLayout* inColumn(std::initializer_list<Part> parts, Edges edges);
// A widget with this layout, for parts that are shown and hidden together.
QWidget* makeBox(QLayout* layout, QWidget* parent = nullptr);

// Gives the control its object name, its tip and its name for screen readers, and returns it.
template <class Control>
Control* named(Control* control,
               const QString& name,
               const QString& tip = {},
               const QString& accessible = {}) {
  control->setObjectName(name);
  if (!tip.isEmpty()) control->setToolTip(tip);
  if (!accessible.isEmpty()) control->setAccessibleName(accessible);
  return control;
}

// In a dialog, Return presses it while it has the focus, and else the one of makeOk().
QPushButton* makeButton(QWidget* parent,
                        const QString& name,
                        const QString& text,
                        const QString& tip = {});
// Such a button that stands out among others: what is usually wanted.
QPushButton* makePrimary(QWidget* parent,
                         const QString& name,
                         const QString& text,
                         const QString& tip = {});
// The primary button of a dialog, which Return presses; and the one that rejects the dialog.
QPushButton* makeOk(QDialog* dialog, const QString& name, const QString& text);
QPushButton* makeCancel(QDialog* dialog, const QString& name);
// What stands below a dialog and a hairline, usually a row within kFootEdges.
QWidget* makeDialogFoot(QLayout* layout);
QToolButton* makeToolButton(QWidget* parent,
                            const QString& name,
                            const QString& text,
                            const QString& tip = {});
// Does, shows and enables what the action does; its icon stands beside its text.
QToolButton* makeToolButton(QWidget* parent, QAction* action);
// A label of plain text; `role` is that of the style sheet ("muted", "heading",
// "problem"), or empty.
QLabel* makeLabel(QWidget* parent,
                  const QString& name,
                  const QString& role = {},
                  const QString& text = {});
// Such a label whose text goes on in further lines.
QLabel* makeLines(QWidget* parent,
                  const QString& name,
                  const QString& role = {},
                  const QString& text = {});
// The title beside a field, to which its key ("&Name") goes.
QLabel* makeTitle(const QString& text, QWidget* field);

}  // namespace palpate::gui
