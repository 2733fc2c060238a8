#include "cli/tune/search.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "core/base/error.h"

namespace hybridrt::cli {
namespace {

using Values = std::vector<std::string>;

constexpr double kAlike = 1.03;  // times nearer than this are noise

const Values kDepths = {"0", "1", "2", "4", "8", "16", "64"};
const Values kMaps = {"512", "1024", "2048", "4096", "8192"};
const Values kKernels = {"1", "3", "5", "9", "15", "31"};

/// 1, 2, 4 and so on, fewer than the truth has: it has the same places, and would count as right what they miss.
Values samples_below(int truth_samples) {
  Values values = {"1"};
  for (int samples = 2; samples <= truth_samples / 2; samples *= 2) values.push_back(fmt::format("{}", samples));
  return values;
}

Choice with(Choice choice, const std::string& name, const std::string& value) {
  choice[name] = value;
  return choice;
}

/// The first value that meets the goal: they go from cheap to dear.
std::optional<Choice> first_that_meets(Trials& trials, const Goal& goal, const Choice& choice, const std::string& name,
                                       const Values& values) {
  for (const std::string& value : values)
    if (const Choice next = with(choice, name, value); is_met(goal, trials.error(next))) return next;
  return std::nullopt;
}

/// Few samples and few generations, with the best shadows. Wrong pixels depend on neither.
Choice coarsest_exact(Trials& trials, const Goal& goal) {
  if (goal.one_sample()) return {{"method", "hybrid"}, {"shadows", "exact"}, {"samples", "1"}};
  const Choice best = {{"method", "hybrid"}, {"shadows", "exact"}, {"reflection-depth", kDepths.back()}};
  const Values samples = samples_below(trials.truth_samples());
  const std::optional<Choice> sampled = first_that_meets(trials, goal, best, "samples", samples);
  if (!sampled) {
    const Choice finest = with(best, "samples", samples.back());
    throw error(ErrorKind::usage, "--max-error: not even {} gets there, with {}; allow a larger error", text_of(finest),
                error_text(goal, trials.error(finest)));
  }
  return first_that_meets(trials, goal, *sampled, "reflection-depth", kDepths).value_or(*sampled);
}

/// The choice with a shadow map as small as the goal allows, and with `blur` the smallest kernel; nothing if none meets
/// it.
std::optional<Choice> smallest_map(Trials& trials, const Goal& goal, const Choice& choice, bool blurs) {
  const Choice largest = blurs ? with(choice, "blur-kernel", kKernels.back()) : choice;
  if (!is_met(goal, trials.error(with(largest, "shadow-map", kMaps.back())))) return std::nullopt;
  std::optional<Choice> found = first_that_meets(trials, goal, largest, "shadow-map", kMaps);
  if (blurs && found) found = first_that_meets(trials, goal, *found, "blur-kernel", kKernels);
  return found;
}

/// Every method and shadow mode that meets the goal with these samples and this depth.
std::vector<Choice> methods_that_meet(Trials& trials, const Goal& goal, const Choice& coarsest) {
  std::vector<Choice> meeting;
  for (const auto& method : kMethods)
    for (const auto& shadows : kShadowModes) {
      if (method.value == Method::reference || !method_takes(method.value, shadows.value)) continue;
      if (goal.one_sample() && shadows.value == ShadowMode::none) continue;  // all of its shadows are wrong
      const Choice choice =
          with(with(coarsest, "method", std::string(method.name)), "shadows", std::string(shadows.name));
      if (shadows.value == ShadowMode::map || shadows.value == ShadowMode::blur) {
        if (const auto found = smallest_map(trials, goal, choice, shadows.value == ShadowMode::blur))
          meeting.push_back(*found);
      } else if (is_met(goal, trials.error(choice))) {
        meeting.push_back(choice);
      }
    }
  return meeting;
}

/// Each choice, and each with its samples at edges only.
std::vector<Choice> with_adaptive(const std::vector<Choice>& choices) {
  std::vector<Choice> both = choices;
  for (const Choice& choice : choices)
    if (choice.at("samples") != "1" && choice.at("shadows") != name_of(ShadowMode::map) &&
        choice.at("shadows") != name_of(ShadowMode::blur))
      both.push_back(with(choice, "adaptive", "true"));
  return both;
}

/// The fastest that meets the goal. Of those that times hardly tell apart the one with the least error, then the first.
Choice fastest(Trials& trials, const Goal& goal, const std::vector<Choice>& choices) {
  std::vector<Choice> meeting;
  for (const Choice& choice : choices)
    if (is_met(goal, trials.error(choice))) meeting.push_back(choice);
  trials.measure(meeting);
  double least_ms = INFINITY;
  for (const Choice& choice : meeting) least_ms = std::min(least_ms, trials.ms(choice));
  std::erase_if(meeting, [&](const Choice& choice) { return trials.ms(choice) > kAlike * least_ms; });
  return *std::min_element(meeting.begin(), meeting.end(),
                           [&](const Choice& a, const Choice& b) { return trials.error(a) < trials.error(b); });
}

}  // namespace

Choice cheapest_choice(Trials& trials, const Goal& goal) {
  Choice choice = fastest(trials, goal, with_adaptive(methods_that_meet(trials, goal, coarsest_exact(trials, goal))));
  choice = fastest(trials, goal, {choice, with(choice, "accel", "kdtree")});
  return fastest(trials, goal, {choice, with(choice, "frames-in-flight", "1"), with(choice, "frames-in-flight", "3")});
}

}  // namespace hybridrt::cli
