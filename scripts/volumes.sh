#!/usr/bin/env bash
# Draws the volume of all cells over time: scripts/volumes.sh OUTPUT_A OUTPUT_B PICTURE.png [options of volumes.py]
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

install_missing pictures
# Debian's VTK and Matplotlib belong to Debian's Python.
exec /usr/bin/python3 "$root/scripts/volumes.py" "$@"
