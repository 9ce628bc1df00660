#include "gui/settings/settings_dialog.h"

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileInfo>
#include <QFontInfo>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScreen>
#include <QSpinBox>
#include <QTimer>
#include <algorithm>
#include <cmath>

#include "gui/appearance/captions.h"
#include "gui/appearance/text_size.h"
#include "gui/desktop/ask.h"
#include "gui/source/recording_settings.h"
#include "gui/widgets/content_scroll.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

constexpr int kSettingsWidth = 560;   // [px]
constexpr int kSettingsBetween = 14;  // [px] between fields and their titles
constexpr int kSettingsFrame = 60;    // [px] of the window manager and of a panel

// Of all choices, the index of one.
template <class Choices, class Choice>
int indexOf(const Choices& all, Choice wanted) {
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i] == wanted) return static_cast<int>(i);
  return 0;
}

QString problemOfExports(const QString& folder) {
  if (!QDir::isAbsolutePath(folder)) return "The folder of exports isn't an absolute path";
  const QFileInfo info(folder);
  if (!info.isDir()) return "There is no folder " + folder + "; choose another one for exports";
  if (!info.isWritable())
    return "You have no permission to write to " + folder + "; choose another folder for exports";
  return {};
}

// Its smallest value stands for the size of the desktop, and steps go on from that size.
class TextSizeField : public QSpinBox {
 public:
  using QSpinBox::QSpinBox;
  void stepBy(int steps) override {
    const double desktopPt = QFontInfo(QApplication::font()).pointSizeF() / textScale();
    if (value() == minimum() && steps > 0)
      setValue(static_cast<int>(std::lround(desktopPt)) + steps);
    else
      QSpinBox::stepBy(steps);
  }
};

}  // namespace

const std::vector<Forgettable>& forgettable() {
  static const std::vector<Forgettable> all = {
      {"recent",
       "Recent recordings",
       "The list of the start page and of the menu File",
       {"recent"}},
      {"session",
       "Open recordings",
       "Which recordings are open, and the position and view in each",
       {"session"}},
      {"window", "Arrangement", "Size of the window, places of its docks and views", {"window"}},
      {"connection",
       "Connection",
       "Ports, stream and scene that were connected last",
       {"connection"}},
      {"everything",
       "Everything",
       "All settings of the window, also calibrations and groups of taxels; the next start is like "
       "the first one. Recordings and other files are kept",
       {}}};
  return all;
}

SettingsDialog::SettingsDialog(const WindowChoices& choices,
                               std::function<QString(const QString&)> problemOf,
                               Ask& ask,
                               QWidget* parent)
    : QDialog(parent), before_(choices), problemOf_(std::move(problemOf)), ask_(ask) {
  setWindowTitle("Settings");
  auto* fields = new QWidget;
  auto* form = new QFormLayout(fields);
  form->setContentsMargins(0, 0, 0, 0);
  form->setHorizontalSpacing(kSettingsBetween);
  form->setVerticalSpacing(8);
  addLook(*form);
  addUnits(*form);
  addFolders(*form);
  addMemory(*form);
  buttons_ = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  connect(buttons_, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons_, &QDialogButtonBox::rejected, this, &SettingsDialog::reject);
  // With large text on a small screen the fields scroll: OK and Cancel stay in reach.
  constexpr int kMinHeight = 160;  // [px]
  setLayout(inColumn({{new ContentScroll(fields, QSize(0, kMinHeight)), 1}, buttons_},
                     Space::kWide,
                     around(Space::kDialog)));
  fill(choices);
  resize(kSettingsWidth, 0);
  grow();
}

void SettingsDialog::grow() {
  const QSize most = screen()->availableSize() - QSize(0, kSettingsFrame);
  resize(size().expandedTo(sizeHint()).boundedTo(most));
}

