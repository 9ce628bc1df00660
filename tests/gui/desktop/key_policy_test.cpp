#include "gui/desktop/key_policy.h"

#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTest>
#include <QVBoxLayout>
#include <memory>

#include <gtest/gtest.h>

#include "gui/testing/make_active.h"

namespace palpate::gui::key_policy_test {
namespace {

class KeyPolicyTest : public ::testing::Test {
 protected:
  KeyPolicyTest() {
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

  QWidget window_;
  QComboBox list_{&window_};
  QLineEdit field_{&window_};
  QAction action_{"Spectrum"};
  QSignalSpy triggered_{&action_, &QAction::triggered};
};

TEST_F(KeyPolicyTest, AFieldLetsTheKeysOfTheWindowPass) {
  press(field_, Qt::Key_U);
  EXPECT_EQ(triggered_.size(), 1);
  EXPECT_EQ(field_.text(), "finger 1");
}

// The focus is that of the list, not of the field in it.
TEST_F(KeyPolicyTest, SoDoesAListThatCanBeTypedInto) {
  press(list_, Qt::Key_U);
  EXPECT_EQ(triggered_.size(), 1);
  EXPECT_EQ(list_.currentText(), "finger 0");
}

TEST_F(KeyPolicyTest, ADoubleClickInANumberFieldSelectsTheNumber) {
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

TEST_F(KeyPolicyTest, ItKeepsItsOwnKeys) {
  action_.setShortcut(QKeySequence("Ctrl+A"));
  press(list_, Qt::Key_A);
  EXPECT_EQ(triggered_.size(), 0);
  EXPECT_EQ(list_.lineEdit()->selectedText(), "finger 0");
}

// Notes the presses of keys that it sees, and takes those of one key.
class Noting final : public QObject {
 public:
  Noting(QStringList& seen, const char* name, Qt::Key takes)
      : seen_(seen), name_(name), takes_(takes) {}
  bool eventFilter(QObject* /*watched*/, QEvent* event) override {
    if (event->type() != QEvent::KeyPress) return false;
    seen_.append(name_);
    return static_cast<QKeyEvent*>(event)->key() == takes_;
  }

 private:
  QStringList& seen_;
  QString name_;
  Qt::Key takes_;
};

// Whatever was installed first: the stop of the hand, why a key is greyed, the focused button.
TEST_F(KeyPolicyTest, TheStepsComeInTheirWrittenOrder) {
  QStringList seen;
  QPushButton button("Play", &window_);
  QObject::connect(&button, &QPushButton::clicked, [&] { seen.append("button"); });
  button.show();
  button.setFocus();
  Noting greyed(seen, "greyed", Qt::Key_Enter);
  KeyPolicy::ofApplication().install(KeyPolicy::Order::kGreyed, greyed);
  auto stop = std::make_unique<Noting>(seen, "stop", Qt::Key_Escape);
  KeyPolicy::ofApplication().install(KeyPolicy::Order::kStop, *stop);
  const auto press = [&](Qt::Key key) {
    seen.clear();
    QKeyEvent event(QEvent::KeyPress, key, Qt::NoModifier);
    QApplication::sendEvent(&button, &event);
    return seen;
  };
  EXPECT_EQ(press(Qt::Key_Return), (QStringList{"stop", "greyed", "button"}));
  EXPECT_EQ(press(Qt::Key_Enter), (QStringList{"stop", "greyed"})) << "it was taken";
  EXPECT_EQ(press(Qt::Key_Escape), QStringList{"stop"});
  stop.reset();
  EXPECT_EQ(press(Qt::Key_Return), (QStringList{"greyed", "button"}));
}

}  // namespace
}  // namespace palpate::gui::key_policy_test
