#!/usr/bin/env bash
# Runs all tests in a Debian 13, made in a folder the first time: sudo scripts/test-debian13.sh [options of ctest].
# The folder is $SUPPLE_DEBIAN13, or else /var/tmp/supple-debian13. It takes 4 GB and is kept: delete it to start anew.
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/common.sh"

if [ "$(id -u)" -ne 0 ]; then
  echo "Only root can enter another Debian. Type:  sudo scripts/test-debian13.sh" >&2
  exit 1
fi
install_missing debian13

# In a mount namespace of its own every mount below ends with this script, even if it is killed.
if [ -z "${SUPPLE_OWN_MOUNTS:-}" ]; then
  SUPPLE_OWN_MOUNTS=1 exec unshare --mount "$root/scripts/test-debian13.sh" "$@"
fi

folder=$(realpath -m "${SUPPLE_DEBIAN13:-/var/tmp/supple-debian13}")
mkdir -p "$(dirname "$folder")"
# Two runs at once would build in the same place: the second waits.
exec 9> "$folder.lock"
flock 9

if [ ! -d "$folder" ]; then
  echo "Making a Debian 13 in $folder (a few minutes, only the first time)" >&2
  # The mirror this machine takes its Debian packages from; on another system none, and debootstrap takes its own.
  apt-get update -qq || true
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Identifier: Packages' 'Origin: Debian' 'Label: Debian' \
             | awk '/^http/ && !found {found = 1; print}')
  # Made aside and renamed at the end: what an interruption leaves does not look finished.
  rm -rf --one-file-system "$folder.new"
  log=$(debootstrap --variant=minbase --include=ca-certificates trixie "$folder.new" ${mirror:+"$mirror"} 2>&1) \
    || { echo "$log" >&2; exit 1; }
  mv "$folder.new" "$folder"
fi

# apt inside reaches the mirror the way apt outside does, and keeps no copy of what it has installed.
{ apt-config dump | sed -nE '/Proxy-Auto-Detect/d; /^Acquire::(https?::|Check-|Retries)/p'
  echo 'APT::Keep-Downloaded-Packages "false";'; } > "$folder/etc/apt/apt.conf.d/99outside"
for file in /etc/resolv.conf /etc/hosts; do
  if [ -e "$file" ]; then cp --remove-destination "$(realpath "$file")" "$folder$file"; fi
done

# The source as it is now, committed or not, and nothing built outside. The build inside stays, and the times of
# the files stay theirs, so that only what has changed is compiled again.
mkdir -p "$folder/supple"
find "$folder/supple" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +
list() { git -C "$root" -c safe.directory="$root" ls-files -z "$@" | sort -zu; }
comm -z -23 <(list -co --exclude-standard) <(list -d) \
  | tar -C "$root" -c --null --no-recursion -T - | tar -C "$folder/supple" -x --no-same-owner

mount -t proc proc "$folder/proc"
mount --rbind /dev "$folder/dev"    # with /dev/shm, which MPI needs, and /dev/pts
mount --rbind /sys "$folder/sys"    # where MPI looks for the processors

clean=(HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8)
for name in CI http_proxy https_proxy no_proxy; do
  if [ -n "${!name:-}" ]; then clean+=("$name=${!name}"); fi
done
exec chroot "$folder" /usr/bin/env -i "${clean[@]}" /supple/scripts/test.sh "$@"
