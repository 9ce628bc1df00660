// The content of the dock Recognise: the pages Ask, Today, Teach, Grasps and Check.
#pragma once

#include <filesystem>
#include <optional>

#include "gui/appearance/theme.h"
#include "gui/recognise/recognition_controller.h"
#include "gui/recognise/training_controller.h"
#include "gui/widgets/paged_panel.h"

namespace palpate::gui {

class Ask;
class AskPage;
class CheckPage;
class GraspsPage;
class OpeningStrip;
class TrainingPage;
class TodayPage;

class RecognisePanel : public PagedPanel {
  Q_OBJECT
 public:
  RecognisePanel(QSettings& settings,
                 const std::filesystem::path& dataFolder,
                 Ask& ask,
                 QWidget* parent = nullptr);

  RecognitionController& controller() noexcept { return *controller_; }
  TrainingController& teaching() noexcept { return *teaching_; }
  AskPage& ask() noexcept { return *ask_; }
  TodayPage& today() noexcept { return *today_; }
  TrainingPage& teach() noexcept { return *teach_; }
  GraspsPage& grasps() noexcept { return *grasps_; }
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
  RecognitionController* controller_;
  TrainingController* teaching_;
  OpeningStrip* strip_;
  AskPage* ask_;
  TodayPage* today_;
  TrainingPage* teach_;
  GraspsPage* grasps_;
  CheckPage* check_;
};

}  // namespace palpate::gui
