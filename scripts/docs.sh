#!/usr/bin/env bash
# Builds the documentation into build/doc, to be opened at build/doc/index.html: the parameter reference anew from the
# program, the picture of the folders from the code, all Markdown pages, and the code by Doxygen. A warning of Doxygen is an
# error. SUPPLE=path takes another executable.
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

install_missing docs
find_supple
cd "$root"
mkdir -p build/doc

python3 scripts/parameter-reference.py "$supple"
scripts/modules.py
dot -Tsvg doc/modules.dot -o doc/pictures/modules.svg
# Debian's Markdown belongs to Debian's Python.
/usr/bin/python3 scripts/docs.py build/doc
warnings=$(doxygen doc/Doxyfile 2>&1)
if [ -n "$warnings" ]; then
  echo "$warnings" >&2
  exit 1
fi
echo "$root/build/doc/index.html"
