// A row of buttons of the Export dialog that chooses the kind of file. Kinds that the view does not
// support are grey; their tool tips tell why.
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
  // Disables what `view` does not support. If the chosen form is not possible, PNG is chosen, or
  // CSV for a view without a picture.
  void use(const ExportedView& view);

 signals:
  void changed();

 private:
  QButtonGroup* buttons_;
};

}  // namespace palpate::gui
