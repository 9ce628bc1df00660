// Asks what shall be taken away, in which form and size, and where to; shows what it will look
// like.
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

class ExportForms;
class ExportMovieFields;
class ExportPlace;
class ExportPreview;

class ExportDialog : public QDialog {
  Q_OBJECT
 public:
  // views: at least one; they must outlive the dialog.
  ExportDialog(std::vector<const ExportedView*> views,
               const ExportRequest& suggestion,
               QWidget* parent = nullptr);

  ExportRequest request() const;
  // What stands in the way of it; empty: nothing.
  QString problem() const;

  ExportPlace& place() noexcept { return *place_; }

 public slots:
  // Only when it can be written.
  void accept() override;

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QWidget* makeForm();
  QWidget* makeSize();
  QWidget* makeFoot();
  void connectFields();
  const ExportedView& view() const;
  void fill(const ExportRequest& suggestion);
  void useView();
  void fillFrames();
  void usePreset();
  void suggestName();
  void refresh();
  void showProblem();

  std::vector<const ExportedView*> views_;
  ExportRequest first_;                         // what was suggested
  ExportFrames wanted_ = ExportFrames::kShown;  // where the form has them
  bool filling_ = false;                        // fields change by us
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
