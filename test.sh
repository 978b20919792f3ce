#!/usr/bin/env bash
# Installs what is missing, builds, and passes the tests.
#   ./test.sh              formatting, release build with warnings as errors, all tests but those labelled long
#   ./test.sh --sanitize   build with AddressSanitizer and UndefinedBehaviorSanitizer, the fast tests
#   ./test.sh --tidy       clang-tidy over all sources
#   ./test.sh --long       the release build's long validations
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
jobs=$(nproc)

cmake/install-packages.sh

configure() {
  [ -f "build/$1/build.ninja" ] || cmake --preset "$1" >/dev/null
}

check_format() {
  git ls-files '*.h' '*.cc' | xargs clang-format --dry-run --Werror
}

run_tests() {
  configure "$1"
  cmake --build --preset "$1" -- --quiet
  ctest --preset "$1" --parallel "$jobs" --output-on-failure "${@:2}"
}

case ${1:-} in
  '') check_format && run_tests release ;;
  --sanitize)
    export LSAN_OPTIONS="suppressions=$PWD/cmake/leak-suppressions.txt:print_suppressions=0"
    run_tests sanitize
    ;;
  --long)
    cmake --preset bench >/dev/null
    cmake --build --preset bench -- --quiet
    ctest --test-dir build/release --label-regex long --output-on-failure
    ;;
  --tidy)
    configure release
    git ls-files 'libindet/*.cc' 'libsim/*.cc' 'apps/*.cc' |
      xargs --max-procs="$jobs" --max-args=4 clang-tidy --quiet -p build/release --extra-arg=-Wno-unknown-warning-option \
        --extra-arg=-Wno-unused-command-line-argument 2>/dev/null
    ;;
  *) sed -n '2,6s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
esac
