#!/usr/bin/env bash
# Formats all C++ by .clang-format: scripts/format.sh. With --check nothing is written; every place that differs is named,
# and the script fails. The tree is formatted by clang-format 14; other versions may want other line breaks.
set -euo pipefail
cd "$(dirname "$0")/.."

mode=(-i)
[ "${1:-}" != --check ] || mode=(--dry-run -Werror)
git ls-files -z '*.cpp' '*.h' | xargs -0 clang-format "${mode[@]}"
