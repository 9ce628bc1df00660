// The content of the dock Recognise: pages that ask what is in the hand, adapt to today, teach, and check how well it goes.
#pragma once

#include <QSettings>
#include <QWidget>
#include <filesystem>
#include <optional>

#include "gui/recognise_desk.h"
#include "gui/teaching_desk.h"
#include "gui/theme.h"

class QButtonGroup;
class QStackedWidget;

namespace palpate::gui {

class AskPage;
class CheckPage;
class OpeningStrip;
class TeachPage;
class TodayPage;

class RecognisePanel : public QWidget {
  Q_OBJECT
 public:
  RecognisePanel(QSettings& settings,
                 const std::filesystem::path& dataFolder,
                 QWidget* parent = nullptr);
  // The chooser of pages, for the dock's title row.
  QWidget& header() noexcept { return *header_; }
  void setTheme(Theme theme);

  RecogniseDesk& desk() noexcept { return *desk_; }
  TeachingDesk& teaching() noexcept { return *teaching_; }
  AskPage& ask() noexcept { return *ask_; }
  TodayPage& today() noexcept { return *today_; }
  TeachPage& teach() noexcept { return *teach_; }
  CheckPage& check() noexcept { return *check_; }
  QStringList pageNames() const;
  void showPage(const QString& name);  // one of pageNames(); another is ignored
  QString pageName() const;
  bool cancel();
  void settle();
  QSize sizeHint() const override { return {430, 560}; }

 signals:
  void said(const QString& text);
  void failed(const QString& message);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void add(QWidget* page, const QString& name, const QString& tip);

  QSettings& settings_;
  std::optional<Theme> theme_;
  RecogniseDesk* desk_;
  QWidget* header_;
  QButtonGroup* chooser_;
  QStackedWidget* pages_;
  TeachingDesk* teaching_;
  OpeningStrip* strip_;
  AskPage* ask_;
  TodayPage* today_;
  TeachPage* teach_;
  CheckPage* check_;
};

}  // namespace palpate::gui