void SettingsDialog::addLook(QFormLayout& form) {
  form.addRow(sectionHeading("Look", this));
  theme_ = named(new QComboBox(this), "settingsTheme");
  theme_->addItems({"as the desktop", "dark", "light"});
  form.addRow("&Theme", theme_);
  textPt_ = named(new TextSizeField(this), "settingsTextPt");
  // The value below the least one stands for the desktop's size.
  textPt_->setRange(kMinInterfaceTextPt - 1, kMaxInterfaceTextPt);
  textPt_->setSpecialValueText("as the desktop");
  textPt_->setSuffix(" pt");
  textPt_->setToolTip("Size of all text, 7 to 18 pt");
  form.addRow("Te&xt size", textPt_);
  map_ = named(new QComboBox(this), "settingsMap");
  for (const ColorMapName map : kAllColorMaps) map_->addItem(nameOf(map));
  form.addRow("&Colour map", map_);
  range_ = named(new QComboBox(this), "settingsRange");
  for (const RangeMode mode : kAllRangeModes) range_->addItem(nameOf(mode));
  range_->setToolTip("Upper end of the colour range of the heat maps");
  form.addRow("Colour ran&ge", range_);
  for (QComboBox* box : {theme_, map_, range_})
    connect(box, &QComboBox::currentIndexChanged, this, &SettingsDialog::tell);
  connect(textPt_, &QSpinBox::valueChanged, this, &SettingsDialog::tell);
}

void SettingsDialog::addUnits(QFormLayout& form) {
  form.addRow(sectionHeading("Units", this));
  const auto box = [this](const char* name, const QStringList& units, const QString& tip) {
    auto* made = named(new QComboBox(this), name, tip);
    made->addItems(units);
    connect(made, &QComboBox::currentIndexChanged, this, &SettingsDialog::tell);
    return made;
  };
  // Two in a row.
  const auto add =
      [this, &form](
          const QString& left, QComboBox* leftBox, const QString& right, QComboBox* rightBox) {
        auto* rightTitle = makeTitle(right, rightBox);
        auto* row = inRow({{leftBox, 1}, rightTitle, {rightBox, 1}}, Space::kWide);
        form.addRow(makeTitle(left, leftBox), row);
        return rightTitle;
      };
  angle_ = box("settingsAngle",
               {"degrees, °", "radians, rad"},
               "Joint angles, where they are only shown; targets of a motion stay in degrees");
  temperature_ = box("settingsTemperature",
                     {"Celsius, °C", "kelvin, K"},
                     "Temperatures of the hand, where they are only shown");
  area_ = box("settingsArea", {"mm²", "cm²"}, "Areas of contact");
  pressure_ = box("settingsPressure",
                  {"kPa", "N/cm²"},
                  "Pressures that Palpate computes with a calibration; values that a hand measures "
                  "keep the unit of its description");
  unitTitles_ = {add("A&ngles", angle_, "Te&mperatures", temperature_),
                 add("&Areas", area_, "&Pressures", pressure_)};
  alignUnits();
  auto* note =
      makeLines(this,
                "settingsUnitsNote",
                "muted",
                "Only what is shown: motions, files and command lines keep °, °C, mm² and kPa.");
  form.addRow(note);
}

// The right fields of both rows stand below each other.
void SettingsDialog::alignUnits() {
  int widest = 0;
  for (const QLabel* title : unitTitles_) widest = std::max(widest, title->sizeHint().width());
  for (QLabel* title : unitTitles_) title->setMinimumWidth(widest);
}

QLineEdit* SettingsDialog::addFolder(QFormLayout& form, const QString& label, const char* name) {
  auto* field = named(new QLineEdit(this), name);
  auto* browse = makeButton(this, {}, "Browse…");
  browse->setAccessibleName("Browse for the folder of " + QString(label).remove('&').toLower());
  auto* row = inRow({{field, 1}, browse});
  form.addRow(makeTitle(label, field), row);
  connect(browse, &QPushButton::clicked, this, [this, field, label] {
    const QString chosen =
        ask_.folder("Folder of " + QString(label).remove('&').toLower(), field->text());
    if (!chosen.isEmpty()) field->setText(chosen);
  });
  connect(field, &QLineEdit::textChanged, this, &SettingsDialog::tell);
  return field;
}

void SettingsDialog::addFolders(QFormLayout& form) {
  form.addRow(sectionHeading("Folders", this));
  recordings_ = addFolder(form, "&Recordings", "settingsRecordings");
  recordings_->setToolTip(
      "Where new recordings are written; the folder is created when it is needed");
  exports_ = addFolder(form, "&Exports", "settingsExports");
  exports_->setToolTip("Where pictures, movies and tables are written");
  problem_ = makeLines(this, "settingsProblem", "problem");
  form.addRow(problem_);
}

