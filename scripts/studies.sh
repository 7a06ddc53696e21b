#!/usr/bin/env bash
# Runs the studies of doc/studies.md and doc/order.md into output/ and takes their tables into doc/studies and their plots into
# doc/pictures: scripts/studies.sh runs all (twenty minutes), scripts/studies.sh NAME... some. SUPPLE=path takes another
# executable instead of building one. The pages sum the tables up by hand.
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

find_supple
cd "$root"

# Times are those of one thread; first in the queue, where one may.
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
first=()
if nice -n -19 true 2> /dev/null; then first=(nice -n -19); fi

studies=("$@")
if [ $# -eq 0 ]; then
  studies=(order bar-small bar-large soft-bar stiff-bar vein needle
           cells-static cells-swing cells-bending cells-elastica cells-cylinder cells-incompressible cells-vein cells-steps)
fi
mkdir -p doc/studies
for study in "${studies[@]}"; do
  "${first[@]}" "$supple" "parameters/studies/$study.prm" --output "output/$study"
  cp "output/$study/study.md" "doc/studies/$study.md"
  plot=work_precision
  if [ "$study" = order ]; then plot=convergence; fi
  if [ -f "output/$study/$plot.svg" ]; then cp "output/$study/$plot.svg" "doc/pictures/study-$study.svg"; fi
done
