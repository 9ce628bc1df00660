// Shows rows of name and value with hairlines between them. A changed value repaints one row and
// needs no new layout.
#pragma once

#include <QString>
#include <QWidget>
#include <vector>

#include "gui/appearance/theme.h"

namespace palpate::gui {

struct Fact {
  QString name;
  QString value;
  bool warning = false;
};

class FactsView : public QWidget {
  Q_OBJECT
 public:
  explicit FactsView(QWidget* parent = nullptr);
  void setFacts(std::vector<Fact> facts);
  void setValue(std::size_t row, const QString& value);
  const std::vector<Fact>& facts() const noexcept { return facts_; }
  // Name and value as they are painted in the present width: a number with its unit is always
  // whole, and its name is elided instead; of other values the middle is left out.
  Fact shown(std::size_t row) const;
  // The width [px] with which no name beside a number is elided.
  int wholeWidth() const;
  // The values are stale: no new data arrive.
  void setStale(bool old);
  bool isOld() const noexcept { return stale_; }
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void changeEvent(QEvent* event) override;
  // Shows tool tips for values that are too long.
  bool event(QEvent* event) override;

 private:
  void measure();
  // Tells rows and values to a screen reader.
  void describe();
  int rowHeight() const;
  int nameWidth() const;
  int textWidth(const QString& text) const;

  std::vector<Fact> facts_;
  // Width of the widest number since the rows are there [px].
  int numberWidth_ = 0;
  bool stale_ = false;
};

}  // namespace palpate::gui
