#include "gui/hand3d/hand_panel.h"

#include <QAction>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QSignalBlocker>
#include <QToolButton>
#include <algorithm>

#include <palpate/core/error.h>

#include "gui/widgets/fitting_row.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

template <class All, class Value>
int handPanelIndexOf(const All& all, Value value) {
  return static_cast<int>(std::find(all.begin(), all.end(), value) - all.begin());
}

// Points of the hand at the first, the last and the strongest frame of a recording, for the first
// view.
std::vector<Eigen::Vector3d> handPanelExtentOf(const OpenedRecording& recording,
                                               const HandLook& look) {
  std::vector<Eigen::Vector3d> points;
  const Profile& profile = recording.profile;
  if (profile.numFrames() == 0) return points;
  HandSceneBuilder drawing;
  // Without the bodies that files describe, which are read later.
  drawing.setHand(profile.hand(), false);
  for (const std::size_t frame :
       {std::size_t{0}, recording.table.frameOfLargestSum(), profile.numFrames() - 1}) {
    try {
      const auto angles = profile.anglesAtFrame(frame);
      drawing.setMoment(profile.frame(frame), angles ? angles->values : std::vector<double>());
    } catch (const Error&) {
      // The frame is damaged; that is reported when it is shown.
      continue;
    }
    const auto now = drawing.extent(look);
    points.insert(points.end(), now.begin(), now.end());
  }
  return points;
}

}  // namespace

HandPanel::HandPanel(const QList<QAction*>& shown, QWidget* parent) : QWidget(parent) {
  auto* header = named(new FittingRow(this), "ViewHeader");
  header->setAttribute(Qt::WA_StyledBackground);
  const auto box = [header](const char* name, const char* tip) {
    auto* made = named(new QComboBox(header), name);
    made->setFocusPolicy(Qt::NoFocus);  // has a shortcut instead
    made->setToolTip(tip);
    made->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    return made;
  };
  taxels_ = box("taxelShapeBox", "How taxels are drawn");
  for (const TaxelShape shape : kAllTaxelShapes) taxels_->addItem(nameOf(shape));
  spheres_ = box("sphereBox", "The enclosing sphere");
  for (const SphereLook look : kAllSphereLooks) spheres_->addItem(nameOf(look));
  matrix_ = box("onlyMatrixBox", "One matrix alone (Alt+1, Alt+2, ..; Alt+0: the whole hand)");
  auto* more = makeToolButton(header, "handShowButton", "Show", "What else is shown");
  more->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(more);
  menu->addActions(shown);
  more->setMenu(menu);

  QHBoxLayout& row = header->row();
  row.setContentsMargins(12, 4, 10, 4);
  row.setSpacing(6);
  row.addWidget(new QLabel("<b>Hand</b>", header));
  row.addStretch(1);
  row.addWidget(taxels_);
  row.addWidget(spheres_);
  row.addWidget(matrix_);
  row.addWidget(more);
  // The menu View, Hand in 3-D has all of them, too.
  header->setOptional({spheres_, taxels_, matrix_});

  view_ = named(new HandView(this), "handView");
  setLayout(inColumn({header, {view_, 1}}, Space::kNone));

  const auto chosen = [this](auto change) {
    HandLook look = view_->look();
    change(look);
    emit lookChosen(look);
  };
  connect(taxels_, &QComboBox::activated, this, [chosen](int index) {
    chosen(
        [&](HandLook& look) { look.taxels = kAllTaxelShapes.at(static_cast<std::size_t>(index)); });
  });
  connect(spheres_, &QComboBox::activated, this, [chosen](int index) {
    chosen(
        [&](HandLook& look) { look.sphere = kAllSphereLooks.at(static_cast<std::size_t>(index)); });
  });
  connect(matrix_, &QComboBox::activated, this, [chosen](int index) {
    chosen([&](HandLook& look) {
      look.only.reset();
      if (index > 0) look.only = static_cast<std::size_t>(index - 1);
    });
  });
}

void HandPanel::listMatrices(const HandDescription& hand) {
  const QSignalBlocker blocked(matrix_);
  matrix_->clear();
  matrix_->addItem("whole hand");
  for (const MatrixDescription& matrix : hand.matrices)
    matrix_->addItem(QString::fromStdString(matrix.shortName));
  HandLook look = view_->look();
  if (look.only && *look.only >= hand.layout->numMatrices()) {
    look.only.reset();
    emit lookChosen(look);
  }
  matrix_->setCurrentIndex(look.only ? static_cast<int>(*look.only) + 1 : 0);
}

void HandPanel::setRecording(const OpenedRecordingPtr& recording) {
  if (!recording) return view_->clear();
  setHand(recording->profile.hand());
  if (!recording->isLong()) view_->setExtent(handPanelExtentOf(*recording, view_->look()));
}

void HandPanel::setHand(const HandDescription& hand) {
  view_->setHand(hand);
  listMatrices(hand);
}

void HandPanel::show(const TactileFrame& frame, const std::vector<double>& anglesDeg) {
  view_->setMoment(frame, anglesDeg);
}

void HandPanel::showLive(const TactileFrame& frame, const std::vector<double>& anglesDeg) {
  view_->setLiveMoment(frame, anglesDeg);
}

void HandPanel::setColors(const MatricesLook& colors) {
  HandLook look = view_->look();
  look.map = colors.map;
  look.range = colors.range;
  look.view = colors.taxels;
  look.isSigned = colors.isSigned;
  look.arrows = colors.arrows;
  look.theme = colors.theme;
  view_->setLook(look);
}

void HandPanel::setLook(const HandLook& wanted) {
  const HandLook look = withColorsOf(wanted, view_->look());
  view_->setLook(look);
  taxels_->setCurrentIndex(handPanelIndexOf(kAllTaxelShapes, look.taxels));
  spheres_->setCurrentIndex(handPanelIndexOf(kAllSphereLooks, look.sphere));
  matrix_->setCurrentIndex(look.only ? static_cast<int>(*look.only) + 1 : 0);
}

}  // namespace palpate::gui