void SettingsDialog::addMemory(QFormLayout& form) {
  form.addRow(sectionHeading("Memory", this));
  reopen_ =
      named(new QCheckBox("At the &start, open the recordings that were open last time", this),
            "settingsReopen");
  form.addRow(reopen_);
  connect(reopen_, &QCheckBox::toggled, this, &SettingsDialog::tell);
  form.addRow(new QLabel("Forget when the window closes:", this));
  for (const Forgettable& each : forgettable()) {
    auto* box = named(
        new QCheckBox(each.text, this), QString("settingsForget_") + each.name, each.explanation);
    form.addRow(box);
    connect(box, &QCheckBox::toggled, this, &SettingsDialog::tell);
    forgotten_.push_back(box);
  }
}

void SettingsDialog::fill(const WindowChoices& choices) {
  filling_ = true;
  theme_->setCurrentIndex(indexOf(kAllThemeChoices, choices.theme));
  textPt_->setValue(choices.textPt > 0 ? choices.textPt : kMinInterfaceTextPt - 1);
  map_->setCurrentIndex(indexOf(kAllColorMaps, choices.map));
  range_->setCurrentIndex(indexOf(kAllRangeModes, choices.range));
  angle_->setCurrentIndex(indexOf(kAllAngleUnits, choices.units.angle));
  temperature_->setCurrentIndex(indexOf(kAllTemperatureUnits, choices.units.temperature));
  area_->setCurrentIndex(indexOf(kAllAreaUnits, choices.units.area));
  pressure_->setCurrentIndex(indexOf(kAllPressureUnits, choices.units.pressure));
  recordings_->setText(choices.recordings);
  exports_->setText(choices.exports);
  reopen_->setChecked(choices.reopen);
  for (std::size_t i = 0; i < forgotten_.size(); ++i)
    forgotten_[i]->setChecked(choices.forgotten.contains(forgettable()[i].name));
  filling_ = false;
}

WindowChoices SettingsDialog::choices() const {
  WindowChoices choices;
  choices.theme = kAllThemeChoices.at(static_cast<std::size_t>(theme_->currentIndex()));
  choices.textPt = textPt_->value() < kMinInterfaceTextPt ? 0 : textPt_->value();
  choices.map = kAllColorMaps.at(static_cast<std::size_t>(map_->currentIndex()));
  choices.range = kAllRangeModes.at(static_cast<std::size_t>(range_->currentIndex()));
  const auto chosen = [](const auto& all, const QComboBox* box) {
    return all.at(static_cast<std::size_t>(box->currentIndex()));
  };
  choices.units = {.angle = chosen(kAllAngleUnits, angle_),
                   .temperature = chosen(kAllTemperatureUnits, temperature_),
                   .area = chosen(kAllAreaUnits, area_),
                   .pressure = chosen(kAllPressureUnits, pressure_)};
  choices.recordings = folderFromText(recordings_->text());
  choices.exports = folderFromText(exports_->text());
  choices.reopen = reopen_->isChecked();
  for (std::size_t i = 0; i < forgotten_.size(); ++i)
    if (forgotten_[i]->isChecked()) choices.forgotten.append(forgettable()[i].name);
  return choices;
}

void SettingsDialog::tell() {
  if (filling_) return;
  const WindowChoices now = choices();
  // What stood there before is no mistake of the user.
  QString problem;
  if (now.recordings != before_.recordings) problem = problemOf_(now.recordings);
  if (problem.isEmpty() && now.exports != before_.exports) problem = problemOfExports(now.exports);
  problem_->setText(problem);
  buttons_->button(QDialogButtonBox::Ok)->setEnabled(problem.isEmpty());
  if (problem.isEmpty()) emit changed(now);
  // The size of text may be another one now.
  alignUnits();
  QTimer::singleShot(0, this, &SettingsDialog::grow);  // once the layout knows the new size
}

void SettingsDialog::reject() {
  emit changed(before_);
  QDialog::reject();
}

}  // namespace palpate::gui
