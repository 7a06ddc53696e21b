#!/usr/bin/env bash
# Installs what is missing, builds, and runs a scene: scripts/run.sh [SCENE.prm] [options of supple].
# With RANKS=2 in the environment it runs on two processes.
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

if ! [[ ${RANKS:-1} =~ ^[1-9][0-9]{0,4}$ ]]; then
  echo "RANKS=$RANKS: the number of processes must be a whole number, 1 or greater, such as RANKS=2." >&2
  exit 1
fi
install_missing run
build "$root/build"
if [ $# -eq 0 ]; then set -- "$root/parameters/bar/large.prm"; fi
if [ "${RANKS:-1}" -gt 1 ]; then
  exec mpirun --quiet --oversubscribe -np "$RANKS" "$root/build/supple" "$@"
fi
exec "$root/build/supple" "$@"
