#include "core/render/samples.h"

#include <cmath>
#include <memory>

#include "core/image/srgb.h"

namespace hybridrt {
dvec2 sample_offset_px(int sample) {
  constexpr double kPlastic = 1.32471795724474602596;  // the real root of x^3 = x + 1
  const auto place = [sample](double step) {
    const double x = sample * step;
    return x - std::floor(x + 0.5);
  };
  return {place(1 / kPlastic), place(1 / (kPlastic * kPlastic))};
}

void take_mean(std::span<float> pixel, int samples) {
  const int alpha = alpha_channel(static_cast<int>(pixel.size()));
  const float seen = alpha >= 0 ? pixel[alpha] : static_cast<float>(samples);
  for (int c = 0; c < static_cast<int>(pixel.size()); ++c)
    if (c == alpha)
      pixel[c] /= static_cast<float>(samples);
    else if (seen > 0)
      pixel[c] /= seen;
}

int64_t samples_taken(const RenderSettings& s, int64_t pixels, int64_t resampled) {
  return takes_edge_samples(s) ? pixels + resampled * (s.samples - 1) : pixels * s.samples;
}

NextFrame sampled(NextFrame next, int samples) {
  if (samples == 1) return next;
  struct State {
    std::optional<FrameRequest> request;
    int sample = 0;
  };
  return [next = std::move(next), samples, state = std::make_shared<State>()]() -> std::optional<FrameRequest> {
    if (state->sample == 0) state->request = next();
    if (!state->request) return std::nullopt;
    FrameRequest request = *state->request;
    request.sample_offset_px = sample_offset_px(state->sample);
    state->sample = (state->sample + 1) % samples;
    return request;
  };
}

DeliverFrame averaged(DeliverFrame deliver, int samples) {
  if (samples == 1) return deliver;
  struct State {
    Frame sum;
    int taken = 0;
  };
  return [deliver = std::move(deliver), samples, state = std::make_shared<State>()](Frame&& frame) {
    Frame& sum = state->sum;
    if (state->taken++ == 0) {
      sum = std::move(frame);
    } else {
      for (size_t i = 0; i < sum.picture.data.size(); ++i) sum.picture.data[i] += frame.picture.data[i];
      for (size_t i = 0; i < sum.timings.pass_ms.size(); ++i) sum.timings.pass_ms[i] += frame.timings.pass_ms[i];
      for (size_t i = 0; i < sum.timings.threads_ms.size(); ++i)
        sum.timings.threads_ms[i] += frame.timings.threads_ms[i];
      sum.timings.wall_ms += frame.timings.wall_ms;
      sum.stats.add(frame.stats);
    }
    if (state->taken < samples) return;
    Image& picture = sum.picture;
    for (size_t first = 0; first < picture.data.size(); first += picture.channels)
      take_mean(std::span(&picture.data[first], picture.channels), samples);
    state->taken = 0;
    deliver(std::move(sum));
  };
}

}  // namespace hybridrt
