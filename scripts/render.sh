#!/usr/bin/env bash
# Draws a run: scripts/render.sh OUTPUT_FOLDER PICTURE.png [options of render.py], such as --times 0 0.14 7
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

install_missing pictures
# VTK draws under a display only, and Debian's VTK belongs to Debian's Python.
exec xvfb-run -a /usr/bin/python3 "$root/scripts/render.py" "$@"
