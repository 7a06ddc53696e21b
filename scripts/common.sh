# What run.sh, test.sh and the other scripts share: read by them, not run.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# One thread for BLAS: its threads spin and slow small bodies down. MPI refuses root unless told, and starts quicker
# when it need not look for network cards.
export OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1} OMP_NUM_THREADS=${OMP_NUM_THREADS:-1}
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_pml=${OMPI_MCA_pml:-ob1}

# install_missing GROUP...: installs those packages of packages.txt that are not there yet.
install_missing() {
  local wanted missing
  wanted=$(awk -v groups=" $* " '!/^#/ && NF == 2 && index(groups, " " $2 " ") {print $1}' "$root/scripts/packages.txt")
  missing=$(comm -23 <(sort <<< "$wanted") \
                     <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' 2> /dev/null | awk '$1 == "installed" {print $2}' | sort))
  if [ -z "$missing" ]; then return 0; fi
  missing=$(tr '\n' ' ' <<< "$missing")

  local as_root=""
  if [ "$(id -u)" -ne 0 ]; then
    if command -v sudo > /dev/null && { [ -t 0 ] || sudo -n true 2> /dev/null; }; then
      as_root=sudo
    else
      echo "These packages are missing. As root, type:  apt-get update && apt-get install $missing" >&2
      exit 1
    fi
  fi
  echo "Installing $missing" >&2
  $as_root apt-get update -qq
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing > /dev/null \
    2> >(grep -v "debconf: delaying package configuration" >&2)
}

# build FOLDER [CMAKE OPTION...]: configures once, builds what has changed; says nothing unless it takes time or fails.
build() {
  local folder=$1 log
  shift
  if [ ! -f "$folder/build.ninja" ]; then
    echo "Configuring $folder" >&2
    log=$(cmake -S "$root" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSUPPLE_NATIVE=ON \
                "-DCMAKE_CXX_COMPILER_LAUNCHER=env;CCACHE_INODECACHE=1;CCACHE_SLOPPINESS=pch_defines,time_macros;ccache" "$@" 2>&1) || { echo "$log" >&2; exit 1; }
  fi
  if ! ninja -C "$folder" -n 2>&1 | grep -q "no work to do"; then
    echo "Building $folder (a few minutes the first time)" >&2
    log=$(ninja -C "$folder" 2>&1) || { echo "$log" >&2; exit 1; }
  fi
}

# find_supple: sets supple to the executable: $SUPPLE if that is set, else one that it builds.
find_supple() {
  if [ -n "${SUPPLE:-}" ]; then
    if [ ! -f "$SUPPLE" ] || [ ! -x "$SUPPLE" ]; then
      echo "SUPPLE=$SUPPLE is not a program." >&2
      exit 1
    fi
    supple=$(realpath "$SUPPLE")
  else
    install_missing run
    build "$root/build"
    supple=$root/build/supple
  fi
}
