#include "gui/widgets/make.h"

#include <QAction>
#include <QApplication>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTest>
#include <QToolButton>
#include <memory>

#include <gtest/gtest.h>

namespace palpate::gui::make_test {
namespace {

// Sets the size of the letters, and the former size at the end.
class LettersOf {
 public:
  explicit LettersOf(int pixels) {
    QFont font = QApplication::font();
    font.setPixelSize(pixels);
    QApplication::setFont(font);
  }
  ~LettersOf() { QApplication::setFont(before_); }

 private:
  QFont before_ = QApplication::font();
};

QSize sizeOf(QWidget& widget) {
  widget.layout()->activate();
  return widget.sizeHint();
}

QWidget* block(QWidget* parent) {
  auto* made = new QWidget(parent);
  made->setFixedSize(10, 10);
  return made;
}

TEST(Make, SpacesAreOnAGridOfEightPixelsAndGrowWithTheText) {
  {
    const LettersOf usual(12);
    EXPECT_EQ(px(Space::kNone), 0);
    EXPECT_EQ(px(Space::kNarrow), 4);
    EXPECT_EQ(px(Space::kUsual), 8);
    EXPECT_EQ(px(Space::kWide), 12);
    EXPECT_EQ(px(Space::kDialog), 20);
  }
  const LettersOf large(24);
  EXPECT_EQ(px(Space::kNone), 0);
  EXPECT_EQ(px(Space::kUsual), 16);
  EXPECT_EQ(px(Space::kDialog), 40);
}

TEST(Make, ARowPlacesItsPartsWithSpacesBetweenAndAround) {
  const LettersOf usual(12);
  QWidget widget;
  widget.setLayout(inRow({block(&widget), block(&widget), Space::kNarrow, block(&widget)},
                         Space::kUsual,
                         {.left = Space::kWide, .bottom = Space::kNarrow}));
  // The additional space comes to the usual one.
  EXPECT_EQ(sizeOf(widget), QSize(12 + 10 + 8 + 10 + 8 + 4 + 10, 10 + 4));
}

TEST(Make, TheSpacesOfAShownRowGrowWithTheText) {
  const LettersOf usual(12);
  QWidget widget;
  widget.setLayout(inColumn(
      {inRow({block(&widget), Space::kWide, block(&widget)}, Space::kNone), block(&widget)},
      around(Space::kUsual)));
  EXPECT_EQ(sizeOf(widget), QSize(8 + 10 + 12 + 10 + 8, 8 + 10 + 8 + 10 + 8));
  const LettersOf large(24);
  widget.layout()->invalidate();
  EXPECT_EQ(sizeOf(widget), QSize(16 + 10 + 24 + 10 + 16, 16 + 10 + 16 + 10 + 16));
}

TEST(Make, WhatIsLeftOfARowGoesToThePartsByTheirShare) {
  const LettersOf usual(12);
  QWidget widget;
  auto* one = new QWidget(&widget);
  auto* three = new QWidget(&widget);
  widget.setLayout(inRow({{one, 1}, {three, 3}}, Space::kNone));
  widget.resize(400, 20);
  widget.layout()->activate();
  EXPECT_EQ(one->width(), 100);
  EXPECT_EQ(three->width(), 300);
}

TEST(Make, ATextInARowIsALabelOfTheWidget) {
  QWidget widget;
  widget.setLayout(inColumn({inRow({"Bins", new QLineEdit(&widget)})}));
  const auto labels = widget.findChildren<QLabel*>();
  ASSERT_EQ(labels.size(), 1);
  EXPECT_EQ(labels.front()->text(), "Bins");
  EXPECT_EQ(labels.front()->parentWidget(), &widget);
}

TEST(Make, ControlsHaveTheirNamesAndTips) {
  QWidget widget;
  const auto* field = named(new QLineEdit(&widget), "cutoff", "Above it nothing passes", "Cutoff");
  EXPECT_EQ(field->objectName(), "cutoff");
  EXPECT_EQ(field->toolTip(), "Above it nothing passes");
  EXPECT_EQ(field->accessibleName(), "Cutoff");
  const auto* button = makeButton(&widget, "save", "&Save…", "As JSON");
  EXPECT_EQ(button->objectName(), "save");
  EXPECT_EQ(button->text(), "&Save…");
  EXPECT_EQ(button->toolTip(), "As JSON");
  EXPECT_EQ(button->parentWidget(), &widget);
  const auto* tool = makeToolButton(&widget, "swap", "⇄", "Swap A and B");
  EXPECT_EQ(tool->objectName(), "swap");
  EXPECT_EQ(tool->toolTip(), "Swap A and B");
  // Pressed by a key, but a click leaves the focus where it is.
  EXPECT_EQ(tool->focusPolicy(), Qt::TabFocus);
}

TEST(Make, ReturnInADialogPressesTheFocusedOfItsButtonsElseOk) {
  QDialog dialog;
  auto* field = new QLineEdit(&dialog);
  auto* ok = makeOk(&dialog, "ok", "Export");
  auto* cancel = makeCancel(&dialog, "cancel");
  auto* browse = makeButton(&dialog, "browse", "Browse…");
  dialog.setLayout(
      inColumn({inRow({field, browse}), makeDialogFoot(inRow({cancel, ok}, kFootEdges))}));
  EXPECT_EQ(ok->property("primary"), true);
  EXPECT_GE(ok->minimumWidth(), 110);
  int pressed = 0;
  QObject::connect(ok, &QPushButton::clicked, &dialog, [&] { ++pressed; });
  dialog.show();
  QTest::keyClick(field, Qt::Key_Return);
  EXPECT_EQ(pressed, 1);
  EXPECT_TRUE(dialog.isVisible());
  cancel->setFocus();
  QTest::keyClick(cancel, Qt::Key_Return);
  EXPECT_EQ(pressed, 1);
  EXPECT_FALSE(dialog.isVisible());
  EXPECT_EQ(dialog.result(), QDialog::Rejected);
}

TEST(Make, ALabelShowsItsTextAsItIs) {
  QWidget widget;
  const auto* label = makeLabel(&widget, "name", "muted", "<b>cup</b>");
  EXPECT_EQ(label->textFormat(), Qt::PlainText);
  EXPECT_EQ(label->text(), "<b>cup</b>");
  EXPECT_EQ(label->property("role").toString(), "muted");
  EXPECT_FALSE(label->wordWrap());
  EXPECT_TRUE(makeLines(&widget, "note")->wordWrap());
  EXPECT_FALSE(makeLines(&widget, "note")->property("role").isValid());
}

TEST(Make, TheKeyOfATitleGoesToItsField) {
  QLineEdit field;
  const std::unique_ptr<QLabel> title(makeTitle("&Unit", &field));
  EXPECT_EQ(title->buddy(), &field);
}

TEST(Make, AButtonOfAnActionFollowsIt) {
  QWidget widget;
  QAction action("Values");
  action.setCheckable(true);
  const auto* button = makeToolButton(&widget, &action);
  EXPECT_EQ(button->text(), "Values");
  action.setText("Numbers");
  action.setEnabled(false);
  action.setChecked(true);
  EXPECT_EQ(button->text(), "Numbers");
  EXPECT_FALSE(button->isEnabled());
  EXPECT_TRUE(button->isChecked());
}

}  // namespace
}  // namespace palpate::gui::make_test
