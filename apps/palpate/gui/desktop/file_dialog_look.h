// Makes the file dialogues look like the window: icons without colours, and columns in which names
// and dates aren't cut.
#pragma once

#include <QFileIconProvider>
#include <QObject>

namespace palpate::gui {

class FileDialogLook : public QObject {
 public:
  explicit FileDialogLook(QObject* parent);

 protected:
  // Filters the events of the whole application.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  class GreyIcons : public QFileIconProvider {
   public:
    QIcon icon(IconType type) const override;
    QIcon icon(const QFileInfo& info) const override;
  };
  // The dialogues refer to it.
  GreyIcons icons_;
};

}  // namespace palpate::gui
