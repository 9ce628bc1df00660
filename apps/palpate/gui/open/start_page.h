// The start page of the window, shown when nothing is open: buttons for what can be done, and
// recent recordings.
#pragma once

#include <QWidget>

#include "gui/open/thumbnails.h"
#include "gui/source/recent_files.h"

class QLabel;
class QPushButton;
class QVBoxLayout;

namespace palpate::gui {

class StartPage : public QWidget {
  Q_OBJECT
 public:
  // `recent` and `thumbnails` must outlive this. `withDemo`: whether the demo recording exists.
  StartPage(RecentFiles& recent,
            const Thumbnails& thumbnails,
            bool withDemo,
            QWidget* parent = nullptr);
  // Puts a picture above the buttons.
  void setScene(QWidget* scene);
  // What the last connection was, and when; empty: there was none.
  void setLastConnection(const QString& text);
  // What the plan of recordings has left; empty: nothing.
  void setPlan(const QString& text);
  // A file is being dragged over the window.
  void setDragging(bool on);

 signals:
  void openRequested();
  void libraryRequested();
  // The user wants the demo recording.
  void demoRequested();
  void connectRequested();
  // The user wants the last connection.
  void againRequested();
  void emulatedRequested();
  // The user wants the plan of recordings.
  void planRequested();
  void fileChosen(const QString& path);

 protected:
  void showEvent(QShowEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void listRecent();
  void fitScene();

  RecentFiles& recent_;
  const Thumbnails& thumbnails_;
  QWidget* scene_ = nullptr;
  QWidget* list_ = nullptr;
  QVBoxLayout* column_;
  QPushButton* again_;
  QPushButton* plan_;
  QLabel* recentHeading_;
  QLabel* dropHint_;
};

}  // namespace palpate::gui
