#include "gui/desktop/field_keys.h"

#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QLineEdit>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTest>
#include <QVBoxLayout>

#include <gtest/gtest.h>

#include "gui/testing/make_active.h"

namespace palpate::gui::field_keys_test {
namespace {

class FieldKeysTest : public ::testing::Test {
 protected:
  FieldKeysTest() {
    list_.setEditable(true);
    list_.setEditText("finger 0");
    field_.setText("finger 1");
    auto* column = new QVBoxLayout(&window_);
    column->addWidget(&list_);
    column->addWidget(&field_);
    action_.setShortcut(QKeySequence("Ctrl+U"));
    window_.addAction(&action_);
    window_.show();
    makeActive(window_);
  }
  void press(QWidget& widget, Qt::Key key) {
    widget.setFocus();
    QTest::keyClick(&widget, key, Qt::ControlModifier);
  }

  FieldKeys keys_{nullptr};
  QWidget window_;
  QComboBox list_{&window_};
  QLineEdit field_{&window_};
  QAction action_{"Spectrum"};
  QSignalSpy triggered_{&action_, &QAction::triggered};
};

TEST_F(FieldKeysTest, AFieldLetsTheKeysOfTheWindowPass) {
  press(field_, Qt::Key_U);
  EXPECT_EQ(triggered_.size(), 1);
  EXPECT_EQ(field_.text(), "finger 1");
}

// The focus is that of the list, not of the field in it.
TEST_F(FieldKeysTest, SoDoesAListThatCanBeTypedInto) {
  press(list_, Qt::Key_U);
  EXPECT_EQ(triggered_.size(), 1);
  EXPECT_EQ(list_.currentText(), "finger 0");
}

TEST_F(FieldKeysTest, ADoubleClickInANumberFieldSelectsTheNumber) {
  QSpinBox number(&window_);
  number.setValue(10);
  number.setSuffix(" deg/s");
  number.resize(200, 30);
  number.show();
  auto* line = number.findChild<QLineEdit*>();
  // Right of the text.
  QTest::mouseDClick(line, Qt::LeftButton, {}, {line->width() - 3, line->height() / 2});
  EXPECT_EQ(line->selectedText(), "10");
  QTest::keyClicks(line, "25");
  EXPECT_EQ(number.value(), 25);
}

TEST_F(FieldKeysTest, ItKeepsItsOwnKeys) {
  action_.setShortcut(QKeySequence("Ctrl+A"));
  press(list_, Qt::Key_A);
  EXPECT_EQ(triggered_.size(), 0);
  EXPECT_EQ(list_.lineEdit()->selectedText(), "finger 0");
}

}  // namespace
}  // namespace palpate::gui::field_keys_test
