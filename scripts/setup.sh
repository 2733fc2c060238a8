#!/usr/bin/env bash
# Installs the Debian packages for building, testing and running hybridrt. Quick and silent if nothing is missing.
# HYBRIDRT_SETUP=skip leaves the machine alone.
set -euo pipefail

packages=(
  g++                    # compiler
  cmake                  # build
  ninja-build            # build
  ccache                 # rebuilds
  pkg-config             # finds libraries
  git                    # version
  python3                # tests
  libegl-dev             # headers
  libgl-dev              # headers
  libegl1                # contexts
  libegl-mesa0           # contexts
  libgl1-mesa-dri        # llvmpipe
  libosmesa6             # contexts
  libglm-dev             # math
  libfmt-dev             # text
  nlohmann-json3-dev     # JSON
  libcli11-dev           # options
  libopenimageio-dev     # images
  libopenexr-dev         # EXR
  libpng-dev             # PNG
  libisal-dev            # packing
  libdeflate-dev         # packing
  libembree-dev          # rays
  libhwy-dev             # SIMD
  libopenmesh-dev        # decimation
  libgtest-dev           # tests
  libbenchmark-dev       # benchmarks
  clang                  # fuzzing: libFuzzer is clang's
  libclang-rt-dev        # fuzzing: its runtime
  clang-format           # scripts/format.sh
  clang-tidy             # scripts/tidy.sh
  python3-matplotlib     # charts
)
# Tests that need these are skipped without them.
optional=(
  ffmpeg                 # reads what -o - writes
  pngcheck               # reads our PNGs
  qemu-user              # writes them on other processors
  chromium               # opens reports
)
# A farm of one node. Its daemons are for a machine that is thrown away, not for one that people work on.
if [ "${CI:-}" = true ]; then optional+=(slurm-wlm munge); fi

fail() {
  echo "setup.sh: $*" >&2
  exit 1
}

# Those of the given packages that are not installed.
missing_of() {
  local installed
  # Fails if a package is unknown, but still prints the others.
  installed=$(dpkg-query -W -f '${db:Status-Abbrev}${Package}\n' "$@" 2>/dev/null | sed -n 's/^ii *//p' || true)
  comm -23 <(printf '%s\n' "$@" | sort) <(sort -u <<<"$installed")
}

apt_get() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Dpkg::Use-Pty=0 -o Acquire::Retries=3 \
    -o DPkg::Lock::Timeout=300 "$@" >>"$log" 2>&1
}

install_missing() {
  [ ${#missing[@]} -eq 0 ] || apt_get install --no-install-recommends "${missing[@]}"
}

[ "${HYBRIDRT_SETUP:-}" != skip ] || exit 0
if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  fail "no apt here; install the equivalents of Debian's ${packages[*]}, then set HYBRIDRT_SETUP=skip"
fi

mapfile -t missing < <(missing_of "${packages[@]}")
mapfile -t useful < <(missing_of "${optional[@]}")
[ $((${#missing[@]} + ${#useful[@]})) -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || fail "run as root: apt-get install --no-install-recommends ${missing[*]}"
  as_root=(sudo)
fi

echo "setup.sh: installing Debian packages: ${missing[*]} ${useful[*]}" >&2
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# A new machine has no package lists, and an old one may have outdated lists; then the first attempt fails. Mirrors fail
# at times, so updating is tried twice.
if ! install_missing; then
  apt_get update || { sleep 5; apt_get update; } || true
  install_missing || {
    tail -n 20 "$log" >&2
    fail "apt-get could not install: ${missing[*]}"
  }
fi
[ ${#useful[@]} -eq 0 ] || apt_get install --no-install-recommends "${useful[@]}" ||
  echo "setup.sh: not installed: ${useful[*]}; tests that need them are skipped" >&2
