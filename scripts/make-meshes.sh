#!/usr/bin/env bash
# Makes the meshes of the mushroom and the armadillo again, by Gmsh: scripts/make-meshes.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

install_missing meshes
for body in mushroom armadillo; do
  # Debian's Gmsh belongs to Debian's Python.
  /usr/bin/python3 "$root/parameters/$body/mesh.py"
done
