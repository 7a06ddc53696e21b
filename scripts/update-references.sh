#!/usr/bin/env bash
# Takes the results of this machine as the expected outputs of the tests in tests/: scripts/update-references.sh [NAME...].
# Look at `git diff` afterwards: a reference that changes needs a reason.
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

install_missing run
build "$root/build"
names=("$@")
if [ $# -eq 0 ]; then
  names=($(cd "$root/tests" && ls *.output | sed 's/\.output$//; s/\.mpirun=.*//' | sort -u))
fi
for name in "${names[@]}"; do
  if [ -f "$root/tests/$name.cc" ]; then
    ninja -C "$root/build" "tests.$name.release" > /dev/null
    "$root/build/tests/$name.release/$name.release" > "$root/tests/$name.output"
  else
    folder=$(mktemp -d)
    (cd "$folder" && "$root/build/tests/supple_physics" "$root/tests/$name.prm" > "$root/tests/$name.output")
    rm -r "$folder"
  fi
  # On several processes the same is expected.
  for other in "$root/tests/$name".mpirun=*.output; do
    if [ -f "$other" ]; then cp "$root/tests/$name.output" "$other"; fi
  done
done
