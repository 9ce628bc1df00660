#include "gui/help/help_feature.h"

#include <QDialogButtonBox>
#include <QLabel>
#include <QVBoxLayout>
#include <QWhatsThis>

#include <Eigen/Core>

#include "gui/appearance/icons.h"
#include "gui/chart/plot.h"
#include "gui/help/keys_dialog.h"
#include "gui/help/manual_window.h"
#include "gui/help/whats_this.h"

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
  QAction* manual = windowState.actions.make("manual", "Help", "&Manual", {key("Ctrl+F1")});
  QAction* what = windowState.actions.make("whatsThis", "Help", "&What's this?", {key("Shift+F1")});
  QAction* about = windowState.actions.make("about", "Help", "&About Palpate");
  keys->setIcon(makeIcon(IconShape::kHelp));
  on(keys, [window] {
    auto* dialog = new KeysDialog(window->actions(), window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->show();
  });
  on(manual, [this] { showManual(); });
  on(what, [] { QWhatsThis::enterWhatsThisMode(); });
  new WhatsThis(
      [pages = std::make_shared<ManualPages>(
           ManualPages::folderFor(windowState.environment.dataFolder))](const QString& dock) {
        const QString anchor = ManualPages::anchorOf(dock);
        const QString text = pages->firstParagraph("manual/docks.md", anchor);
        return text.isEmpty() ? text : text + "\nMore: docks.md#" + anchor;
      },
      [this](const QString& link) {
        showManual();
        manual_->follow(link);
      },
      this);
  on(about, [window] {
    auto* dialog = new AboutDialog(window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->show();
  });
}

void HelpFeature::showManual() {
  if (!manual_) {
    manual_ = new ManualWindow(ManualPages::folderFor(state().environment.dataFolder), window());
    manual_->setAttribute(Qt::WA_DeleteOnClose);
  }
  manual_->QWidget::show();
  manual_->raise();
  manual_->activateWindow();
}

}  // namespace palpate::gui
