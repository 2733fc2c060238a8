#!/usr/bin/env bash
# Measures how frames scale with threads, triangles, pixels and frames in flight, and what limits at each end; writes
# docs/results/scaling.md with its charts.
#
#   scripts/scaling.sh [OUT]            (default out/scaling; ten minutes on two cores)
#   QUICK=1 scripts/scaling.sh OUT -    a look in three minutes, without 20 million triangles and 7680x4320; "-" writes OUT/scaling.md
#
# Started again it goes on where it was stopped. Profiles need Linux's perf and are left out without it.
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-out/scaling}
page=docs/results/scaling.md images=docs/images
[ "${2:-}" != - ] || page=$out/scaling.md images=$out
mkdir -p "$out"
hybridrt=build/release/bin/hybridrt
balls=scene:spheres,reflective=10
rounds=3 frames=1-3 triangles=10k,100k,1M,5M,20M sizes=640x480,1280x960,2560x1440,3840x2160,7680x4320
[ -z "${QUICK:-}" ] || { rounds=1 frames=1-2 triangles=10k,100k,1M,5M sizes=640x480,1280x960,2560x1440; }

# Settings that fail (no memory for 20 million triangles) are rows with their reason; the others go on.
sweep() {
  "$hybridrt" sweep "$@" --rounds "$rounds" --frames "$frames" --sequence 1-100 || [ $? -eq 1 ]
}

sweep "$balls" --preset growth --gl off --reflection-depth 1 --over "triangles=$triangles" -o "$out/growth"
sweep "$balls,triangles=500k" --preset pixels --gl off --reflection-depth 1 --over "size=$sizes" -o "$out/pixels"
for scene in "$balls,triangles=10k" "$balls,triangles=5M" scene:chess,triangles=500k; do
  sweep "$scene" --preset scaling --gl off -o "$out/threads/$scene"
done
sweep "$balls,triangles=500k" --gl egl --over frames-in-flight=1,2,4 --over shadows=blur,exact --truth-samples 0 -o "$out/in-flight"

# One job at each end, all its files written. What comes before DELAY_MS, about the time of loading, is left out.
profile() {
  local name=$1 scene=$2 size=$3 frames=$4 delay_ms=$5
  [ ! -e "$out/profiles/$name.txt" ] || return 0
  perf record -q -F 499 -D "$delay_ms" -o "$out/$name.perf" -- "$hybridrt" render "$scene" --gl off --size "$size" --frames "$frames" \
    --reflection-depth 1 -q -o "$out/pictures/frame.####.png" >/dev/null 2>&1 || return 0
  perf report -i "$out/$name.perf" --stdio --no-children --sort symbol -F overhead,sym 2>/dev/null >"$out/profiles/part"
  mv "$out/profiles/part" "$out/profiles/$name.txt"
  rm -rf "$out/$name.perf" "$out/pictures"
}
if command -v perf >/dev/null; then
  mkdir -p "$out/profiles"
  profile "10,000 triangles, 640×480" "$balls,triangles=10k" 640x480 300 100
  profile "10,000 triangles, 3840×2160" "$balls,triangles=10k" 3840x2160 12 100
  profile "5 million triangles, 640×480" "$balls,triangles=5M" 640x480 500 5000
  profile "500,000 triangles, 7680×4320" "$balls,triangles=500k" 7680x4320 5 500
fi

scripts/scaling_page.py "$out" "$page" "$images"
