#include "gui/help/help_feature.h"

#include <QDialogButtonBox>
#include <QLabel>
#include <QVBoxLayout>

#include <Eigen/Core>

#include "gui/chart/plot.h"
#include "gui/help/keys_dialog.h"

namespace palpate::gui {

QString AboutDialog::text() {
  const QString eigen = QString("%1.%2.%3")
                            .arg(EIGEN_WORLD_VERSION)
                            .arg(EIGEN_MAJOR_VERSION)
                            .arg(EIGEN_MINOR_VERSION);
  return QString(
             "<h2>Palpate %1</h2>"
             "<p>A workbench for tactile robot hands: shows the pressure on the fingers of a "
             "SCHUNK SDH-2, frame by frame.</p>"
             "<p>Free software under the GNU General Public License, version 3 or later, without "
             "any warranty; the file LICENSE has the text.</p>"
             "<p>Built with Qt %2, QCustomPlot %3, OpenCV (colour maps) and Eigen %4.</p>")
      .arg(PALPATE_VERSION, qVersion(), QCUSTOMPLOT_VERSION_STR, eigen);
}

AboutDialog::AboutDialog(QWidget* parent) : QDialog(parent) {
  setWindowTitle("About Palpate");
  auto* label = new QLabel(text(), this);
  label->setWordWrap(true);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  label->setMinimumWidth(420);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* page = new QVBoxLayout(this);
  page->setContentsMargins(20, 8, 20, 14);
  page->addWidget(label);
  page->addWidget(buttons);
}

HelpFeature::HelpFeature(WindowState& windowState, QWidget* window) : Feature(windowState, window) {
  QAction* keys = windowState.actions.make("keys", "Help", "&Keys", {key("F1")});
  QAction* about = windowState.actions.make("about", "Help", "&About Palpate");
  windowState.actions.setIcon(keys, IconShape::kHelp);
  on(keys, [window] {
    auto* dialog = new KeysDialog(window->actions(), window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->show();
  });
  on(about, [window] {
    auto* dialog = new AboutDialog(window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->show();
  });
}

}  // namespace palpate::gui
