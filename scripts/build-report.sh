#!/usr/bin/env bash
# Makes source/report/built/page.html, the report page that the program carries, of the files beside it and of three.js and
# uPlot: scripts/build-report.sh [--check]. Needs npm and a network; who builds the program needs neither.
# --check tells whether what is committed is what these sources give.
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

cd "$root/source/report"
npm ci --silent --no-audit --no-fund
if [ "${1:-}" != --check ]; then
  exec node bundle.mjs
fi
fresh=$(mktemp)
trap 'rm -f "$fresh"' EXIT
node bundle.mjs "$fresh" > /dev/null
cmp "$fresh" built/page.html
