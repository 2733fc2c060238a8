#pragma once

#include <string>

#include "cli/sweep/accuracy.h"

namespace hybridrt::cli {

/// How good frames must be.
struct Goal {
  enum class Unit {
    decibel,       ///< PSNR, at least
    percent_off,   ///< of the pixels, off by more than 2/255 in a channel, at most
    wrong_pixels,  ///< with another triangle or a wrong shadow at their centre, at most
  };
  Unit unit = Unit::decibel;
  double limit = 0;

  /// Wrong pixels are known at one sample a pixel only.
  bool one_sample() const { return unit == Unit::wrong_pixels; }
};

/// `45dB`, `0.1%` or `10wrong`. Throws Error(usage).
Goal parse_goal(const std::string& text);

/// A frame's error in the goal's unit, so that less is better: decibels count negative.
double error_of(const Goal& goal, const Accuracy& accuracy, size_t pixels);
bool is_met(const Goal& goal, double error);

/// "46.2 dB", "0.04 %", "3 wrong pixels".
std::string error_text(const Goal& goal, double error);

}  // namespace hybridrt::cli
