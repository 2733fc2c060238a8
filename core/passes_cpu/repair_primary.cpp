#include "core/passes_cpu/repair_primary.h"

#include "core/base/check.h"

namespace hybridrt {

RepairStats repair_primary_hits(const Scene& scene, const Clusters& clusters, const View& view, ThreadPool& pool,
                                RasterMemory& memory, std::span<const uint32_t> ids, std::span<uint32_t> repaired) {
  HRT_CHECK_EQ(ids.size(), repaired.size());
  rasterize_ids(scene, clusters, view, pool, memory, repaired);
  RepairStats stats;
  stats.checked = static_cast<int64_t>(ids.size());
  for (size_t i = 0; i < ids.size(); ++i) stats.repaired += repaired[i] != ids[i];
  return stats;
}

}  // namespace hybridrt
