// The dialog Settings: how the window looks, where it writes, and what it remembers. Every change
// is told at once; Cancel tells what was chosen before.
#pragma once

#include <QDialog>
#include <QString>
#include <QStringList>
#include <array>
#include <functional>
#include <vector>

#include "gui/appearance/color_map.h"
#include "gui/appearance/display_units.h"
#include "gui/appearance/theme.h"
#include "gui/appearance/window_settings.h"

class QCheckBox;
class QComboBox;
class QDialogButtonBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QSpinBox;

namespace palpate::gui {

class Ask;

// What the dialog shows and changes.
struct WindowChoices {
  ThemeChoice theme = ThemeChoice::kSystem;
  int textPt = 0;  // [pt]; 0: as the desktop
  ColorMapName map = ColorMapName::kInferno;
  RangeMode range = RangeMode::kRecording;
  DisplayUnits units = {};
  // Absolute paths.
  QString recordings;
  QString exports;
  // Whether the next start opens what is open now.
  bool reopen = true;
  // What is forgotten when the window closes: names of kForgettable.
  QStringList forgotten;
  bool operator==(const WindowChoices&) const = default;
};

// Something that the window remembers and can forget.
struct Forgettable {
  // In the settings.
  const char* name;
  const char* text;
  const char* explanation;
  // The groups of keys that are removed; empty: all.
  std::vector<const char*> groups;
};
const std::vector<Forgettable>& forgettable();

class SettingsDialog : public QDialog {
  Q_OBJECT
 public:
  // `problemOf` says in one line why recordings can't be written to a folder; empty: they can.
  SettingsDialog(const WindowChoices& choices,
                 std::function<QString(const QString& folder)> problemOf,
                 Ask& ask,
                 QWidget* parent);

  WindowChoices choices() const;

  void reject() override;

 signals:
  // Only with folders that can be used.
  void changed(const palpate::gui::WindowChoices& choices);

 private:
  void addLook(QFormLayout& form);
  void addUnits(QFormLayout& form);
  void alignUnits();
  // To what its fields need at this size of text, within the screen.
  void grow();
  void addFolders(QFormLayout& form);
  void addMemory(QFormLayout& form);
  QLineEdit* addFolder(QFormLayout& form, const QString& label, const char* name);
  void fill(const WindowChoices& choices);
  void tell();

  const WindowChoices before_;
  std::function<QString(const QString&)> problemOf_;
  Ask& ask_;
  bool filling_ = false;
  QComboBox* theme_ = nullptr;
  QSpinBox* textPt_ = nullptr;
  QComboBox* map_ = nullptr;
  QComboBox* range_ = nullptr;
  QComboBox* angle_ = nullptr;
  QComboBox* temperature_ = nullptr;
  QComboBox* area_ = nullptr;
  QComboBox* pressure_ = nullptr;
  std::array<QLabel*, 2> unitTitles_ = {};
  QLineEdit* recordings_ = nullptr;
  QLineEdit* exports_ = nullptr;
  QLabel* problem_ = nullptr;
  QCheckBox* reopen_ = nullptr;
  std::vector<QCheckBox*> forgotten_;
  QDialogButtonBox* buttons_ = nullptr;
};

}  // namespace palpate::gui
