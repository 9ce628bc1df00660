// A part of a dialog that folds under a one-line summary of what it contains.
#pragma once

#include <QString>
#include <QWidget>

class QLabel;
class QToolButton;

namespace palpate::gui {

class FoldingPart : public QWidget {
  Q_OBJECT
 public:
  // `title`: with its access key ("&Marks by key"); `tip`: its tool tip. Header, summary and body
  // are named after `name`: "marksHeader", "marksSummary", "marksGrid".
  FoldingPart(const QString& name, const QString& title, const QString& tip, QWidget* parent);

  bool isOpen() const;

 signals:
  // Opened or folded: the preferred height has changed.
  void folded();

 protected:
  // The folded content; its fields are made in it, its layout as well.
  QWidget* body() const { return body_; }
  QWidget* header() const;
  // The content in one line.
  virtual QString summary() const = 0;
  // Shows the summary anew; to be called at the end of the construction and after every change.
  void sumUp();
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fold(bool open);

  QToolButton* header_;
  QLabel* summary_;
  QWidget* body_;
};

}  // namespace palpate::gui
