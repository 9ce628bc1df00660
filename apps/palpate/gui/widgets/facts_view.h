// Rows of name and value with hairlines between them; changing a value repaints one row and lays
// nothing out.
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
  // The values are those of before: nothing comes any more that would change them.
  void setStale(bool old);
  bool isOld() const noexcept { return stale_; }
  void setTheme(Theme theme);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;  // tool tips of values that are too long

 private:
  int rowHeight() const;
  int nameWidth() const;

  std::vector<Fact> facts_;
  bool stale_ = false;
  Theme theme_ = Theme::kDark;
};

}  // namespace palpate::gui
