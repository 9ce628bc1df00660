#include "gui/hand/tactile_settings_panel.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <initializer_list>
#include <stdexcept>

#include <palpate/model/hand_description.h>

#include "gui/desktop/ask.h"
#include "gui/widgets/make.h"
#include "gui/widgets/text_fit.h"
#include "gui/widgets/value_slider.h"

namespace palpate::gui {
namespace {

// End of the slider of a threshold, as a part of full scale: 600 of 4095 counts.
constexpr double kMaxUsefulThreshold = 600.0 / 4095.0;
constexpr const char* kPick = "Saved settings…";

enum TactileSettingsPanelColumn { kSquare, kName, kSensitivity, kThreshold };

QLabel* tactileSettingsPanelCaption(const QString& text, QWidget* parent) {
  return makeLabel(parent, {}, "muted", text);
}

}  // namespace

TactileSettingsPanel::TactileSettingsPanel(QSettings& settings, Ask& ask, QWidget* parent)
    : QWidget(parent), settings_(settings), ask_(ask) {
  table_ = new QWidget(this);
  note_ = tactileSettingsPanelCaption({}, this);
  // Keeps room for one line, so that nothing moves when a note appears.
  note_->setMinimumHeight(fontMetrics().lineSpacing());
  setLayout(inColumn({table_, note_}));
  scanned_ = tactileSettingsPanelCaption({}, this);
  scanned_->setObjectName("scannedTaxels");
  scanned_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  makeButtons();
  setMatrices(movableHand());
  refresh({}, {});
}

void TactileSettingsPanel::makeTable() {
  auto* grid = new QGridLayout(table_);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(4);
  grid->addWidget(tactileSettingsPanelCaption("matrix", table_), 0, kName);
  grid->addWidget(tactileSettingsPanelCaption("sensitivity", table_), 0, kSensitivity);
  grid->addWidget(tactileSettingsPanelCaption("threshold, counts", table_), 0, kThreshold);
  grid->setColumnStretch(kSensitivity, 1);
  grid->setColumnStretch(kThreshold, 1);
}

void TactileSettingsPanel::setMatrices(const HandDescription& hand) {
  QStringList names;
  for (const MatrixDescription& matrix : hand.matrices)
    names.append(QString::fromStdString(matrix.shortName));
  const int fullScale = static_cast<int>(hand.maximumCounts);
  if (names == rowNames_ && fullScale == fullScale_) return;
  rowNames_ = names;
  fullScale_ = fullScale;
  rows_.clear();
  auto* old = table_;
  table_ = new QWidget(this);
  table_->setEnabled(old->isEnabled());
  makeTable();
  makeRow(0, "all");
  for (const QString& name : names) makeRow(static_cast<int>(rows_.size()), name);
  delete layout()->replaceWidget(old, table_);
  delete old;
  // The buttons follow the rows.
  QWidget* before = rows_.back().threshold;
  for (QWidget* each :
       std::initializer_list<QWidget*>{undo_, redo_, reset_, names_, save_, remove_}) {
    setTabOrder(before, each);
    before = each;
  }
}

void TactileSettingsPanel::makeRow(int row, const QString& name) {
  auto* grid = static_cast<QGridLayout*>(table_->layout());
  Row made{};
  made.square = new QLabel(table_);
  made.square->setFixedSize(10, 10);
  fitToTheme(*made.square, [square = made.square, row] {
    const QColor color = row == 0 ? wholeColor() : matrixColor(static_cast<std::size_t>(row - 1));
    square->setStyleSheet("background: " + color.name() + "; border-radius: 2px;");
  });
  made.sensitivity =
      new ValueSlider("Sensitivity of " + name, {0.0, 1.0, 1.0, 0.05, 2, {}}, table_);
  const double fullScale = fullScale_;
  made.threshold = new ValueSlider(
      "Threshold of " + name,
      {0.0, fullScale, std::round(fullScale * kMaxUsefulThreshold), 1.0, 0, {}, " counts"},
      table_);
  made.sensitivity->setObjectName("sensitivity" + QString::number(row - 1));
  made.threshold->setObjectName("threshold" + QString::number(row - 1));
  made.sensitivity->setToolTip("0 lowest .. 1 highest; factory setting 0.5");
  made.threshold->setToolTip("Readings below this are not sent [counts], 0.." +
                             QString::number(fullScale_));
  for (QWidget* field : {made.sensitivity->field(), made.threshold->field()})
    fitToText(*field, [field] {
      constexpr int kFrame = 20;
      const QFontMetrics metrics = field->fontMetrics();
      field->setFixedWidth(
          std::max(4 * metrics.horizontalAdvance('0'), metrics.horizontalAdvance("differ")) +
          kFrame);
    });
  grid->addWidget(made.square, row + 1, kSquare);
  made.name = new QLabel(name, table_);
  made.name->setObjectName("matrixName" + QString::number(row - 1));
  grid->addWidget(made.name, row + 1, kName);
  grid->addWidget(made.sensitivity, row + 1, kSensitivity);
  grid->addWidget(made.threshold, row + 1, kThreshold);
  const std::optional<int> matrix = row == 0 ? std::optional<int>() : std::optional<int>(row - 1);
  connect(made.sensitivity, &ValueSlider::chosen, this, [this, matrix](double value) {
    send({SetSensitivity{matrix, value}});
  });
  connect(made.threshold, &ValueSlider::chosen, this, [this, matrix](double value) {
    send({SetThreshold{matrix, static_cast<int>(value)}});
  });
  rows_.push_back(made);
}

void TactileSettingsPanel::makeButtons() {
  const auto button = [this](const QString& text, const char* name, const QString& tip) {
    auto* made = makeButton(this, name, text, tip);
    made->setFocusPolicy(Qt::TabFocus);
    return made;
  };
  reset_ = button(
      "Reset",
      "resetSettings",
      "Restore the factory settings: sensitivity 0.5, threshold 150 (proximal) and 300 (distal)");
  undo_ = button("Undo", "undoSettings", "Undo the last change");
  redo_ = button("Redo", "redoSettings", "Redo the undone change");
  static_cast<QBoxLayout*>(layout())->addLayout(inRow({{scanned_, 1}, undo_, redo_}));
  connect(undo_, &QPushButton::clicked, this, [this] { restore(true); });
  connect(redo_, &QPushButton::clicked, this, [this] { restore(false); });
  save_ = button("Save…", "saveSettings", "Save these values under a name, for this hand");
  remove_ = button("Delete", "removeSettings", "Delete the saved settings chosen above");
  names_ = named(new QComboBox(this), "savedSettings");
  static_cast<QBoxLayout*>(layout())->addLayout(inRow({reset_, {names_, 1}, save_, remove_}));
  connect(reset_, &QPushButton::clicked, this, [this] {
    if (session_) applySettings(defaultTactileSettings(session_->device().hand()));
  });
  connect(names_, &QComboBox::activated, this, [this](int index) {
    if (index <= 0) return;
    if (const auto values = saved().load(names_->currentText())) {
      applySettings(*values);
      names_->setCurrentIndex(index);
    } else
      emit refused("the settings '" + names_->currentText() + "' can't be read");
  });
  connect(save_, &QPushButton::clicked, this, [this] {
    if (!session_) return;
    const QString before = names_->currentIndex() > 0 ? names_->currentText() : QString();
    const QString name = ask_.text("Save settings", "Name", before).value_or(QString());
    if (name.isEmpty()) return;
    if (names_->findText(name, Qt::MatchExactly | Qt::MatchCaseSensitive) > 0 &&
        !ask_.confirmed("Replace the settings \"" + name + "\" with the current ones?", "Replace"))
      return;
    saved().save(name, session_->device().info().matrices);
    listNames();
    names_->setCurrentText(name);
  });
  connect(remove_, &QPushButton::clicked, this, [this] {
    if (names_->currentIndex() <= 0 ||
        !ask_.confirmed("Delete the settings \"" + names_->currentText() + "\"?", "Delete"))
      return;
    saved().remove(names_->currentText());
    listNames();
  });
}

void TactileSettingsPanel::setHand(CaptureSession* session, GraspControl* control) {
  session_ = session;
  control_ = control;
  pending_.clear();
  history_.clear();
  showScanned(nullptr);
  listedFor_ = QString();
  listNames();
  refresh(control ? control->status() : GraspStatus{},
          session ? session->device().info() : DeviceInfo{});
}

QString TactileSettingsPanel::serial() const {
  return session_ ? QString::fromStdString(session_->device().info().serial) : QString();
}

NamedItems<TactileSettings> TactileSettingsPanel::saved() const {
  const QString hand = serial().isEmpty() ? "unknown" : serial();
  return {settings_, "hands/" + keyPartOf(hand) + "/settings", toJson, parseTactileSettings};
}

void TactileSettingsPanel::listNames() {
  names_->clear();
  names_->addItem(kPick);
  listedFor_ = serial();
  if (session_) names_->addItems(saved().names());
}

void TactileSettingsPanel::send(const std::vector<DeviceCommand>& commands) {
  if (!control_) return;
  // What is set now is no longer what was saved under the chosen name.
  names_->setCurrentIndex(0);
  if (commands.empty()) return;
  if (!restoring_) keepForUndo();
  emit changedByHand();
  try {
    for (const DeviceCommand& command : commands) pending_.push_back(control_->change(command));
  } catch (const std::exception& error) {
    emit refused(error.what());
  }
}

void TactileSettingsPanel::applySettings(const TactileSettings& to) {
  if (!session_) return;
  try {
    send(commandsBetween(session_->device().info().matrices, to));
  } catch (const std::invalid_argument& error) {
    emit refused(error.what());
  }
}

void TactileSettingsPanel::keepForUndo() {
  // Until the answers are there, the settings are those of a change that is only half done.
  if (session_ && pending_.empty()) history_.changing(session_->device().info().matrices);
}

void TactileSettingsPanel::restore(bool undo) {
  if (!session_ || !pending_.empty()) return;
  const TactileSettings now = session_->device().info().matrices;
  const auto wanted = undo ? history_.undo(now) : history_.redo(now);
  if (!wanted) return;
  restoring_ = true;
  applySettings(*wanted);
  restoring_ = false;
}

void TactileSettingsPanel::showScanned(const std::shared_ptr<const SensorLayout>& layout) {
  if (layout == layout_ && (layout || scanned_->text().isEmpty())) return;
  layout_ = layout;
  QString text;
  QStringList each;
  if (layout) {
    std::size_t scanned = 0;
    QStringList blind;
    for (std::size_t m = 0; m < layout->numMatrices(); ++m) {
      const MatrixLayout& matrix = layout->matrix(m);
      const QString name = m < static_cast<std::size_t>(rowNames_.size())
                               ? rowNames_[static_cast<qsizetype>(m)]
                               : QString::number(m);
      scanned += matrix.numEnabled();
      if (matrix.numEnabled() == 0) blind += name;
      each += name + ": " + QString::number(matrix.numEnabled()) + " of " +
              QString::number(matrix.numTaxels());
    }
    text = QString("%1 of %2 taxels scanned").arg(scanned).arg(layout->numTaxels());
    if (!blind.isEmpty()) text += "; blind: " + blind.join(", ");
  }
  scanned_->setText(text);
  scanned_->setToolTip(text.isEmpty() ? QString() : text + "\n" + each.join("\n"));
}

void TactileSettingsPanel::pollReplies() {
  const auto isReady = [](const auto& answer) {
    return answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  };
  for (const auto& answer : pending_) {
    if (!isReady(answer)) continue;
    try {
      answer.get();
    } catch (const std::exception& error) {
      emit refused(error.what());
    }
  }
  std::erase_if(pending_, isReady);
}

void TactileSettingsPanel::refresh(const GraspStatus& status, const DeviceInfo& info) {
  pollReplies();
  const TactileSettings& values = info.matrices;
  QString why;
  if (!session_)
    why = "No hand is connected.";
  else if (values.empty())
    why = "No tactile controller is connected: there is nothing to set.";
  else if (!status.cannotChange.empty())
    why = "Not now: " + QString::fromStdString(status.cannotChange) + ".";
  else if (!pending_.empty())
    why = "The settings are being changed: no frames for half a second.";
  const bool may = why.isEmpty() || !pending_.empty();
  if (why.isEmpty()) why = unmeasurableText_;
  if (note_->text() != why) note_->setText(why);
  table_->setEnabled(may);
  reset_->setEnabled(may);
  const bool settled = may && pending_.empty();
  undo_->setEnabled(settled && history_.canUndo(values));
  redo_->setEnabled(settled && history_.canRedo(values));
  names_->setEnabled(may && names_->count() > 1);
  save_->setEnabled(may);
  remove_->setEnabled(may && names_->currentIndex() > 0);
  if (listedFor_ != QString::fromStdString(info.serial)) listNames();
  if (pending_.empty() && !values.empty()) showValues(values);
  if (values.empty())
    for (const Row& row : rows_) {
      row.sensitivity->showUnknown();
      row.threshold->showUnknown();
    }
}

void TactileSettingsPanel::showValues(const TactileSettings& values) {
  const std::size_t matrices = std::min(values.size(), rows_.size() - 1);
  for (std::size_t m = 0; m < matrices; ++m) {
    rows_[m + 1].sensitivity->showValue(values[m].sensitivity);
    rows_[m + 1].threshold->showValue(values[m].thresholdCounts);
  }
  const auto showAll = [&](ValueSlider& slider, const auto& valueOf) {
    const bool same = std::all_of(values.begin(), values.end(), [&](const MatrixSettings& each) {
      return valueOf(each) == valueOf(values[0]);
    });
    if (same)
      slider.showValue(valueOf(values[0]));
    else
      slider.showDiffering();
  };
  showAll(*rows_[0].sensitivity, [](const MatrixSettings& each) { return each.sensitivity; });
  showAll(*rows_[0].threshold,
          [](const MatrixSettings& each) { return static_cast<double>(each.thresholdCounts); });
}

void TactileSettingsPanel::showUnmeasurable(const std::vector<QString>& why, int limitCounts) {
  int unmeasurable = 0;
  for (std::size_t m = 0; m + 1 < rows_.size(); ++m) {
    const QString reason = m < why.size() ? why[m] : QString();
    unmeasurable += reason.isEmpty() ? 0 : 1;
    QLabel* name = rows_[m + 1].name;
    if (name->toolTip() != reason) name->setToolTip(reason);
    const QString style = reason.isEmpty()
                              ? QString()
                              : "color: " + colorsOf().danger.name() + "; font-weight: bold;";
    if (name->styleSheet() != style) name->setStyleSheet(style);
  }
  unmeasurableText_ = unmeasurable == 0
                          ? QString()
                          : "A limit of " + QString::number(limitCounts) +
                                " counts is never reached by " + QString::number(unmeasurable) +
                                (unmeasurable == 1 ? " matrix (red)." : " matrices (red).");
}

}  // namespace palpate::gui
