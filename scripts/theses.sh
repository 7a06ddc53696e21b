#!/usr/bin/env bash
# What the theses print beside what supple computes: the tables and pictures of doc/vein.md, doc/skin-revolved.md and
# doc/corotational.md. scripts/theses.sh makes all, scripts/theses.sh vein, skin or corotational one of them; the tables are
# printed, and the pages have them by hand. SUPPLE=path takes another executable instead of building one.
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

find_supple
install_missing pictures
cd "$root"
for name in "${@:-vein skin corotational}"; do
  for one in $name; do
    case $one in
      vein | skin | corotational) ;;
      *)
        echo "There is no thesis $one. There are: vein skin corotational" >&2
        exit 1
        ;;
    esac
    # Debian's VTK and Matplotlib belong to Debian's Python; VTK draws under a display only.
    xvfb-run -a /usr/bin/python3 "scripts/thesis_$one.py" "$supple"
  done
done
