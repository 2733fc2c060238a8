#!/usr/bin/env bash
# Builds the fuzz targets (clang) and runs each: scripts/fuzz.sh [SECONDS [TARGET…]], by default 60 seconds and all of
# them, as many at a time as there are processors. Starts from a copy of the committed corpus and keeps new inputs and
# findings in build/fuzz. Fails if an input crashes a reader.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-60}
shift || true
if [ $# -gt 0 ]; then targets=("$@"); else targets=(obj ply om scene_json camera png image_header); fi
folder=build/fuzz

# The seed is fixed, so that CI tests the same every day; HYBRIDRT_FUZZ_SEED=0 takes a new one each time. Memory: a few
# times what the readers' blocks and AddressSanitizer's quarantine take.
fuzz() {
  local target=$1 corpus=$folder/corpus/$1 findings=$folder/findings/$1 log=$folder/$1.log
  rm -rf "$findings"
  mkdir -p "$corpus" "$findings"
  if "$folder/bin/fuzz_$target" -max_total_time="$seconds" -seed="${HYBRIDRT_FUZZ_SEED:-1}" -timeout=10 -rss_limit_mb=1024 -malloc_limit_mb=256 \
    -max_len=4096 -print_final_stats=1 -artifact_prefix="$findings/" "$corpus" "tests/fuzz/corpus/$target" \
    >"$log" 2>&1; then
    echo "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") inputs, none crashed it"
    return
  fi
  grep -m 4 -E 'ERROR:|SUMMARY:|runtime error:|what\(\):' "$log" || tail -n 5 "$log"
  local found
  for found in "$findings"/*; do
    echo "$target: replay with: $folder/bin/fuzz_$target $found"
  done
  return 1
}
export folder seconds
export -f fuzz

scripts/setup.sh
scripts/build.sh fuzz
# Inputs go through files, in memory if possible. A reader that crashes leaves them behind.
TMPDIR=$(mktemp -d -p "$([ -w /dev/shm ] && echo /dev/shm || echo "${TMPDIR:-/tmp}")" hybridrt-fuzz-XXXXXX)
trap 'rm -rf "$TMPDIR"' EXIT
export TMPDIR
printf '%s\n' "${targets[@]}" | xargs -P "$(nproc)" -I{} bash -euo pipefail -c 'fuzz {}'
