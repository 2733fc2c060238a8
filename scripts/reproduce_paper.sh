#!/usr/bin/env bash
# Measures what the paper measured and writes docs/paper.md with its charts.
#
#   scripts/reproduce_paper.sh [OUT]      (default out/paper; a quarter of an hour on two cores)
#
# Started again it goes on where it was stopped. The paper's settings: 500,000 triangles, 1024x768 pixels, one
# reflection, a kernel of 5x5 pixels. "egl" is software OpenGL where there is no GPU.
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-out/paper}
hybridrt=build/release/bin/hybridrt
common=(--size 1024x768 --reflection-depth 1)
balls=scene:spheres,triangles=500k,reflective=10

sweep() {
  "$hybridrt" sweep "$@" "${common[@]}"
}

# Figures 4 and 5: the measuring scene, one frame in flight and two.
sweep "$balls" --over gl=egl,off --over shadows=blur,exact --over frames-in-flight=1,2 --frames 1-6 --truth-samples 0 \
  -o "$out/balls"

# Figure 6: time of each pass as reflection grows.
sweep "$balls" --preset paper --gl egl --frames 1-2 -o "$out/reflection-gl"
sweep "$balls" --preset paper --gl off --frames 1-2 -o "$out/reflection-cpu"

# Figure 7: threads.
sweep "$balls" --over threads=1,2 --gl off --shadows blur --frames 1-4 --truth-samples 0 -o "$out/threads"
for n in 1 2; do # a software GL keeps its threads
  sweep "$balls" --over gl=egl --threads "$n" --shadows blur --frames 1-4 --truth-samples 0 -o "$out/threads-gl-$n"
done

# Figures 8 and 9: shadows without and with refinement, and what the kernel buys.
sweep scene:thin,triangles=500k --over shadows=map,blur,exact --over gl=egl,off --frames 1-2 --truth-samples 1 -o "$out/shadows"
sweep scene:thin,triangles=500k --over blur-kernel=1,3,5,9,15,31 --shadows blur --gl off --truth-samples 1 \
  -o "$out/kernel"

# Section 5.2's question: does the bottleneck move to passes 1, 2, 3 and 5 as triangles grow?
sweep scene:spheres,reflective=10 --over triangles=10k,100k,1M,10M --over gl=egl,off --shadows blur --truth-samples 0 \
  --rounds 2 -o "$out/growth"

# Section 5.4: the narrowest and the widest vectors that this processor has.
for target in SSE4 AVX2 AVX3; do
  build/release/bin/frame_bench --rounds=9 --target="$target" "$balls" scene:thin,triangles=500000 \
    >"$out/simd-$target.csv.part" && mv "$out/simd-$target.csv.part" "$out/simd-$target.csv" ||
    rm "$out/simd-$target.csv.part" # this processor lacks it
done

scripts/paper_page.py "$out" docs/paper.md
