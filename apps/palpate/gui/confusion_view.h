// A confusion matrix: what it was (rows) against what it was called (columns). A cell can be chosen by mouse or arrow keys.
#pragma once

#include <QWidget>
#include <optional>
#include <utility>

#include <palpate/recognition/classification_report.h>

#include "gui/theme.h"

namespace palpate::gui {

// Painted anywhere; `chosen`: truth, called (ConfusionMatrix::kUnknown: the last column).
void paintConfusion(QPainter& painter,
                    const QRectF& area,
                    const ConfusionMatrix& matrix,
                    Theme theme,
                    std::optional<std::pair<int, int>> chosen = {});

class ConfusionView : public QWidget {
  Q_OBJECT
 public:
  explicit ConfusionView(QWidget* parent = nullptr);
  void setMatrix(std::optional<ConfusionMatrix> matrix);
  const std::optional<ConfusionMatrix>& matrix() const noexcept { return matrix_; }
  void setTheme(Theme theme);
  void choose(std::optional<std::pair<int, int>> cell);
  const std::optional<std::pair<int, int>>& chosen() const noexcept { return chosen_; }
  QSize sizeHint() const override { return {380, 340}; }
  QSize minimumSizeHint() const override { return {200, 180}; }

 signals:
  void cellChosen(int truth, int called);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool event(QEvent* event) override;

 private:
  std::optional<std::pair<int, int>> cellAt(const QPointF& at) const;

  std::optional<ConfusionMatrix> matrix_;
  std::optional<std::pair<int, int>> chosen_;
  Theme theme_ = Theme::kDark;
};

}  // namespace palpate::gui
