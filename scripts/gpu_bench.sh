#!/usr/bin/env bash
# Packs hybridrt for a bare machine with a GPU, where nothing can be installed or compiled:
#
#   scripts/gpu_bench.sh [OUT]              (default build/gpu_bench; from build/release, or BUILD=DIR)
#
# OUT.tar.gz then holds the program, the shared objects that it needs beyond the C and C++ library, its scenes and reference
# pictures, and run.sh. It loads no image library. On the other machine (x86-64, glibc 2.35 or later, a GL driver):
#
#   tar xf gpu_bench.tar.gz && gpu_bench/run.sh [-o gpu.md]
set -euo pipefail
cd "$(dirname "$0")/.."
out=$(realpath -m "${1:-build/gpu_bench}")
build=${BUILD:-build/release}

# The machine has these, and its GL driver needs its own.
of_the_machine='^(linux-vdso|ld-linux|libc|libm|libdl|libpthread|librt|libstdc\+\+|libgcc_s)[.-]'

[ -x "$build/bin/hybridrt" ] || { echo "gpu_bench.sh: $build/bin/hybridrt: not there; scripts/build.sh release builds it" >&2; exit 3; }
rm -rf "$out"
cmake --install "$build" --prefix "$out" --strip >/dev/null
rm -rf "$out"/lib/hybridrt "$out"/share/doc "$out"/share/man "$out"/share/bash-completion "$out"/share/hybridrt/report
mkdir -p "$out/lib/hybridrt"
# Without an image library only PNGs are read: the case with a BMP stays behind.
python3 - "$out/share/hybridrt/golden/golden.json" <<'EOF'
import json
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    golden = json.load(file)
golden["cases"] = [case for case in golden["cases"] if case["name"] != "exports-alpha-unused"]
with open(sys.argv[1], "w", encoding="utf-8") as file:
    json.dump(golden, file)
EOF

# ldd also lists what libraries need themselves.
ldd "$out/bin/hybridrt" | awk '/=> \// {print $3}' | while read -r library; do
  [[ $(basename "$library") =~ $of_the_machine ]] || cp -L "$library" "$out/lib/hybridrt/"
done
if ls "$out"/lib/hybridrt | grep -q OpenImageIO; then
  echo "gpu_bench.sh: the program links OpenImageIO, which the pack should not need" >&2
  exit 70
fi
# The loader that stands before GL drivers (GLVND): a container with a driver may lack it. run.sh takes it only then.
mkdir -p "$out/lib/glvnd"
for library in libEGL.so.1 libGLdispatch.so.0; do
  path=$(ldconfig -p | awk -v name="$library" '$1 == name && /x86-64/ {print $NF; exit}')
  [ -z "$path" ] || cp -L "$path" "$out/lib/glvnd/"
done
cp scripts/gpu_bench/run.sh "$out/run.sh"
tar -C "$(dirname "$out")" -czf "$out.tar.gz" "$(basename "$out")"
echo "$out.tar.gz ($(du -h "$out.tar.gz" | cut -f1))"
