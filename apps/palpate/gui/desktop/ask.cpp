#include "gui/desktop/ask.h"

#include <QApplication>
#include <QFileDialog>
#include <QInputDialog>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <algorithm>

namespace palpate::gui {

QString Ask::newFile(const QString& title,
                     const QString& suggestion,
                     const QString& filter,
                     const QString& ending) {
  const QString path = places(Place::kNewFile, title, suggestion, filter).value(0);
  return path.isEmpty() || path.endsWith(ending) ? path : path + ending;
}

QWidget* DialogAsk::parent() const {
  if (QWidget* modal = QApplication::activeModalWidget()) return modal;
  QWidget* active = QApplication::activeWindow();
  return active ? active : window_;
}

QStringList DialogAsk::places(Place place,
                              const QString& title,
                              const QString& begin,
                              const QString& filter) {
  if (place == Place::kFiles) return QFileDialog::getOpenFileNames(parent(), title, begin, filter);
  return {place == Place::kFile     ? QFileDialog::getOpenFileName(parent(), title, begin, filter)
          : place == Place::kFolder ? QFileDialog::getExistingDirectory(parent(), title, begin)
                                    : QFileDialog::getSaveFileName(parent(), title, begin, filter)};
}

std::optional<QString> DialogAsk::text(const QString& title,
                                       const QString& question,
                                       const QString& text) {
  QInputDialog dialog(parent());
  dialog.setWindowTitle(title);
  dialog.setLabelText(question);
  dialog.setTextValue(text);
  // The present text is seen whole, as far as it is not very long.
  constexpr int kMinWidth = 360, kMaxWidth = 640, kAround = 60;  // [px]
  const int widest = std::max(dialog.fontMetrics().horizontalAdvance(question),
                              dialog.fontMetrics().horizontalAdvance(text));
  dialog.resize(std::clamp(widest + kAround, kMinWidth, kMaxWidth), dialog.sizeHint().height());
  if (auto* label = dialog.findChild<QLabel*>()) label->setWordWrap(true);
  if (dialog.exec() != QDialog::Accepted) return std::nullopt;
  return dialog.textValue().simplified();
}

int DialogAsk::choice(const QString& text, const QStringList& buttons, int enter) {
  QMessageBox box(QMessageBox::NoIcon, "Palpate", text, QMessageBox::Cancel, parent());
  QList<QAbstractButton*> made;
  for (const QString& button : buttons)
    made << box.addButton(
        button,
        made.size() + 1 < buttons.size() ? QMessageBox::AcceptRole : QMessageBox::DestructiveRole);
  box.setDefaultButton(
      qobject_cast<QPushButton*>(enter < 0 ? box.button(QMessageBox::Cancel) : made.at(enter)));
  box.exec();
  return static_cast<int>(made.indexOf(box.clickedButton()));
}

}  // namespace palpate::gui
