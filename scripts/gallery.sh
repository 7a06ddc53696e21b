#!/usr/bin/env bash
# Runs the scenes of doc/gallery.md and doc/volumes.md and draws their pictures into doc/pictures: scripts/gallery.sh
# draws all, scripts/gallery.sh NAME... some. SUPPLE=path takes another executable instead of building one.
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

known="" wanted=" $* "
find_supple
cd "$root"

# run PICTURE SCENE...: runs the scenes, each in output/ and its name, if the picture is wanted; fails if it is not.
run() {
  known+=" $1"
  if [[ "$wanted" != "  " && "$wanted" != *" $1 "* ]]; then return 1; fi
  echo "doc/pictures/$1.png"
  local scene
  for scene in "${@:2}"; do
    "$supple" "parameters/$scene.prm" --output "output/$scene" --quiet \
      --set "Output/Frames=every" ${settings:+--set "$settings"} || exit
  done
}

# show PICTURE "SCENE [OTHER]" [options of render.py]: a scene at three instants, and another with it.
show() {
  local scenes=($2)
  if run "$1" "${scenes[@]}"; then
    scripts/render.sh "output/${scenes[0]}" "doc/pictures/$1.png" ${scenes[1]:+--below "output/${scenes[1]}"} "${@:3}"
  fi
}

# volumes PICTURE SCENE OTHER: the volume of all cells over time.
volumes() {
  if run "$@"; then scripts/volumes.sh "output/$2" "output/$3" "doc/pictures/$1.png"; fi
}

growing=(--names linear corotational --field volume_ratio)
loading=(--times 0 0.5 1 --instants "without load" "half the load" "all of it")
lying=(--stacked --up 1 0 0 --camera 0 1 0.35)                 # the axis to the right, x upwards
erring=(--field error_in_space --title "error in space" --width 600)
held_free=(--names held free --times 0 0.05 0.5)

show bar bar/large --times 0.07 0.21 0.49
show bar-small "bar/small-linear bar/small" --names linear corotational --times 0.07 0.28 0.49
show bar-linear "bar/large-linear bar/large" "${growing[@]}" --times 0.07 0.21 0.49
show bar-fast "bar/fast-linear bar/fast" "${growing[@]}" --times 0.06 0.12 0.42
settings=Time/Steps=2 show bar-static bar/static "${loading[@]}" --enlarge 20
show mushroom "mushroom/mushroom-linear mushroom/mushroom" "${growing[@]}" --outline silhouette \
  --times 0 2 5.74 --camera -0.15 -1 0.05
show armadillo "armadillo/armadillo-linear armadillo/armadillo" "${growing[@]}" --outline silhouette \
  --times 0 0.5 0.9 --camera -1.2 -0.8 0.25

show vein-test-1 "vein/test-1 vein/test-1-free" "${lying[@]}" "${held_free[@]}" --range 0 13e3 --camera 0 1 -0.6
show vein-test-2 "vein/test-2 vein/test-2-free" "${lying[@]}" "${held_free[@]}" --range 0 48e3
show vein-test-3 "vein/test-3 vein/test-3-free" "${lying[@]}" "${held_free[@]}" --range 0 205e3
show vein-test-4 "vein/test-4 vein/test-4-free" "${lying[@]}" "${held_free[@]}" --range 0 76e3 --up 0 -1 0 --camera 1 0 0.35
show vein-test-5 vein/test-5 "${lying[@]}" --times 0.02 0.05 0.5 --enlarge 20 --width 1000 \
  --field displacement_2 --title "displacement along z" --range -0.000024 0.000024
show vein-pulse vein/pulse "${lying[@]}" --times 0 0.355 0.9 --enlarge 4 --field displacement --width 1000 \
  --instants "at rest" "systole, t = 0.355 s" "diastole, t = 0.9 s"
show needle skin/needle --times 0.1667 0.3333 0.5 --camera 0.5 0.75 1 --up 0 1 0 --range 0 100e3 --width 1500
settings=Time/Steps=2 show thick-cylinder validation/thick-cylinder "${loading[@]}" --enlarge 150

settings="Mesh/Box cubes=8, 24, 8" show error-bar bar/static "${erring[@]}" --times 1 --instants "all of the load" --enlarge 20 --range 0 1.5
settings="Space/Estimate error=frames" show error-vein vein/pulse "${erring[@]}" --times 0.355 --up 1 0 0 --camera 0 1 0.35 \
  --enlarge 4 --instants "systole, t = 0.355 s"
settings="Space/Estimate error=frames" show error-needle skin/needle "${erring[@]}" --times 0.5 --camera 0.5 0.75 1 --up 0 1 0 \
  --range 0 4

volumes volumes-mushroom mushroom/mushroom-linear mushroom/mushroom
volumes volumes-armadillo armadillo/armadillo-linear armadillo/armadillo
volumes volumes-bar bar/large-linear bar/large
volumes volumes-bar-fast bar/fast-linear bar/fast

for name in $wanted; do
  if [[ " $known " != *" $name "* ]]; then
    echo "There is no picture $name. There are:$known" >&2
    exit 1
  fi
done
