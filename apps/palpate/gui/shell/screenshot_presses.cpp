#include "gui/shell/screenshot_presses.h"

#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QTimer>
#include <QWidget>
#include <algorithm>
#include <functional>
#include <optional>

#include <palpate/core/error.h>
#include <palpate/core/number_text.h>
#include <palpate/core/time.h>

#include "gui/window_state/action_registry.h"

namespace palpate::gui {
namespace {

constexpr int kScreenshotPressesLookMs = 10;

// The dialogue or other window open in front of `window`; null: none.
QWidget* openBefore(const QWidget& window) {
  if (QWidget* modal = QApplication::activeModalWidget()) return modal;
  for (QWidget* each : QApplication::topLevelWidgets())
    if (each != &window && each->isVisible() && each->windowType() != Qt::ToolTip) return each;
  return nullptr;
}

// The visible text of a button: without mnemonic, dots, surrounding blanks and the key after it.
QString screenshotPressesWordsOf(const QAbstractButton& button) {
  QString words = button.text();
  words.remove('&').remove("…");
  return words.section("  (", 0, 0).trimmed();
}

// The first enabled action that `fits`; those that show and hide docks belong to the docks.
bool pressAction(const QWidget& window, const std::function<bool(const QAction&)>& fits) {
  for (QAction* action : window.actions() + window.findChildren<QAction*>()) {
    if (!action->isEnabled() || !fits(*action)) continue;
    action->trigger();
    return true;
  }
  return false;
}

bool pressButton(const QWidget& window, const QString& words) {
  for (QAbstractButton* button : window.findChildren<QAbstractButton*>()) {
    // A checked button of a group would do nothing.
    if (!button->isVisible() || !button->isEnabled() || button->isChecked()) continue;
    if (screenshotPressesWordsOf(*button) != words) continue;
    button->click();
    return true;
  }
  return false;
}

bool press(const QWidget& window, const std::string& what) {
  const QString text = QString::fromStdString(what);
  const QKeySequence keys(text);
  return pressAction(window,
                     [&keys](const QAction& action) {
                       return !keys.isEmpty() && action.shortcuts().contains(keys);
                     }) ||
         pressButton(window, text) ||
         pressAction(window, [&text](const QAction& action) { return plainText(action) == text; });
}

}  // namespace

ScreenshotPress parsedPress(const std::string& text) {
  const std::size_t at = text.rfind('@');
  if (at == std::string::npos || at == 0) return {text, 0.0};
  const std::optional<double> seconds = parseDouble(text.substr(at + 1));
  if (!seconds || !(*seconds >= 0.0)) return {text, 0.0};
  return {text.substr(0, at), *seconds};
}

QImage runAndPress(QWidget& window,
                   std::vector<ScreenshotPress> presses,
                   double forS,
                   double patienceS) {
  std::stable_sort(presses.begin(), presses.end(), [](const auto& one, const auto& other) {
    return one.atS < other.atS;
  });
  QEventLoop loop;
  QElapsedTimer since;
  since.start();
  std::size_t done = 0;
  // Delay of the last press [s]; the end is delayed by as much.
  double waitingS = 0.0;
  std::optional<std::string> failure;
  QImage dialogue;
  // Ends all timers with this call.
  QObject context;
  // A press may open a dialogue, which runs its own event loop: therefore the next call is
  // scheduled before the press, and the last one closes the dialogue.
  std::function<void()> look = [&] {
    QTimer::singleShot(kScreenshotPressesLookMs, &context, look);
    const double nowS = static_cast<double>(since.elapsed()) / kMsPerS;
    QWidget* open = openBefore(window);
    if (!failure && done < presses.size()) {
      if (nowS < presses[done].atS + waitingS) return;
      // Counted before the press, because a press that opens a dialogue doesn't return until it is
      // closed.
      const ScreenshotPress wanted = presses[done++];
      const double lateS = nowS - wanted.atS;
      if (press(open ? *open : window, wanted.what)) {
        waitingS = std::max(waitingS, lateS);
        return;
      }
      --done;
      if (lateS - waitingS < patienceS) return;
      failure = wanted.what;
    } else if (!failure && nowS < forS + waitingS) {
      return;
    }
    if (open) {
      dialogue = open->grab().toImage();
      open->close();
    }
    loop.quit();
  };
  QTimer::singleShot(0, &context, look);
  loop.exec();
  if (failure)
    throw Error(
        "--press finds no key, action or button '" + *failure +
        "': give the key or the words of an action that can be used now (F1 lists keys), or the "
        "words on a visible button");
  return dialogue;
}

}  // namespace palpate::gui
