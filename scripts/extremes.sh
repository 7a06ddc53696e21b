#!/usr/bin/env bash
# Makes the tables and pictures of doc/extremes.md: the matrix of extremes three times (two minutes) and three strips.
# SUPPLE=path takes another executable instead of building one. doc/extremes.md sums the tables up by hand.
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

if [ $# -gt 0 ]; then
  sed -n '2,3s/^# //p' "$0"
  [ "$1" = --help ] && exit 0
  echo "extremes.sh takes no arguments; found: $*" >&2
  exit 1
fi
find_supple
cd "$root"
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1

matrix() { # NAME [--set ENTRY=VALUE]...
  "$supple" parameters/studies/extremes.prm --output "output/$1" "${@:2}"
  cp "output/$1/study.md" "doc/studies/$1.md"
}
strip() { # CASE PICTURE TIMES...
  scripts/render.sh "output/extremes/runs/$1" "doc/pictures/extremes-$2.png" --times "${@:3}" \
    --field volume_ratio --range -1 1.5 --title "volume ratio" --width 1000
}

mkdir -p doc/studies
matrix extremes
matrix extremes-unguarded --set "Time/Energy guard=warn"
matrix extremes-linear --set "Corotation/Rotation=none"

strip starts_in_one_point point 0 0.07 0.14 0.35 7
strip starts_mirrored_at_its_clamp mirrored 0 0.35 0.84 1.19 7
strip starts_at_random_places random 0 0.35 0.7 1.12 7
