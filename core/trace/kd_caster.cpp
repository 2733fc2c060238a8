#include "core/trace/kd_caster.h"

#include "core/base/check.h"
#include "core/trace/kd_traverse.h"
#include "core/trace/leaf_simd.h"

namespace hybridrt {
namespace {

template <typename Real>
class ScalarKdCaster final : public RayCaster<Real> {
 public:
  explicit ScalarKdCaster(const KdTree& tree) : tree_(tree) {}

  void closest_hits(std::span<const Ray<Real>> rays, std::span<Hit<Real>> hits) const override {
    HRT_CHECK_EQ(rays.size(), hits.size());
    for (size_t i = 0; i < rays.size(); ++i)
      hits[i] = HWY_NAMESPACE::traverse<false, HWY_NAMESPACE::ScalarLeaf<Real>>(tree_, rays[i]);
  }

  void any_hits(std::span<const Ray<Real>> rays, std::span<uint8_t> occluded) const override {
    HRT_CHECK_EQ(rays.size(), occluded.size());
    for (size_t i = 0; i < rays.size(); ++i)
      occluded[i] = HWY_NAMESPACE::traverse<true, HWY_NAMESPACE::ScalarLeaf<Real>>(tree_, rays[i]).found();
  }

 private:
  const KdTree& tree_;
};

class SimdKdCaster final : public RayCaster<float> {
 public:
  explicit SimdKdCaster(const KdTree& tree) : tree_(tree) {}

  void closest_hits(std::span<const Ray<float>> rays, std::span<Hit<float>> hits) const override {
    HRT_CHECK_EQ(rays.size(), hits.size());
    closest_hits_simd(tree_, rays, hits);
  }

  void any_hits(std::span<const Ray<float>> rays, std::span<uint8_t> occluded) const override {
    HRT_CHECK_EQ(rays.size(), occluded.size());
    any_hits_simd(tree_, rays, occluded);
  }

 private:
  const KdTree& tree_;
};

}  // namespace

std::unique_ptr<RayCaster<float>> make_kd_caster(const KdTree& tree, LeafKernel kernel) {
  if (kernel == LeafKernel::scalar) return std::make_unique<ScalarKdCaster<float>>(tree);
  return std::make_unique<SimdKdCaster>(tree);
}

std::unique_ptr<RayCaster<double>> make_reference_caster(const KdTree& tree) {
  return std::make_unique<ScalarKdCaster<double>>(tree);
}

}  // namespace hybridrt
