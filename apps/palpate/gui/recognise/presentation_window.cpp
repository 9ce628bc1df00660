#include "gui/recognise/presentation_window.h"

#include <QCloseEvent>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>

#include "gui/recognise/answer_view.h"
#include "gui/recognise/guessing_game.h"
#include "gui/widgets/make.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr int kShowRefusedMs = 5000;
constexpr int kShowStateLines = 2;        // reserved, so that the answer seldom changes its size
constexpr double kShowLargerText = 1.25;  // than in the window: it is read from further away
constexpr int kShowStopLetters = 24;      // a large button is hit at once
constexpr int kShowRowMargin = 16;
constexpr int kSceneShare = 3, kAnswerShare = 2;  // of the width
constexpr qsizetype kMaxBefore = 3;

}  // namespace

PresentationWindow::PresentationWindow(RecognitionController& controller,
                                       HandCommands& hand,
                                       bool live,
                                       QWidget* parent)
    : QWidget(parent, Qt::Window), controller_(controller), hand_(hand), live_(live) {
  setObjectName("showWindow");
  setWindowTitle("What is it? – Palpate");
  setAttribute(Qt::WA_DeleteOnClose);
  QPalette plain = palette();
  plain.setColor(QPalette::Window, colorsOf().window);
  setPalette(plain);
  setAutoFillBackground(true);
  view_ = named(new AnswerView(controller.photos(), 0.0, this), "showAnswer");
  before_ = makeLines(this, "showBefore", "muted");
  before_->setContentsMargins(kShowRowMargin, 0, kShowRowMargin, kShowRowMargin);
  game_ = new GuessingGame(this);
  connect(game_, &GuessingGame::changed, this, &PresentationWindow::showAnswer);
  connect(game_, &GuessingGame::guessed, this, &PresentationWindow::asked);
  row_ =
      inRow({{inColumn({{view_, 1}, game_, before_}, Space::kNone), kAnswerShare}}, Space::kNone);
  setLayout(inColumn({{row_, 1}, makeHandRow()}, Space::kNone));
  showAnswer();
  connect(&controller, &RecognitionController::answered, this, &PresentationWindow::showAnswer);
  refusedTimer_.setSingleShot(true);
  refusedTimer_.setInterval(kShowRefusedMs);
  connect(&refusedTimer_, &QTimer::timeout, this, [this] {
    refused_.clear();
    showHand();
  });
  connect(&hand, &HandCommands::handStateChanged, this, &PresentationWindow::showHand);
  connect(&hand, &HandCommands::asked, this, [this] {
    refused_.clear();
    showHand();
  });
  connect(&hand, &HandCommands::keyRefused, this, [this](const QString& why) {
    refused_ = why;
    refusedTimer_.start();
    showHand();
  });
  // Qt gives keys to the actions of the window that has the focus only.
  addActions(hand.motions);
  showHand();
}

void PresentationWindow::setScene(QWidget* scene) { row_->insertWidget(0, scene, kSceneShare); }

QWidget* PresentationWindow::makeHandRow() {
  handRow_ = named(new QWidget(this), "showHand");
  handState_ = makeLines(handRow_, "showHandState");
  auto* stop = makeButton(handRow_, "showStop", "Stop  (Esc)");
  stop->setProperty("danger", true);
  // Return and Space, pressed for something else, don't press it, and Q still asks.
  stop->setFocusPolicy(Qt::NoFocus);
  stop->setSizePolicy(QSizePolicy::Minimum, QSizePolicy::Expanding);
  auto* row = new QHBoxLayout(handRow_);
  row->setContentsMargins(kShowRowMargin, kShowRowMargin / 2, kShowRowMargin, kShowRowMargin);
  row->setSpacing(kShowRowMargin);
  row->addWidget(handState_, 1);
  row->addWidget(stop);
  fitToText(*this, [this, stop] {
    QFont larger = font();
    larger.setPointSizeF(kShowLargerText * fontInfo().pointSizeF());
    handState_->setFont(larger);
    before_->setFont(larger);
    game_->setFont(larger);
    larger.setBold(true);
    stop->setFont(larger);
    const QFontMetrics metrics(larger);
    handState_->setMinimumHeight(kShowStateLines * metrics.lineSpacing());
    stop->setMinimumSize(kShowStopLetters * metrics.averageCharWidth(), 3 * metrics.lineSpacing());
  });
  const auto offer = [this, stop] {
    handRow_->setVisible(hand_.stop && hand_.stop->isEnabled());
    if (hand_.stop) stop->setToolTip(hand_.stop->toolTip());
  };
  if (hand_.stop) {
    connect(stop, &QPushButton::clicked, hand_.stop, &QAction::trigger);
    connect(hand_.stop, &QAction::enabledChanged, handRow_, offer);
    connect(hand_.stop, &QAction::enabledChanged, this, &PresentationWindow::showAnswer);
  }
  offer();
  return handRow_;
}

