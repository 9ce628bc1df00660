#include "gui/hand_panel.h"

#include <QAction>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QResizeEvent>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

namespace palpate::gui {
namespace {

constexpr int kControlHeight = 26;  // [px] of boxes beside buttons
constexpr int kWordsAbove = 560;    // [px] of width: room for the sphere's size in the header
constexpr int kBoxesAbove = 400;    // [px] of width: room for the sphere's box

template <class All, class Value>
int indexOf(const All& all, Value value) {
  return static_cast<int>(std::find(all.begin(), all.end(), value) - all.begin());
}

}  // namespace

HandPanel::HandPanel(const QList<QAction*>& shown, QWidget* parent) : QWidget(parent) {
  auto* header = new QWidget(this);
  header->setObjectName("ViewHeader");
  header->setAttribute(Qt::WA_StyledBackground);
  title_ = new QLabel("<b>Hand</b>", header);
  sphere_ = new QLabel(header);
  sphere_->setObjectName("sphereText");
  sphere_->setProperty("role", "muted");
  const auto box = [header](const char* name, const char* tip) {
    auto* made = new QComboBox(header);
    made->setObjectName(name);
    made->setFocusPolicy(Qt::NoFocus);  // it has a key
    made->setToolTip(tip);
    made->setMinimumHeight(kControlHeight);
    return made;
  };
  taxels_ = box("taxelShapeBox", "How taxels are drawn (T)");
  for (const TaxelShape shape : kAllTaxelShapes) taxels_->addItem(nameOf(shape));
  spheres_ = box("sphereBox", "The enclosing sphere (B)");
  for (const SphereLook look : kAllSphereLooks) spheres_->addItem(nameOf(look));
  matrix_ = box("onlyMatrixBox", "One matrix alone (Alt+1, Alt+2, ..; Alt+0: the whole hand)");
  auto* more = new QToolButton(header);
  more->setObjectName("handShowButton");
  more->setText("Show");
  more->setToolTip("What else is seen of the hand");
  more->setPopupMode(QToolButton::InstantPopup);
  more->setFocusPolicy(Qt::TabFocus);
  auto* menu = new QMenu(more);
  menu->addActions(shown);
  more->setMenu(menu);

  auto* row = new QHBoxLayout(header);
  row->setContentsMargins(12, 4, 10, 4);
  row->setSpacing(6);
  row->addWidget(title_);
  row->addSpacing(4);
  row->addWidget(sphere_);
  row->addStretch(1);
  row->addWidget(taxels_);
  row->addWidget(spheres_);
  row->addWidget(matrix_);
  row->addWidget(more);

  view_ = new HandView(this);
  view_->setObjectName("handView");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(header);
  column->addWidget(view_, 1);

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
  connect(view_, &HandView::momentShown, this, &HandPanel::say);
  setMinimumWidth(240);
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
  recording_ = recording;
  if (!recording) {
    view_->clear();
    say();
    return;
  }
  setHand(recording->profile.hand());
  recording_ = recording;
}

void HandPanel::setHand(const HandDescription& hand) {
  recording_.reset();
  view_->setHand(hand);
  listMatrices(hand);
  say();
}

void HandPanel::showFrame(std::size_t frame) {
  if (!recording_ || recording_->profile.numFrames() == 0) return;
  recording_->profile.readFrame(frame, frame_);
  const auto angles = recording_->profile.anglesAtFrame(frame);
  view_->setMoment(frame_, angles ? angles->deg : std::vector<double>());
}

void HandPanel::showLive(const TactileFrame& frame, const std::vector<double>& anglesDeg) {
  view_->setMoment(frame, anglesDeg);
}

void HandPanel::setColors(const MatricesLook& colors) {
  HandLook look = view_->look();
  look.map = colors.map;
  look.range = colors.range;
  look.theme = colors.theme;
  view_->setLook(look);
}

void HandPanel::setLook(const HandLook& wanted) {
  HandLook look = wanted;
  look.map = view_->look().map;
  look.range = view_->look().range;
  look.theme = view_->look().theme;
  view_->setLook(look);
  taxels_->setCurrentIndex(indexOf(kAllTaxelShapes, look.taxels));
  spheres_->setCurrentIndex(indexOf(kAllSphereLooks, look.sphere));
  matrix_->setCurrentIndex(look.only ? static_cast<int>(*look.only) + 1 : 0);
  say();
}

void HandPanel::say() {
  const QString text = sphereText(view_->drawing(), view_->look().sphereOf);
  if (text != sphere_->text()) sphere_->setText(text);
}

void HandPanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  sphere_->setVisible(event->size().width() >= kWordsAbove);
  spheres_->setVisible(event->size().width() >= kBoxesAbove);
}

}  // namespace palpate::gui
