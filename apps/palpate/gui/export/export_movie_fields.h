// The fields of the Export dialog for a movie: its speed, its pictures per second and its height.
#pragma once

#include <QObject>

#include "gui/export/export_request.h"

class QComboBox;
class QFormLayout;
class QWidget;

namespace palpate::gui {

class ExportMovieFields : public QObject {
  Q_OBJECT
 public:
  // Adds its rows to `form`.
  explicit ExportMovieFields(QFormLayout& form);

  void fill(const ExportRequest& request);
  void read(ExportRequest& request) const;
  void setVisible(bool on);

 signals:
  void changed();

 private:
  QFormLayout& form_;
  QWidget* pace_;
  QComboBox* speed_;
  QComboBox* rate_;
  QComboBox* height_;
};

}  // namespace palpate::gui
