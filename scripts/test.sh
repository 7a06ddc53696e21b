#!/usr/bin/env bash
# Installs what is missing, builds, and runs all tests: scripts/test.sh [options of ctest].
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

install_missing run test
build "$root/build"
cd "$root/build"
exec ctest --output-on-failure --no-tests=error -j "$(getconf _NPROCESSORS_ONLN)" "$@"
