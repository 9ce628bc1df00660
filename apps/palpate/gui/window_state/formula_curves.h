// Curves that the user has made by formulas (signals/formula.h), stored in the settings across
// recordings and sessions.
#pragma once

#include <QObject>
#include <QSettings>
#include <QString>
#include <optional>
#include <vector>

#include <palpate/model/profile.h>
#include <palpate/signals/profile_series.h>

namespace palpate::gui {

struct FormulaCurve {
  QString name;
  QString formula;
  // "counts/s"; may be empty.
  QString unit;
  bool operator==(const FormulaCurve&) const = default;

  SeriesChoice choice() const;
};

class FormulaCurves : public QObject {
  Q_OBJECT
 public:
  static constexpr std::size_t kMaximum = 100;
  static constexpr int kMaxNameLength = 60;

  explicit FormulaCurves(QSettings& settings, QObject* parent = nullptr);

  // In order of their names.
  const std::vector<FormulaCurve>& all() const noexcept { return kept_; }
  std::optional<FormulaCurve> named(const QString& name) const;
  // Stores a curve; one of the same name is replaced. False: empty name or formula, or too many
  // curves.
  bool keep(const FormulaCurve& curve);
  void forget(const QString& name);

 signals:
  void changed();

 private:
  void store();

  QSettings& settings_;
  std::vector<FormulaCurve> kept_;
};

// What is wrong with a formula for a recording, in one line; empty: nothing. `profile`: null when
// there is none; then only the text is checked.
QString problemOf(const QString& formula, const Profile* profile);

}  // namespace palpate::gui
