#!/usr/bin/env bash
# Runs clang-tidy on the C++ changed since a revision: scripts/tidy.sh [REVISION], by default HEAD, that is, what is not
# committed yet. Advice, not a gate: read it before you commit. Uses the compile commands of build/release.
set -euo pipefail
cd "$(dirname "$0")/.."

revision=${1:-HEAD}
[ -f build/release/compile_commands.json ] || scripts/build.sh release
mapfile -d '' -t files < <(
  git diff -z --name-only --diff-filter=d "$revision" -- '*.cpp'
  git ls-files -z --others --exclude-standard -- '*.cpp'
)
[ ${#files[@]} -gt 0 ] || { echo "no .cpp has changed since $revision"; exit 0; }
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy -p build/release --quiet
