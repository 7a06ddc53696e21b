#!/usr/bin/env bash
# Runs all tests with AddressSanitizer and UndefinedBehaviorSanitizer: scripts/test-sanitized.sh [options of ctest].
# A report ends the program with exit status 97 or 98, so that the test fails.
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

install_missing run test
build "$root/build-sanitized" "-DSUPPLE_SANITIZE=address;undefined"

# Not detect_stack_use_after_return, with which gcc 12 puts vectors of AVX-512 on addresses that are not theirs.
export ASAN_OPTIONS="exitcode=97:detect_leaks=0:strict_string_checks=1"
export UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1:exitcode=98"
cd "$root/build-sanitized"
status=0
ctest --output-on-failure --no-tests=error -j "$(getconf _NPROCESSORS_ONLN)" "$@" || status=$?

# Leaks: only full call stacks tell ours from those of MPI, and they take their time, so that a few scenes have to do.
export ASAN_OPTIONS="exitcode=97:detect_leaks=1:fast_unwind_on_malloc=0"
export LSAN_OPTIONS="exitcode=97:suppressions=$root/scripts/sanitizer-suppressions.txt:print_suppressions=0"
for scene in bar/large bar/static validation/cook-3d skin/needle-plane; do
  echo "Leaks of $scene"
  ./supple "$root/parameters/$scene.prm" --quiet --output leaks || status=$?
done
exit $status
