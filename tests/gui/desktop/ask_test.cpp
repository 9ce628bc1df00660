// What is the same for all that ask, and the dialogues in which the user answers.
#include "gui/desktop/ask.h"

#include <QApplication>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QTimer>
#include <functional>

#include <gtest/gtest.h>

#include "gui/testing/fake_ask.h"

namespace palpate::gui::ask_test {
namespace {

// Answers in the dialogue that stands there next.
void then(const std::function<void(QDialog&)>& answer) {
  QTimer::singleShot(
      0, qApp, [answer] { answer(*qobject_cast<QDialog*>(QApplication::activeModalWidget())); });
}

void press(QDialog& dialog, const QString& text) {
  for (auto* button : dialog.findChildren<QPushButton*>())
    if (button->text().remove('&') == text) return button->click();
  ADD_FAILURE() << "no button " << text.toStdString();
  dialog.reject();
}

TEST(Ask, ANewFileGetsItsEndingOnce) {
  FakeAsk ask;
  ask.newFiles = {"/a/b", "/a/b.json", QString()};
  EXPECT_EQ(ask.newFile("Save", "b", "Files (*.json)", ".json"), "/a/b.json");
  EXPECT_EQ(ask.newFile("Save", "b", "Files (*.json)", ".json"), "/a/b.json");
  EXPECT_EQ(ask.newFile("Save", "b", "Files (*.json)", ".json"), "") << "cancelled";
}

TEST(DialogAsk, TheButtonThatIsPressedIsTheAnswerAndEnterCancelsUnlessItMay) {
  DialogAsk ask;
  for (const char* text : {"Save", "Discard", "Cancel"}) {
    then([&](QDialog& dialog) { press(dialog, text); });
    EXPECT_EQ(ask.choice("Save it?", {"Save", "Discard"}, 0),
              QStringList({"Save", "Discard"}).indexOf(text));
  }
  then([](QDialog& dialog) { dialog.reject(); });
  EXPECT_EQ(ask.choice("Save it?", {"Save", "Discard"}, 0), -1);
  const auto isDefault = [](const QString& wanted) {
    then([wanted](QDialog& dialog) {
      EXPECT_EQ(dynamic_cast<QMessageBox&>(dialog).defaultButton()->text().remove('&'), wanted);
      dialog.reject();
    });
  };
  isDefault("Save");
  ask.choice("Save it?", {"Save", "Discard"}, 0);
  isDefault("Cancel");
  EXPECT_FALSE(ask.confirmed("Delete it?", "Delete"));
}

TEST(DialogAsk, ATextHasNoSpacesAroundItAndCanBeEmptyOrCancelled) {
  DialogAsk ask;
  then([](QDialog& dialog) {
    EXPECT_EQ(dialog.windowTitle(), "Pose");
    auto* field = dialog.findChild<QLineEdit*>();
    EXPECT_EQ(field->text(), "rest");
    field->setText("  a  name ");
    dialog.accept();
  });
  EXPECT_EQ(ask.text("Pose", "Name", "rest"), "a name");
  then([](QDialog& dialog) { dialog.accept(); });
  EXPECT_EQ(ask.text("Pose", "Name", ""), "");
  then([](QDialog& dialog) { dialog.reject(); });
  EXPECT_EQ(ask.text("Pose", "Name", "rest"), std::nullopt);
}

}  // namespace
}  // namespace palpate::gui::ask_test
