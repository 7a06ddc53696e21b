#!/usr/bin/env bash
# Runs all tests with AddressSanitizer and UndefinedBehaviorSanitizer: scripts/test-sanitized.sh [options of ctest].
# A report ends the program with exit status 97 or 98, so that the test fails.
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

install_missing run test
build "$root/build-sanitized" "-DSUPPLE_SANITIZE=address;undefined"

export ASAN_OPTIONS="exitcode=97:detect_leaks=1:strict_string_checks=1:detect_stack_use_after_return=1:allocator_may_return_null=1"
export UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1:exitcode=98"
export LSAN_OPTIONS="exitcode=97:suppressions=$root/scripts/sanitizer-suppressions.txt:print_suppressions=0"
cd "$root/build-sanitized"
exec ctest --output-on-failure --no-tests=error -j "$(getconf _NPROCESSORS_ONLN)" "$@"
