// Groups of taxels with names ("thumb tip"), kept from one recording and one day to the next.
#pragma once

#include <QObject>
#include <QSettings>
#include <QString>
#include <optional>
#include <vector>

#include <palpate/model/taxel_selection.h>

namespace palpate::gui {

class TaxelGroups : public QObject {
  Q_OBJECT
 public:
  static constexpr int kMost = 200;
  static constexpr int kMaxNameLength = 60;

  explicit TaxelGroups(QSettings& settings, QObject* parent = nullptr);

  // Those that fit a sensor, in order of their names.
  struct Group {
    QString name;
    TaxelSelection taxels;
  };
  std::vector<Group> of(const SensorLayout& layout) const;
  // Under a name that is there already: replaces it. False: an empty name, no taxel, or too many
  // groups.
  bool keep(const QString& name, const TaxelSelection& taxels);
  bool rename(const QString& from, const QString& to);
  void forget(const QString& name);
  bool has(const QString& name) const;

 signals:
  void changed();

 private:
  struct Kept {
    QString name;
    QString text;  // TaxelSelection::text()
  };
  void store();

  QSettings& settings_;
  std::vector<Kept> kept_;
};

}  // namespace palpate::gui
