// The pictures of `palpate demo`: the window, and the hand in space; needs no display.
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

// One at a time; Qt runs as long as it lives.
class DemoPictures {
 public:
  DemoPictures();

  // The window on a recording as a PNG file. Nothing: the frame of largest sum. Throws Error.
  void drawWindow(const std::filesystem::path& recording,
                  std::optional<std::size_t> frame,
                  const std::vector<std::string>& docks,
                  const std::filesystem::path& out) const;
  // The hand in space in one frame: the bytes of a PNG. Throws Error, std::out_of_range (frame).
  std::string handPng(const Profile& profile, std::size_t frame) const;

 private:
  RuntimeFolder runtime_;
  std::string name_ = "palpate";
  int count_ = 1;
  char* arguments_[2] = {name_.data(), nullptr};
  std::unique_ptr<QApplication> application_;
};

}  // namespace palpate::commands
