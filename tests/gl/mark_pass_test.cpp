// Pass 3 against a plain k x k blur written out.

#include "core/passes_gl/mark_boundary.h"
#include "shaders/shared.h"
#include "tests/gl/gl_test.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

using Mask = std::vector<uint8_t>;

/// Marked: the blur of the shadow channel over the receivers in the window is strictly between dark and lit.
Mask marked_by_hand(const Mask& mask, int width, int height, int kernel) {
  Mask marked = mask;
  const int radius = kernel / 2;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0, receivers = 0;
      for (int v = y - radius; v <= y + radius; ++v)
        for (int u = x - radius; u <= x + radius; ++u) {
          if (u < 0 || v < 0 || u >= width || v >= height) continue;
          const uint8_t value = mask[static_cast<size_t>(v) * width + u];
          if (value == HRT_MASK_NO_RECEIVER) continue;
          ++receivers;
          sum += value == HRT_MASK_LIT;
        }
      uint8_t& here = marked[static_cast<size_t>(y) * width + x];
      if (here != HRT_MASK_NO_RECEIVER && sum > 0 && sum < receivers) here |= HRT_MASK_MARKED;
    }
  return marked;
}

class MarkPass : public GlTest {
 protected:
  void expect_blur(const Mask& mask, int width, int height, int kernel) {
    const MarkBoundaryPass pass(gl(), gl::embedded_shaders());
    const gl::Texture sums(gl(), GL_RG8UI, width, height, "sums");
    const gl::TextureArray in(gl(), GL_R8UI, width, height, 3, "mask"), out(gl(), GL_R8UI, width, height, 3, "marked");
    // Uses the middle layer; the others hold its opposite and must not count.
    Mask layers, untouched(3 * mask.size(), 77);
    for (int layer = 0; layer < 3; ++layer)
      for (const uint8_t value : mask) layers.push_back(layer == 1 ? value : value ^ HRT_MASK_LIT);
    write_layers(gl(), in, width, height, GL_RED_INTEGER, GL_UNSIGNED_BYTE, layers);
    write_layers(gl(), out, width, height, GL_RED_INTEGER, GL_UNSIGNED_BYTE, untouched);
    pass.run({in, width, height, kernel, 1}, {sums, out});
    const Mask all = read_pixels<uint8_t>(gl(), out, width, height, GL_RED_INTEGER, GL_UNSIGNED_BYTE, 3);
    const Mask marked(all.begin() + mask.size(), all.begin() + 2 * mask.size());
    ASSERT_TRUE(std::all_of(all.begin(), all.begin() + mask.size(), [](uint8_t m) { return m == 77; }));
    ASSERT_TRUE(std::all_of(all.begin() + 2 * mask.size(), all.end(), [](uint8_t m) { return m == 77; }));
    const Mask expected = marked_by_hand(mask, width, height, kernel);
    for (size_t i = 0; i < marked.size(); ++i)
      ASSERT_EQ(int(marked[i]), int(expected[i]))
          << "pixel " << i % width << ' ' << i / width << " of " << width << 'x' << height << ", kernel " << kernel;
    const bool any = std::any_of(marked.begin(), marked.end(), [](uint8_t m) { return m & HRT_MASK_MARKED; });
    EXPECT_FALSE(kernel == 1 && any) << "one pixel alone has no boundary";
  }
};

struct Size {
  int width, height;
};

TEST_F(MarkPass, RandomMasksInAllSizesAndKernels) {
  Random random(5);
  for (const Size size : {Size{37, 23}, {8, 8}, {64, 3}, {1, 1}, {1, 50}, {131, 70}, {29, 31}})
    for (int kernel : {1, 3, 5, 15, 31}) {
      Mask mask(static_cast<size_t>(size.width) * size.height);
      for (uint8_t& value : mask) {
        const float pick = random.unit();
        value = pick < 0.2f ? HRT_MASK_NO_RECEIVER : pick < 0.6f ? HRT_MASK_LIT : 0;
      }
      expect_blur(mask, size.width, size.height, kernel);
    }
}

// Sparse masks show the window's exact reach; dense ones hardly do.
TEST_F(MarkPass, SinglePixelsAndHoles) {
  Random random(6);
  for (int kernel : {3, 5, 15, 31})
    for (const uint8_t ground : {0u, HRT_MASK_LIT})
      for (const uint8_t spot : {0u, HRT_MASK_LIT, HRT_MASK_NO_RECEIVER}) {
        Mask mask(79 * 61, ground);
        for (int i = 0; i < 3; ++i) mask[random.below(79 * 61)] = spot;
        mask.front() = mask.back() = spot;
        expect_blur(mask, 79, 61, kernel);
      }
}

TEST_F(MarkPass, StraightEdgeMarksTheKernelsWidth) {
  for (int kernel : {3, 5, 15, 31}) {
    Mask mask(100 * 10);
    for (size_t i = 0; i < mask.size(); ++i) mask[i] = i % 100 < 50 ? 0 : HRT_MASK_LIT;
    expect_blur(mask, 100, 10, kernel);
    const Mask marked = marked_by_hand(mask, 100, 10, kernel);  // known on paper: radius pixels on each side
    EXPECT_EQ(std::count_if(marked.begin(), marked.end(), [](uint8_t m) { return m & HRT_MASK_MARKED; }),
              10 * (kernel - 1));
  }
}

}  // namespace
}  // namespace hybridrt