void PresentationWindow::showHand() {
  // What is wrong with the hand comes first; the dock Hand adds its answer to the key.
  const bool refused = !refused_.isEmpty() && !hand_.handStateBad();
  const ThemeColors& colors = colorsOf();
  handState_->setText(refused ? refused_ : hand_.handState());
  const QColor color = refused                ? colors.warning
                       : hand_.handStateBad() ? colors.danger
                                              : colors.text;
  const QString style = "color: " + color.name() + ";";
  if (handState_->styleSheet() != style) handState_->setStyleSheet(style);
}

void PresentationWindow::setLive(bool live) {
  if (live == live_) return;
  live_ = live;
  showAnswer();
}

void PresentationWindow::setSilence(const QString& why) {
  if (why == view_->stale()) return;
  view_->setStale(why);
  // Only a name stays below the reason: what the audience is asked to do isn't possible.
  if (view_->answer().name().isEmpty()) view_->setAnswer({});
  showAnswer();
}

void PresentationWindow::showAnswer() {
  // An answer that was of now stays below the reason why it isn't any more.
  if (!view_->stale().isEmpty() && !game_->hidesAnswer()) return;
  RecognitionAnswer answer = controller_.answer();
  const bool ofNow = answer.of.isEmpty() || answer.of == kHeldNow;
  if (answer.of == kLastGrasp || (live_ && !ofNow)) answer = {};
  answer.of.clear();
  answer.offset.clear();
  game_->setAnswer(answer.name());
  if (game_->hidesAnswer()) {
    answer = {};
    answer.text = "The hand answers when you have guessed.";
  }
  if (answer.sure && answer.name() != sure_.value(0)) {
    sure_.prepend(answer.name());
    sure_ = sure_.mid(0, kMaxBefore + 1);
  }
  if (game_->hidesAnswer()) sure_.clear();  // they would tell it
  // The name that is shown isn't one of those before.
  const QStringList before = sure_.mid(answer.name() == sure_.value(0) ? 1 : 0, kMaxBefore);
  before_->setText((before.isEmpty() ? "Q: what is it?" : "before: " + before.join(", ")) +
                   " · G: guessing game · Esc: " +
                   (handRow_->isVisibleTo(this) ? "stop the hand, then leave" : "leave"));
  // The audience needs no hint about buttons.
  if (answer.kind == RecognitionAnswer::Kind::kNothing && !game_->hidesAnswer())
    answer.text = !live_ ? "Connect a hand, or choose a grasp of a recording, before the show."
                  : controller_.emulated() ? "Let the hand grasp its object."
                                           : "Put an object into the hand.";
  view_->setAnswer(answer);
}

void PresentationWindow::play() {
  if (game_->isPlayed()) return game_->end();
  QStringList objects;
  if (const TrainedModel* model = controller_.model())
    for (const std::string& name : model->classes) objects.append(QString::fromStdString(name));
  game_->begin(objects);
  if (!game_->isPlayed()) before_->setText("The guessing game needs two taught objects.");
}

void PresentationWindow::keyPressEvent(QKeyEvent* event) {
  if (event->modifiers() == Qt::NoModifier) {
    if (event->key() == Qt::Key_Q) return emit asked();
    if (event->key() == Qt::Key_G) return play();
    if (event->key() >= Qt::Key_1 && event->key() < Qt::Key_1 + GuessingGame::kMaxObjects)
      return game_->choose(event->key() - Qt::Key_1);
  }
  if (event->key() == Qt::Key_Escape ||
      (event->key() == Qt::Key_5 && event->modifiers() == Qt::ControlModifier)) {
    close();
    return;
  }
  QWidget::keyPressEvent(event);
}

void PresentationWindow::closeEvent(QCloseEvent* event) {
  emit closed();
  event->accept();
}

}  // namespace palpate::gui
