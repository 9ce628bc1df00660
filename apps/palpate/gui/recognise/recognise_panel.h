// The content of the dock Recognise: pages that ask what is in the hand, adapt to today, teach, and
// check how well it goes.
#pragma once

#include <filesystem>
#include <optional>

#include "gui/look/theme.h"
#include "gui/recognise/recognise_desk.h"
#include "gui/recognise/teaching_desk.h"
#include "gui/widgets/paged_panel.h"

namespace palpate::gui {

class AskPage;
class CheckPage;
class OpeningStrip;
class TeachPage;
class TodayPage;

class RecognisePanel : public PagedPanel {
  Q_OBJECT
 public:
  RecognisePanel(QSettings& settings,
                 const std::filesystem::path& dataFolder,
                 QWidget* parent = nullptr);
  void setTheme(Theme theme);

  RecogniseDesk& desk() noexcept { return *desk_; }
  TeachingDesk& teaching() noexcept { return *teaching_; }
  AskPage& ask() noexcept { return *ask_; }
  TodayPage& today() noexcept { return *today_; }
  TeachPage& teach() noexcept { return *teach_; }
  CheckPage& check() noexcept { return *check_; }
  bool cancel();
  void settle();
  QSize sizeHint() const override { return {430, 560}; }

 signals:
  void said(const QString& text);
  void failed(const QString& message);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  std::optional<Theme> theme_;
  RecogniseDesk* desk_;
  TeachingDesk* teaching_;
  OpeningStrip* strip_;
  AskPage* ask_;
  TodayPage* today_;
  TeachPage* teach_;
  CheckPage* check_;
};

}  // namespace palpate::gui
