// Which kind of file: a row of buttons; those that the view can't be made into are grey and say
// why.
#pragma once

#include <QWidget>

#include "gui/export/export_request.h"
#include "gui/picture/exported_view.h"

class QButtonGroup;

namespace palpate::gui {

class ExportForms : public QWidget {
  Q_OBJECT
 public:
  explicit ExportForms(QWidget* parent = nullptr);

  ExportFormat chosen() const;
  void choose(ExportFormat form);
  // Leaves a form that isn't possible for PNG, or CSV where there is no picture.
  void use(const ExportedView& view);

 signals:
  void changed();

 private:
  QButtonGroup* buttons_;
};

}  // namespace palpate::gui
