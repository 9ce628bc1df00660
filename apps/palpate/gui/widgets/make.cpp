#include "gui/widgets/make.h"

#include <QAction>
#include <QApplication>
#include <QDialog>
#include <QFontInfo>
#include <QFrame>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>
#include <cmath>
#include <utility>
#include <vector>

#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr double kGridEm = 2.0 / 3.0;  // 8 px where the letters have 12

// Takes other spaces when the text has changed: each layout is invalidated then.
class GrowingBox : public QBoxLayout {
 public:
  GrowingBox(Direction direction, Space between, Edges edges)
      : QBoxLayout(direction), between_(between), edges_(edges) {
    fit();
  }

  void addSpace(Space space) {
    auto* spacer = new QSpacerItem(0, 0);
    addSpacerItem(spacer);
    spacers_.emplace_back(spacer, space);
    resize(spacer, space);
  }

  void invalidate() override {
    fit();
    QBoxLayout::invalidate();
  }

 private:
  void resize(QSpacerItem* spacer, Space space) const {
    const bool across = direction() == LeftToRight;
    spacer->changeSize(across ? px(space) : 0,
                       across ? 0 : px(space),
                       across ? QSizePolicy::Fixed : QSizePolicy::Minimum,
                       across ? QSizePolicy::Minimum : QSizePolicy::Fixed);
  }

  void fit() {
    if (px(Space::kUsual) == fitted_) return;
    fitted_ = px(Space::kUsual);
    setSpacing(px(between_));
    setContentsMargins(px(edges_.left), px(edges_.top), px(edges_.right), px(edges_.bottom));
    for (const auto& [spacer, space] : spacers_) resize(spacer, space);
  }

  Space between_;
  Edges edges_;
  std::vector<std::pair<QSpacerItem*, Space>> spacers_;
  int fitted_ = 0;  // px(Space::kUsual) of the present spaces
};

void addPart(GrowingBox& box, const Part& part) {
  if (const auto* widget = std::get_if<QWidget*>(&part.content))
    box.addWidget(*widget, part.share, part.alignment);
  else if (const auto* layout = std::get_if<QLayout*>(&part.content))
    box.addLayout(*layout, part.share);
  else if (const auto* text = std::get_if<QString>(&part.content))
    box.addWidget(new QLabel(*text));
  else if (const auto* space = std::get_if<Space>(&part.content))
    box.addSpace(*space);
  else
    box.addStretch(std::get<Stretch>(part.content).share);
}

QBoxLayout* layoutOf(QBoxLayout::Direction direction,
                     std::initializer_list<Part> parts,
                     Space between,
                     Edges edges) {
  auto* box = new GrowingBox(direction, between, edges);
  for (const Part& part : parts) addPart(*box, part);
  return box;
}

}  // namespace

int px(Space space) {
  const double grid = kGridEm * QFontInfo(QApplication::font()).pixelSize();
  return static_cast<int>(std::lround(0.5 * static_cast<int>(space) * grid));
}

QBoxLayout* inRow(std::initializer_list<Part> parts, Space between, Edges edges) {
  return layoutOf(QBoxLayout::LeftToRight, parts, between, edges);
}

QBoxLayout* inColumn(std::initializer_list<Part> parts, Space between, Edges edges) {
  return layoutOf(QBoxLayout::TopToBottom, parts, between, edges);
}

QBoxLayout* inRow(std::initializer_list<Part> parts, Edges edges) {
  return inRow(parts, Space::kUsual, edges);
}

QBoxLayout* inColumn(std::initializer_list<Part> parts, Edges edges) {
  return inColumn(parts, Space::kUsual, edges);
}

QWidget* makeBox(QLayout* layout, QWidget* parent) {
  auto* box = new QWidget(parent);
  box->setLayout(layout);
  return box;
}

QPushButton* makeButton(QWidget* parent,
                        const QString& name,
                        const QString& text,
                        const QString& tip) {
  auto* button = named(new QPushButton(text, parent), name, tip);
  button->setAutoDefault(false);
  return button;
}

QPushButton* makePrimary(QWidget* parent,
                         const QString& name,
                         const QString& text,
                         const QString& tip) {
  auto* button = makeButton(parent, name, text, tip);
  button->setProperty("primary", true);
  return button;
}

QPushButton* makeOk(QDialog* dialog, const QString& name, const QString& text) {
  constexpr int kMinWidth = 110;  // [px]
  auto* button = makePrimary(dialog, name, text);
  button->setDefault(true);
  keepWide(*button, kMinWidth);
  return button;
}

QPushButton* makeCancel(QDialog* dialog, const QString& name) {
  auto* button = makeButton(dialog, name, "Cancel");
  button->setAutoDefault(true);
  QObject::connect(button, &QPushButton::clicked, dialog, &QDialog::reject);
  return button;
}

QWidget* makeDialogFoot(QLayout* layout) {
  auto* foot = new QFrame;
  foot->setProperty("role", "foot");
  foot->setLayout(layout);
  return foot;
}

QToolButton* makeToolButton(QWidget* parent,
                            const QString& name,
                            const QString& text,
                            const QString& tip) {
  auto* button = named(new QToolButton(parent), name, tip);
  button->setText(text);
  return button;
}

QToolButton* makeToolButton(QWidget* parent, QAction* action) {
  auto* button = new QToolButton(parent);
  button->setDefaultAction(action);
  button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  return button;
}

QLabel* makeLabel(QWidget* parent, const QString& name, const QString& role, const QString& text) {
  auto* label = named(new QLabel(parent), name);
  label->setTextFormat(Qt::PlainText);
  label->setText(text);
  if (!role.isEmpty()) label->setProperty("role", role);
  return label;
}

QLabel* makeLines(QWidget* parent, const QString& name, const QString& role, const QString& text) {
  auto* label = makeLabel(parent, name, role, text);
  label->setWordWrap(true);
  return label;
}

QLabel* makeTitle(const QString& text, QWidget* field) {
  auto* label = new QLabel(text);
  label->setBuddy(field);
  return label;
}

}  // namespace palpate::gui
