// Named groups of taxels ("thumb tip"), stored in the settings across recordings and sessions.
#pragma once

#include <QObject>
#include <QSettings>
#include <QString>
#include <vector>

#include <palpate/model/taxel_selection.h>

namespace palpate::gui {

class TaxelGroups : public QObject {
  Q_OBJECT
 public:
  static constexpr int kMaximum = 200;
  static constexpr int kMaxNameLength = 60;

  explicit TaxelGroups(QSettings& settings, QObject* parent = nullptr);

  // The groups that fit a sensor layout, in order of their names.
  struct Group {
    QString name;
    TaxelSelection taxels;
  };
  std::vector<Group> of(const SensorLayout& layout) const;
  // Stores a group; a group of the same name is replaced. False: empty name, no taxel, or too many
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
