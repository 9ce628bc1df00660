// Questions to the user for files, folders, texts and decisions, for panels and features alike.
#pragma once

#include <QString>
#include <QStringList>
#include <optional>

class QWidget;

namespace palpate::gui {

class Ask {
 public:
  virtual ~Ask() = default;
  // An empty answer: cancelled. `filter` is that of QFileDialog.
  QString file(const QString& title, const QString& folder, const QString& filter) {
    return places(Place::kFile, title, folder, filter).value(0);
  }
  QStringList files(const QString& title, const QString& folder, const QString& filter) {
    return places(Place::kFiles, title, folder, filter);
  }
  QString folder(const QString& title, const QString& begin) {
    return places(Place::kFolder, title, begin, {}).value(0);
  }
  // The user has been asked whether an existing file may be replaced. `ending` (".json"): appended
  // to a name that doesn't end in it.
  QString newFile(const QString& title,
                  const QString& suggestion,
                  const QString& filter,
                  const QString& ending = {});
  // For one line, without spaces around it; nothing: cancelled. `text` is the present text.
  virtual std::optional<QString> text(const QString& title,
                                      const QString& question,
                                      const QString& text) = 0;
  // The index of the button that was pressed; -1: cancelled. The last one stands for what can't be
  // undone. Enter presses the button `enter`; -1: Cancel.
  virtual int choice(const QString& text, const QStringList& buttons, int enter = -1) = 0;
  bool confirmed(const QString& text, const QString& button) { return choice(text, {button}) == 0; }

 protected:
  enum class Place { kFile, kFiles, kFolder, kNewFile };

 private:
  virtual QStringList places(Place place,
                             const QString& title,
                             const QString& begin,
                             const QString& filter) = 0;
};

// Asks by dialogues over the window in which the user is, else over `window`.
class DialogAsk : public Ask {
 public:
  explicit DialogAsk(QWidget* window = nullptr) : window_(window) {}
  std::optional<QString> text(const QString& title,
                              const QString& question,
                              const QString& text) override;
  int choice(const QString& text, const QStringList& buttons, int enter) override;

 private:
  QStringList places(Place place,
                     const QString& title,
                     const QString& begin,
                     const QString& filter) override;
  QWidget* parent() const;

  QWidget* window_;
};

}  // namespace palpate::gui
