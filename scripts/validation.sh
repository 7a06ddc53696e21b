#!/usr/bin/env bash
# Runs the studies of doc/validation.md: scripts/validation.sh all, scripts/validation.sh NAME... some. The tables are in
# output/NAME/study.md; the plots and pictures go into doc/pictures. SUPPLE=path takes another executable instead of building one.
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

names=("$@")
if [ ${#names[@]} -eq 0 ]; then
  names=(patch-test lame-cylinder lame-cylinder-plane lame-sphere lame-sphere-axisymmetric cantilever-bending
         cantilever-plane cantilever-axial elastica)
fi
find_supple
cd "$root"

for name in "${names[@]}"; do
  "$supple" "parameters/studies/$name.prm" --output "output/$name"
  if [ "$name" = elastica ]; then
    install_missing pictures
    "$supple" parameters/validation/elastica.prm --output output/elastica/shape --quiet --set "Output/Frames=none" \
      --set "Probes/Profiles=upper: 3; lower: 2"
    /usr/bin/python3 scripts/elastica.py output/elastica/shape doc/pictures/elastica.png
  elif [ "$name" = cantilever-plane ]; then
    cp output/cantilever-plane/convergence.svg doc/pictures/cantilever-plane.svg
  fi
done
