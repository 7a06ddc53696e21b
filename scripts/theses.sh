#!/usr/bin/env bash
# What the theses print beside what supple computes: runs the scenes, prints tables and writes them into doc/vein.md,
# doc/skin-figures.md and doc/corotational.md, and draws the pictures of these pages. scripts/theses.sh makes all three (five
# minutes), scripts/theses.sh vein, skin or corotational some of them. The text between the tables is written by hand.
# SUPPLE=path takes another executable instead of building one.
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

known=(vein skin corotational)
wanted=("$@")
if [ $# -eq 0 ]; then wanted=("${known[@]}"); fi
for name in "${wanted[@]}"; do
  if [[ " ${known[*]} " != *" $name "* ]]; then
    echo "There is no thesis $name. There are: ${known[*]}" >&2
    exit 1
  fi
done

find_supple
install_missing pictures
cd "$root"
for name in "${wanted[@]}"; do
  # Debian's VTK and Matplotlib belong to Debian's Python; VTK draws under a display only.
  xvfb-run -a /usr/bin/python3 "scripts/thesis_$name.py" "$supple"
done
