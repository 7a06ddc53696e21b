#!/usr/bin/env bash
# Takes the results of this machine as the expected outputs of the tests in tests/: scripts/update-references.sh [NAME...],
# where NAME is as in mechanics, or with its folder as in mechanics/mechanics. Look at `git diff` afterwards: a reference that
# changes needs a reason.
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

install_missing run
build "$root/build"
cd "$root/tests"
names=("$@")
if [ $# -eq 0 ]; then names=("*"); fi
for name in "${names[@]}"; do
  # On several processes, NAME.mpirun=N.output, the same is expected.
  readarray -t outputs < <(find . -path "*/$name.output" ! -name "*.mpirun=*" -printf '%P\n' | sort)
  if [ ${#outputs[@]} -eq 0 ]; then
    echo "There is no $name.output in tests/" >&2
    exit 1
  fi
  for output in "${outputs[@]}"; do
    test=${output%.output}
    if [ -f "$test.cc" ]; then
      ninja -C "$root/build" "${test/\//.}.release" > /dev/null
      "$root/build/tests/$test.release/$(basename "$test").release" > "$output"
    else
      folder=$(mktemp -d)
      (cd "$folder" && "$root/build/tests/supple_physics" "$root/tests/$test.prm" > "$root/tests/$output")
      rm -r "$folder"
    fi
    for other in "$test".mpirun=*.output; do
      if [ -f "$other" ]; then cp "$output" "$other"; fi
    done
  done
done
