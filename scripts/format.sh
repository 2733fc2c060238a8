#!/usr/bin/env bash
# Formats all C++ by .clang-format: scripts/format.sh. With --check it writes nothing, names every place that differs,
# and fails if there is one. The tree is formatted with clang-format 14; other versions may break lines differently.
set -euo pipefail
cd "$(dirname "$0")/.."

mode=(-i)
[ "${1:-}" != --check ] || mode=(--dry-run -Werror)
git ls-files -z '*.cpp' '*.h' | xargs -0 clang-format "${mode[@]}"
