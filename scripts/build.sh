#!/usr/bin/env bash
# Configures, if needed, and builds one preset: scripts/build.sh PRESET [TARGET…]. Without a terminal only errors are
# shown.
set -euo pipefail
cd "$(dirname "$0")/.."

preset=$1
shift
folder=build/$preset

configure() {
  local log
  log=$(mktemp)
  if ! cmake --preset "$preset" >"$log" 2>&1; then
    cat "$log" >&2
    rm -f "$log"
    exit 1
  fi
  rm -f "$log"
}

# Ninja configures again by itself when a CMakeLists.txt changes, but does not know about presets.
if [ ! -f "$folder/build.ninja" ] || [ CMakePresets.json -nt "$folder/build.ninja" ]; then configure; fi

started=$SECONDS
quiet=()
if [ ! -t 1 ]; then
  echo "building $preset ..."
  quiet=(--quiet)
fi
export NINJA_STATUS="building $preset [%p, %f of %t, %es] "
(cd "$folder" && ninja "${quiet[@]}" "${@:-all}")
echo "built $preset in $((SECONDS - started)) s"
