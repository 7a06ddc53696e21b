#!/usr/bin/env bash
# Checks what needs no compiler: scripts/check.sh [--fix]. Formatting, include guards, lengths, white space, spelling, links,
# what each folder of the code includes, and the picture of the folders; and, where the program is built, that doc/parameters
# is what it says of itself. --fix formats the sources and makes doc/parameters and doc/modules.dot anew first. The tests
# `scenes` and `parameter_reference` look at every scene and at doc/parameters too.
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

install_missing test
cd "$root"
supple=${SUPPLE:-build/supple}
readarray -t sources < <(git -c safe.directory="$root" ls-files '*.cc' '*.h')

failed=()
check() {
  local name=$1
  shift
  if "$@"; then echo "$name: right"; else failed+=("$name"); echo "$name: WRONG"; fi
}

# The conventions are those of one version: another one breaks lines elsewhere.
formatter=14
if [[ $(clang-format --version) == *" version $formatter."* ]]; then
  if [ "${1:-}" = --fix ]; then clang-format -i "${sources[@]}"; fi
  check formatting clang-format --dry-run --Werror "${sources[@]}"
else
  echo "formatting: not checked, for that clang-format $formatter (Debian 12) is needed"
fi
if [ -x "$supple" ]; then
  if [ "${1:-}" = --fix ]; then scripts/parameter-reference.py "$supple"; fi
  check "parameter reference" scripts/parameter-reference.py "$supple" --check
fi
if [ "${1:-}" = --fix ]; then scripts/modules.py; fi
check "picture of the folders" scripts/modules.py --check
check "lengths, guards, white space, links, includes" scripts/check.py
check spelling codespell
check "shell scripts" bash -n scripts/*.sh .ci/run

if [ ${#failed[@]} -gt 0 ]; then
  printf 'Wrong: %s\n' "${failed[@]}" >&2
  exit 1
fi
