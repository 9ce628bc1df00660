// Draws the pictures of `palpate demo`, the window and the hand in 3-D, without a display.
#pragma once

#include <QApplication>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/model/profile.h"

#include "commands/display.h"

namespace palpate::commands {

// Only one object may exist at a time, because it owns the Qt application.
class DemoPictures {
 public:
  DemoPictures();

  // Draws the window with a recording into a PNG file. Without `frame` it shows the frame with the
  // largest sum. Throws Error.
  void drawWindow(const std::filesystem::path& recording,
                  std::optional<std::size_t> frame,
                  const std::vector<std::string>& docks,
                  const std::filesystem::path& out) const;
  // Draws the hand in 3-D at one frame; returns the content of a PNG file. Throws Error, and
  // std::out_of_range for `frame`.
  std::string handPng(const Profile& profile, std::size_t frame) const;

 private:
  RuntimeFolder runtime_;
  std::string name_ = "palpate";
  int count_ = 1;
  char* arguments_[2] = {name_.data(), nullptr};
  std::unique_ptr<QApplication> application_;
};

}  // namespace palpate::commands
