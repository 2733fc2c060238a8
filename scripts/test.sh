#!/usr/bin/env bash
# Builds and tests everything, from scratch if needed; ends with CTest's closing lines.
#
#   scripts/test.sh [--quick] [CTest options, like -R kd_tree or -L unit]
#
# Three builds, tested by one CTest run so that its last lines count every test: release in full; "address." tests
# under AddressSanitizer and UBSan; "thread." tests, the unit tests, under ThreadSanitizer. --quick: release only.
set -euo pipefail
cd "$(dirname "$0")/.."

builds=(release asan tsan)
if [ "${1:-}" = --quick ]; then
  builds=(release)
  shift
fi

# One folder of tests over all builds.
write_test_folder() {
  mkdir -p build/tests
  local build
  for build in "${builds[@]}"; do
    echo "subdirs(\"$PWD/build/$build\")"
  done >build/tests/CTestTestfile.cmake
}

scripts/setup.sh
for build in "${builds[@]}"; do
  case $build in
    tsan) scripts/build.sh tsan unit_tests ;; # it has no other tests
    *) scripts/build.sh "$build" ;;
  esac
done
write_test_folder
exec ctest --test-dir build/tests --output-on-failure --no-tests=error --parallel "$(nproc)" "$@"
