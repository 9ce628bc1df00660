// The content of the dock Recognise: pages that ask what is in the hand, adapt to today, teach, and check how well it goes.
#pragma once

#include <QSettings>
#include <QWidget>
#include <filesystem>
#include <optional>

#include "gui/recognise_desk.h"
#include "gui/theme.h"

class QButtonGroup;
class QStackedWidget;

namespace palpate::gui {

class AskPage;

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
  AskPage& ask() noexcept { return *ask_; }
  QStringList pageNames() const;
  void showPage(const QString& name);  // one of pageNames(); another is ignored
  QString pageName() const;
  bool cancel();
  void settle();
  QSize sizeHint() const override { return {430, 560}; }

 private:
  void add(QWidget* page, const QString& name, const QString& tip);

  QSettings& settings_;
  std::optional<Theme> theme_;
  RecogniseDesk* desk_;
  QWidget* header_;
  QButtonGroup* chooser_;
  QStackedWidget* pages_;
  AskPage* ask_;
};

}  // namespace palpate::gui
