#!/usr/bin/env bash
# Makes doc/errors.md: each scene of parameters/ with its errors in time and in space beside its run time (a minute).
# SUPPLE=path takes another executable instead of building one. scripts/errors.sh "bar/*" prints the table of some scenes.
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

find_supple
exec python3 "$root/scripts/errors.py" "$supple" "$@"
