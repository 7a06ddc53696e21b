#!/usr/bin/env bash
# Installs what is missing and builds the program: scripts/build.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

install_missing run
build "$root/build"
