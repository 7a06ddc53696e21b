#!/usr/bin/env bash
# Installs what is missing, builds, and runs a scene: scripts/run.sh [SCENE.prm] [options of supple].
# With RANKS=2 in the environment it runs on two processes.
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

install_missing run
build "$root/build"
if [ $# -eq 0 ]; then set -- "$root/parameters/bar/large.prm"; fi
if [ "${RANKS:-1}" -gt 1 ]; then
  exec mpirun --quiet --oversubscribe -np "$RANKS" "$root/build/supple" "$@"
fi
exec "$root/build/supple" "$@"
