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
  readarray -t files < <(find . \( -path "*/$name.prm" -o -path "*/$name.cc" \) ! -path "./driver/*" -printf '%P\n' | sort)
  if [ ${#files[@]} -eq 0 ]; then
    echo "There is no $name.prm and no $name.cc in the folders of tests/" >&2
    exit 1
  fi
  for file in "${files[@]}"; do
    test=${file%.*}
    # CMake finds a test by its output.
    if [ ! -f "$test.output" ]; then
      touch "$test.output"
      cmake "$root/build" > /dev/null
    fi
    if [ -f "$test.cc" ]; then
      ninja -C "$root/build" "${test/\//.}.release" > /dev/null
      "$root/build/tests/$test.release/$(basename "$test").release" > "$test.output"
    else
      folder=$(mktemp -d)
      (cd "$folder" && "$root/build/tests/supple_physics" "$root/tests/$file" > "$root/tests/$test.output")
      rm -r "$folder"
    fi
    # On several processes the same is expected.
    for other in "$test".mpirun=*.output; do
      if [ -f "$other" ]; then cp "$test.output" "$other"; fi
    done
  done
done
