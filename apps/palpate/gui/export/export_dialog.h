// The Export dialog: the user chooses a view, a file form, a size and a destination; a preview
// shows the result.
#pragma once

#include <QDialog>
#include <vector>

#include "gui/export/export_request.h"
#include "gui/picture/exported_view.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QPushButton;

namespace palpate::gui {

class Ask;
class ExportForms;
class ExportMovieFields;
class ExportPlace;
class ExportPreview;

class ExportDialog : public QDialog {
  Q_OBJECT
 public:
  // `views` has at least one element; the views must outlive the dialog.
  ExportDialog(std::vector<const ExportedView*> views,
               const ExportRequest& suggestion,
               Ask& ask,
               QWidget* parent = nullptr);

  ExportRequest request() const;
  // Why the request cannot be written; empty when it can.
  QString problem() const;

 public slots:
  // Closes the dialog only when the request can be written.
  void accept() override;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QWidget* makeForm(Ask& ask);
  QWidget* makeSize();
  QWidget* makeFoot();
  void connectFields();
  const ExportedView& view() const;
  void fill(const ExportRequest& suggestion);
  void useView();
  void fillFrames();
  void usePreset();
  void showSize(const ExportSize& size);
  void suggestName();
  void refresh();
  void showProblem();

  std::vector<const ExportedView*> views_;
  // The suggested request.
  ExportRequest first_;
  // The frames that the user chose; used where the form offers them.
  ExportFrames wanted_ = ExportFrames::kShown;
  // The dialog itself changes the fields, so that their signals are ignored.
  bool filling_ = false;
  // The user has chosen a size in this dialog; it holds for all views.
  bool sizeIsChosen_ = false;
  QFormLayout* fields_ = nullptr;
  QComboBox* view_ = nullptr;
  ExportForms* form_ = nullptr;
  QComboBox* frames_ = nullptr;
  QComboBox* table_ = nullptr;
  QComboBox* preset_ = nullptr;
  QWidget* size_ = nullptr;
  QDoubleSpinBox* width_ = nullptr;
  QDoubleSpinBox* height_ = nullptr;
  QDoubleSpinBox* text_ = nullptr;
  QComboBox* dpi_ = nullptr;
  QComboBox* colors_ = nullptr;
  ExportMovieFields* movie_ = nullptr;
  QCheckBox* titled_ = nullptr;
  ExportPlace* place_ = nullptr;
  ExportPreview* preview_ = nullptr;
  QLabel* summary_ = nullptr;
  QLabel* target_ = nullptr;
  QLabel* problem_ = nullptr;
  QCheckBox* replace_ = nullptr;
  QPushButton* ok_ = nullptr;
};

}  // namespace palpate::gui
